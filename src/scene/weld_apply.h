// Makes of what was found in a group what its meshes shall hold: control points with the same bits, and edge records.
#pragma once

#include <vector>

#include "scene/weld_group.h"
#include "scene/weld_levels.h"
#include "scene/weld_match.h"
#include "tessera/weld.h"

namespace tessera::welding {

// Moves the control points; adds to the report's snappedPoints and largestGap.
void snapPoints(const Group& group, const Labels& labels, const Matching& matching, const std::vector<CoarseBorder>& levels,
                WeldReport& report);

// Fills Mesh::edges of the group's meshes, from their points as they are after snapPoints().
void makeRecords(const Group& group, const Matching& matching, const std::vector<CoarseBorder>& levels);

}  // namespace tessera::welding
