// Which borders are the same curve from end to end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/weld_clusters.h"
#include "scene/weld_group.h"

namespace tessera::welding {

// The control points of a group's borders, in clusters: corners by themselves, since they alone must be the same in more than two patches.
class Labels {
public:
    explicit Labels(const Group& group);

    // The clusters of a border's points, in its own direction.
    [[nodiscard]] std::array<std::uint32_t, 4> of(PatchKind kind, std::uint32_t border) const;
    [[nodiscard]] std::uint32_t corner(std::size_t patch, std::size_t corner) const {
        return cornerPoints_.cluster(corners_[4 * patch + corner]);
    }
    [[nodiscard]] const PointClusters& cornerPoints() const { return cornerPoints_; }

private:
    void add(const Mesh& mesh, std::size_t firstPatch, double tolerance);

    PointClusters cornerPoints_;
    PointClusters innerPoints_;
    std::vector<std::uint32_t> corners_;  // 4 a patch
    std::vector<std::uint32_t> inner_;    // 2 a border
};

// Borders with one curve, the lowest first, and borders that are alone. Of a border that is degenerate nothing else is of interest.
struct Matching {
    std::vector<std::uint32_t> borders;    // class by class
    std::vector<std::size_t> classes;      // where each begins in `borders`, and where the last ends
    std::vector<std::uint8_t> flipped;     // a border: whether it runs against others of its class that do not
    std::vector<std::uint8_t> degenerate;  // a border: whether all of it is in one point, or shall be
    std::size_t collapsed = 0;             // degenerate borders that are not yet one point

    [[nodiscard]] std::size_t classCount() const { return classes.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> members(std::size_t k) const {
        return std::span(borders).subspan(classes[k], classes[k + 1] - classes[k]);
    }
};

[[nodiscard]] Matching matchBorders(const Group& group, const Labels& labels);

}  // namespace tessera::welding
