// Scenes for measuring, made by rule instead of read: of any size, and the same to the bit on every machine.
#pragma once

#include "tessera/progress.h"
#include "tessera/scene.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace tessera {

// A scene that can be made, and what its count means.
struct GeneratedScene {
    std::string_view name;
    std::string_view counted;   // what the count counts, plural: "strands"
    std::uint64_t least = 1;    // range of the count
    std::uint64_t most = 1;     // a scene of the most still fits an .mscene file
    std::uint64_t usual = 1;    // without a count
    std::string_view contents;  // a line that says what is to be seen
};

// hair      strands of four ribbon patches each, combed over a head
// columns   a hall of fluted columns under beams, 240 patches a column and 40 a beam
// city      about as many placed patches as the count says (never fewer, at most some 6000 more): instances of some three dozen meshes.
//           Cameras: "average" along a street, "spike" before a grove of willows, "eyesplit" within it, fronds passing its eye plane.
//           The three look the same way from one line, so that a path through them is a walk. A million patches cover 500 m or so.
// eyesplit  one plane patch that passes the eye plane of its camera
// random    patches of random points and pose in a cube
// spheres   exact rational spheres in a cube, eight patches each
[[nodiscard]] const std::vector<GeneratedScene>& generatedScenes();
[[nodiscard]] std::vector<std::string_view> generatedSceneNames();

// Makes the scene: lit, with its cameras, the one to begin with first. Equal arguments give equal bits; another seed gives another
// scene, but for eyesplit and columns' shape, which know no chance but the stone's shade. Takes memory in proportion to the count, for
// city and columns to the number of objects. `progress` is told of the one stage "generate".
// Throws Error, before anything is made, on an unknown name and on a count outside the scene's range.
[[nodiscard]] Scene generateScene(std::string_view name, std::optional<std::uint64_t> count = std::nullopt, std::uint32_t seed = 1,
                                  const Progress& progress = {});

}  // namespace tessera
