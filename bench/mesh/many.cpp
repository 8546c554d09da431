// Scenes of one thing many times: spheres, stars, and the herd.
#include "mesh/closed_meshes.h"
#include "mesh/mesh_scenes.h"
#include "mesh/placing.h"

#include "scene/generate_numbers.h"
#include "tessera/error.h"
#include "tessera/generate.h"

#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cmath>
#include <cstdint>

namespace tessera::bench {

namespace {

constexpr int kStarsAlong = 12;
constexpr std::array<glm::vec3, 4> kStarColors{{{0.9F, 0.75F, 0.2F}, {0.85F, 0.4F, 0.15F}, {0.5F, 0.65F, 0.9F}, {0.9F, 0.88F, 0.8F}}};

// A cube with a spike on each face: 24 triangles.
TriangleMesh star() {
    TriangleMesh mesh;
    mesh.name = "star";
    constexpr float half = 0.12F;
    constexpr float reach = 0.36F;
    for (int corner = 0; corner < 8; ++corner) {
        mesh.positions.emplace_back((corner & 1) != 0 ? half : -half, (corner & 2) != 0 ? half : -half, (corner & 4) != 0 ? half : -half);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const int u = 1 << ((axis + 1) % 3);
        const int v = 1 << ((axis + 2) % 3);
        for (const int side : {0, 1 << axis}) {
            glm::vec3 tip(0.0F);
            tip[axis] = side != 0 ? reach : -reach;
            const auto last = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(tip);
            // Around the face, counter-clockwise seen along +axis for the upper one.
            const std::array<int, 4> around{side, side + u, side + u + v, side + v};
            for (std::size_t i = 0; i < around.size(); ++i) {
                auto from = static_cast<std::uint32_t>(around[i]);
                auto to = static_cast<std::uint32_t>(around[(i + 1) % around.size()]);
                if (side == 0) std::swap(from, to);
                mesh.triangles.push_back({from, to, last});
            }
        }
    }
    return mesh;
}

void placeStar(Scene& scene, Random& random, const glm::dvec3& at) {
    const glm::dvec3 axis = random.direction();
    const double turn = random.between(0.0, 6.28);
    const glm::quat turned(glm::angleAxis(turn, axis));
    place(scene, "star", glm::vec3(at), turned, kStarColors[random.below(kStarColors.size())]);
}

}  // namespace

Scene sphereCloud() {
    Scene scene = generateScene("spheres", 4000);
    scene.name = "spheres";
    scene.cameras.clear();
    addView(scene, "far", {2.6F, 2.2F, 6.2F}, glm::vec3(0.0F), 29.0F);
    addView(scene, "near", {0.35F, 0.25F, 0.8F}, {-0.3F, -0.2F, -1.0F}, 60.0F);
    return scene;
}

Scene starField() {
    Scene scene;
    scene.name = "star_field";
    scene.meshes.push_back(pnMesh(star(), false));
    Random random(1729);
    for (int i = 0; i < kStarsAlong * kStarsAlong * kStarsAlong; ++i) {
        const glm::dvec3 cell(i % kStarsAlong, i / kStarsAlong % kStarsAlong, i / (kStarsAlong * kStarsAlong));
        const glm::dvec3 off = random.within(0.14);
        placeStar(scene, random, cell - 0.5 * (kStarsAlong - 1) + off);
    }
    // 1729 is a cube and one: it hangs above the others.
    placeStar(scene, random, {0.0, 0.5 * kStarsAlong + 0.6, 0.0});
    addLamps(scene);
    addView(scene, "far", {11.0F, 9.0F, 31.0F}, glm::vec3(0.0F), 32.0F);
    addView(scene, "close", {0.9F, 1.1F, 5.2F}, {-1.0F, 0.0F, -6.0F}, 45.0F);
    return scene;
}

Scene herd(const Scene& single) {
    const Bounds bounds = worldBounds(single);
    if (bounds.empty()) throw Error("a herd of scene '" + single.name + "': it has no objects");
    Scene scene = single;
    scene.name = single.name + "_herd";
    scene.objects.clear();
    const glm::vec3 step = 1.1F * (bounds.upper - bounds.lower);
    for (int i = 0; i < 8; ++i) {
        const int row = i / 4;
        const glm::vec3 off(step.x * (static_cast<float>(i % 4) - 1.5F), 0.0F, step.z * (static_cast<float>(row) - 0.5F));
        for (Object object : single.objects) {
            object.name += " " + std::to_string(i + 1);
            object.transform.translation += off;
            scene.objects.push_back(std::move(object));
        }
    }
    scene.cameras = {framingCamera(scene, 40.0F)};
    return scene;
}

}  // namespace tessera::bench
