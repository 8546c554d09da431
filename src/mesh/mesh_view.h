// From options to what the kernels measure patches by.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/mesh_shared.h"
#include "surface/patch_shared.h"
#include "tessera/scene.h"
#include "tessera/tessellator.h"

namespace tessera {

// How large the coordinates of a scene's control points are in the world, at most: what rounding is in proportion to.
class SceneReach {
public:
    SceneReach() = default;
    explicit SceneReach(const Scene& scene);
    // Mesh `index` of the scene has other points now.
    void update(const Scene& scene, std::size_t index);
    // By the boxes of meshes in their objects' places, so that it may be somewhat more than it need be.
    [[nodiscard]] double greatest(const Scene& scene) const;

private:
    std::vector<Bounds> boxes_;  // of each mesh, in its own space
    std::vector<std::size_t> meshOfObject_;
};

// The view of the options; `patches` and `first_patch` are left to the caller. `greatest`: the scene's greatest coordinate. What vertices
// lose to rounding is taken off the tolerance. Throws Error, which begins with the scene's name, on options that are not valid and where
// the tolerance is below the least that 32-bit positions can hold, which it names.
[[nodiscard]] mesh_view setUpView(const TessellateOptions& options, const std::string& sceneName, double greatest);

// The scene's objects as place.cl takes them to world space, by index.
[[nodiscard]] std::vector<placed_object> worldObjects(const Scene& scene);

}  // namespace tessera
