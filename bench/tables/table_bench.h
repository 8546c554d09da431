// What table_bench measures: the same points of the same cage by tables and by OpenSubdiv.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tessera/cage.h"

namespace tessera::bench {

// Boxes pushed out of boxes until there are `faces` faces: closed, quadrilaterals alone, inner vertices of valence 3 to 6.
[[nodiscard]] Cage extrudedBoxes(std::size_t faces);

// One way of evaluating a cage at one level.
struct Contender {
    std::string name;
    std::uint64_t vertices = 0;     // of one run
    double share = 1;               // of the cage's faces: what takes too much memory is measured on some of them
    std::uint64_t memoryBytes = 0;  // of what stays between frames, of the whole cage
    std::uint64_t frameBytes = 0;   // uploaded for a frame
    std::function<double()> run;    // milliseconds
};

enum class Threads { one, openMp };

// Limit stencils at the (2^level + 1)^2 points of each face, as tables have them.
[[nodiscard]] std::vector<Contender> limitStencils(const Cage& cage, int level, bool normals);
// Patches of a patch table with Gregory end caps, isolated down to level 4, at the same points.
[[nodiscard]] std::vector<Contender> patchEvaluation(const Cage& cage, int level, bool normals);

}  // namespace tessera::bench
