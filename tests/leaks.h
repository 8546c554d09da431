// What pictures show that they should not: the background where a solid certainly is, a solid's far side where its near side certainly is.
#pragma once

#include "frames.h"
#include "ray_caster.h"

#include "tessera/scene.h"

#include <string>

namespace tessera::test {

struct Leaks {
    int open = 0;     // pixels that are inside and show the background
    int through = 0;  // pixels that show what is behind the surface which they and all around them see
    int covered = 0;  // pixels that show the model alone
    std::string first;
};

// Of a picture by `camera` with a background whose alpha is below 1; `caster` is of what it shows, closed solids 2 wide or so.
[[nodiscard]] Leaks leaksOf(const Kept& picture, const reference::RayCaster& caster, const Camera& camera);

}  // namespace tessera::test
