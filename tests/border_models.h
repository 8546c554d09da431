// Patches that share one border curve, by chance: of any kind, lying any way round, and on each side of it one patch or a row of smaller
// ones. All but the border is random. For tests of what both sides draw there.
#pragma once

#include "sample_meshes.h"

#include "tessera/scene.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tessera::splitting {

// A patch, the only one of its object, and the part [index, index + 1] / 2^level of the curve that its border is.
struct BorderUser {
    PatchKind kind = PatchKind::bezier;
    std::uint32_t side = 0;  // as in EdgeRecord
    bool reversed = false;   // whether the border's parameter falls along the curve
    std::uint32_t level = 0;
    std::uint32_t index = 0;
};

struct SharedBorder {
    Scene scene;  // within a cube of 2 around the origin; object k is the user at place k of `users`
    std::vector<BorderUser> users;
    std::array<std::vector<std::size_t>, 2> onEachSide;  // numbers of users
    bool onePoint = false;                               // whether the curve is one
    std::string text;                                    // for messages
};

enum class BorderLook {
    own,       // the patches' own borders are the curve to the bit: both rational or neither, a patch each side
    onePoint,  // the same, and the curve is a point
    recorded,  // by edge records; own borders run anyhow between the curve's ends. Any kinds, rows of patches of levels 0 to 3
};

[[nodiscard]] SharedBorder sharedBorder(BorderLook look, reference::Random& random);

// Whether (u, v), in units of 2^-24, lies on the user's border; and if so where on the curve, in units of 2^-32.
[[nodiscard]] bool onBorder(const BorderUser& user, std::uint32_t u, std::uint32_t v);
[[nodiscard]] std::uint64_t alongCurve(const BorderUser& user, std::uint32_t u, std::uint32_t v);

}  // namespace tessera::splitting
