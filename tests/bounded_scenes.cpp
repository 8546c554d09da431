// Scenes and views for tests of frames under budgets, in buckets and with culling.
#include "bounded_scenes.h"

#include "picture_scenes.h"
#include "sample_meshes.h"

#include "tessera/generate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <utility>

namespace tessera::test {
namespace {

struct Box {
    glm::dvec3 middle;
    glm::dvec3 half;
};

Box boxOf(const Scene& scene) {
    const Bounds bounds = worldBounds(scene);
    const glm::dvec3 lower(bounds.lower);
    const glm::dvec3 upper(bounds.upper);
    return {0.5 * (lower + upper), 0.5 * (upper - lower)};
}

ClosedModel closedModel(const std::string& name) {
    std::vector<ClosedModel> models = closedModels();
    const auto found = std::find_if(models.begin(), models.end(), [&](const ClosedModel& model) { return model.name == name; });
    return found == models.end() ? models.front() : *found;
}

Mesh scaled(Mesh mesh, float share, const std::string& suffix) {
    mesh.name += suffix;
    // The normals of triangles too: their length says nothing.
    for (glm::vec3& point : mesh.points) point *= share;
    for (EdgeRecord& record : mesh.edges)
        for (glm::vec3& point : record.points) point *= share;
    return mesh;
}

}  // namespace

std::vector<ClosedModel> boundedScenes() {
    using namespace reference;
    std::vector<ClosedModel> scenes;
    scenes.push_back({"mixed", mixedScene()});
    scenes.push_back({"solid", placedAnyhow({cubeSolid(71, 5)}, 72)});
    scenes.push_back({"kinds", placedAnyhow({bumpyBezierMesh(73, 20), parted(asGregory(bumpyBezierMesh(74, 20)), 0.2, 75),
                                             weighted(bumpyBezierMesh(76, 20), 5.0, 77), bumpyPnMesh(78, 40)},
                                            79)});
    scenes.push_back({"torus", closedModel("torus").scene});
    scenes.push_back({"teapot", builtinScene("teapot")});
    scenes.push_back({"hair", generateScene("hair", 40)});
    scenes.push_back({"random", generateScene("random", 200)});
    scenes.push_back({"eyesplit", generateScene("eyesplit")});
    return scenes;
}

Scene nested(const Scene& scene, int copies) {
    const glm::vec3 middle(boxOf(scene).middle);
    Scene result = scene;
    float share = 1.0F;
    for (int k = 1; k < copies; ++k) {
        share *= 0.85F;
        for (const Mesh& mesh : scene.meshes) result.meshes.push_back(scaled(mesh, share, " " + std::to_string(k)));
        for (Object object : scene.objects) {
            object.name += " " + std::to_string(k);
            object.mesh += " " + std::to_string(k);
            object.transform.translation = middle + share * (object.transform.translation - middle);
            result.objects.push_back(std::move(object));
        }
    }
    return result;
}

Camera viewFrom(const Scene& scene, bool inside, std::uint64_t seed) {
    reference::Random random(seed);
    const Box box = boxOf(scene);
    const double radius = glm::length(box.half);
    glm::dvec3 eye = box.middle + 0.7 * random.inCube(1.0) * box.half;
    glm::dvec3 target = box.middle + random.inCube(1.0) * box.half;
    if (!inside) {
        const glm::dvec3 way = glm::normalize(random.inCube(1.0) + glm::dvec3(0.01));
        eye = box.middle + random.between(1.1, 2.5) * radius * way;
        target = box.middle + 0.2 * random.inCube(1.0) * box.half;
    }
    Camera camera = reference::cameraAt(eye, target, random.between(25.0, 75.0));
    camera.near = static_cast<float>(random.between(0.002, 0.05) * radius);
    return camera;
}

bool canDraw(DiceMode mode, const Scene& scene) {
    const auto isNew = [](const Mesh& mesh) { return mesh.kind != PatchKind::bezier && mesh.kind != PatchKind::gregory; };
    return mode == DiceMode::watertight || std::none_of(scene.meshes.begin(), scene.meshes.end(), isNew);
}

void expectSameButTies(const Kept& whole, const Kept& part, std::size_t ties) {
    const Difference found = difference(whole, part);
    EXPECT_EQ(found.inDepth, 0U) << found.first;
    EXPECT_LE(found.pixels, ties) << found.first;
}

std::optional<std::uint64_t> memoryNamed(const std::string& error) {
    std::smatch found;
    if (!std::regex_search(error, found, std::regex("--memory ([0-9]+) would do"))) return std::nullopt;
    return std::stoull(found[1]);
}

std::string textOf(const RenderOptions& options) {
    return std::string(name(options.method)) + ", " + std::string(name(options.mode)) + ", " + std::to_string(options.pixelSamples) +
           " samples, batch " + std::to_string(options.batch) + ", bucket " + std::to_string(options.bucketWidth) + "x" +
           std::to_string(options.bucketHeight) + ", " + std::to_string(options.memoryBytes) + " bytes";
}

}  // namespace tessera::test
