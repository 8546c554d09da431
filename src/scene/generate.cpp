// The scenes that are made by rule: their names, the ranges of their counts, and who makes them.
#include "tessera/generate.h"

#include "scene/builtin_scenes.h"
#include "scene/generate_families.h"
#include "scene/text.h"
#include "tessera/error.h"

namespace tessera {

namespace {

using Maker = Scene (*)(const Making& making);

struct Family {
    GeneratedScene about;
    Maker make;
};

// Scenes of own patches end where an .mscene file, 1 GiB at most, does: 48 floats a patch and what packing adds to them.
const std::vector<Family>& families() {
    static const std::vector<Family> all{
        {{"hair", "strands", 1, 1000000, 10000, "strands of four ribbon patches each, combed over a head"}, generateHair},
        {{"columns", "columns", 1, 100000, 40, "a hall of fluted columns"}, generateColumns},
        {{"city", "patches", 20000, 20000000, 1000000, "streets, towers, trees; cameras average, spike and eyesplit"}, generateCity},
        {{"eyesplit", "patches", 1, 1, 1, "a plane patch that passes its camera's eye plane"}, generateEyesplit},
        {{"random", "patches", 1, 4000000, 10000, "patches of random points"}, generateRandomPatches},
        {{"spheres", "spheres", 1, 1000000, 100, "exact rational spheres, eight patches each"}, generateSpheres},
    };
    return all;
}

const Family& familyOf(std::string_view name) {
    std::string known;
    for (const Family& family : families()) {
        if (family.about.name == name) return family;
        known += (known.empty() ? "" : ", ") + std::string(family.about.name);
    }
    throw Error("no scene " + quotedName(name) + " can be generated; there is: " + known);
}

}  // namespace

const std::vector<GeneratedScene>& generatedScenes() {
    static const std::vector<GeneratedScene> scenes = [] {
        std::vector<GeneratedScene> list;
        for (const Family& family : families()) list.push_back(family.about);
        return list;
    }();
    return scenes;
}

std::vector<std::string_view> generatedSceneNames() {
    std::vector<std::string_view> names;
    for (const Family& family : families()) names.push_back(family.about.name);
    return names;
}

Scene generateScene(std::string_view name, std::optional<std::uint64_t> count, std::uint32_t seed, const Progress& progress) {
    const Family& family = familyOf(name);
    const GeneratedScene& about = family.about;
    const std::uint64_t wanted = count.value_or(about.usual);
    if (wanted < about.least || wanted > about.most) {
        throw Error("generate " + std::string(name) + ": a count of " + std::to_string(wanted) + " is out of range; give " +
                    std::to_string(about.least) + " to " + std::to_string(about.most) + " " + std::string(about.counted));
    }
    Scene scene = family.make({wanted, seed, progress});
    scene.name = name;
    return scene;
}

void addObject(Scene& scene, const std::string& mesh, std::string name, const glm::dvec3& at, const glm::vec3& color,
               const Material& material) {
    Object object;
    object.name = std::move(name);
    object.mesh = mesh;
    object.transform.translation = at;
    object.color = color;
    object.material = material;
    scene.objects.push_back(std::move(object));
}

void addNamedCamera(Scene& scene, std::string name, const glm::vec3& eye, const glm::vec3& target, float fovyDegrees) {
    addCamera(scene, eye, target, fovyDegrees);
    scene.cameras.back().name = std::move(name);
}

void addDaylight(Scene& scene) {
    scene.lights.push_back(lightFrom("sun", LightKind::directional, {-0.55F, 0.7F, 0.6F}, {1.0F, 0.95F, 0.85F}, 1.0F));
    scene.lights.push_back(lightFrom("sky", LightKind::hemi, {0.0F, 1.0F, 0.0F}, {0.8F, 0.9F, 1.0F}, 0.4F));
}

}  // namespace tessera
