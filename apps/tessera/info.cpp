// `tessera info`: what a scene holds, and how a frame of it would use memory.
#include "choose_camera.h"
#include "commands.h"
#include "console.h"
#include "load_scene.h"
#include "mode_options.h"
#include "plan_options.h"
#include "render_arguments.h"
#include "shared_options.h"
#include "show_plan.h"
#include "subdivision_json.h"
#include "tessera/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace tessera::program {

namespace {

using Json = nlohmann::ordered_json;

// The float as it would be typed: as a double 2.6 would print as 2.5999999046325684.
Json jsonOf(float value) { return std::isfinite(value) ? Json::parse(shortest(value)) : Json(); }

Json jsonOf(const glm::vec3& v) { return {jsonOf(v.x), jsonOf(v.y), jsonOf(v.z)}; }

Json jsonOf(const Transform& transform) {
    const glm::quat& q = transform.rotation;
    return {{"translation", jsonOf(transform.translation)}, {"rotation", {jsonOf(q.w), jsonOf(q.x), jsonOf(q.y), jsonOf(q.z)}}};
}

std::string textOf(const glm::vec3& v) {
    const glm::vec3 unsignedZeros = v + 0.0F;
    return "(" + shortest(unsignedZeros.x) + " " + shortest(unsignedZeros.y) + " " + shortest(unsignedZeros.z) + ")";
}

// The world direction of the local -z axis, to six decimals: where cameras look and directional lights shine.
glm::vec3 forward(const Transform& transform) {
    const glm::dvec3 direction = rotationMatrix(transform) * glm::dvec3(0.0, 0.0, -1.0);
    return {glm::round(direction * 1e6) / 1e6};
}

std::string_view name(MaterialKind kind) { return kind == MaterialKind::matte ? "matte" : "plastic"; }

// Patches over all objects, by kind: what is rendered, so a mesh counts once an object that uses it.
std::map<std::string, std::uint64_t> placedPatches(const Scene& scene) {
    std::map<std::string, std::uint64_t> patches;
    for (const Object& object : scene.objects) {
        const Mesh* mesh = scene.findMesh(object.mesh);
        if (mesh != nullptr) patches[std::string(name(mesh->kind))] += mesh->patchCount();
    }
    return patches;
}

// Lengths in scene units.
Json edgesJson(const WeldReport& weld) {
    return {{"tolerance", weld.tolerance},
            {"edges", weld.edges},
            {"matched", weld.matchedEdges},
            {"boundary", weld.boundaryEdges},
            {"degenerate", weld.degenerateEdges},
            {"collapsed", weld.collapsedEdges},
            {"snapped_points", weld.snappedPoints},
            {"records", weld.recordedEdges},
            {"shared_by_three_or_more", weld.overusedEdges},
            {"largest_gap", weld.largestGap},
            {"nearest_miss", weld.nearestMiss > 0.0 ? Json(weld.nearestMiss) : Json()}};
}

Json objectJson(const Scene& scene, const Object& object) {
    const Mesh* mesh = scene.findMesh(object.mesh);
    Json json = {{"name", object.name},
                 {"mesh", object.mesh},
                 {"type", mesh == nullptr ? Json() : Json(std::string(name(mesh->kind)))},
                 {"patches", mesh == nullptr ? 0 : mesh->patchCount()},
                 {"color", jsonOf(object.color)},
                 {"transform", jsonOf(object.transform)}};
    json["material"] = {{"type", std::string(name(object.material.kind))},
                        {"specular", jsonOf(object.material.specular)},
                        {"roughness", jsonOf(object.material.roughness)}};
    return json;
}

// Without the plan.
Json sceneJson(const LoadedScene& loaded) {
    const Scene& scene = loaded.scene;
    const Bounds bounds = worldBounds(scene);
    Json json = {{"scene", scene.name}, {"patches", scene.placedPatchCount()}, {"patch_types", Json::object()}};
    for (const auto& [kind, count] : placedPatches(scene)) json["patch_types"][kind] = count;
    json["bounds"] = bounds.empty() ? Json() : Json{{"lower", jsonOf(bounds.lower)}, {"upper", jsonOf(bounds.upper)}};
    json["edges"] = edgesJson(loaded.weld);
    json["subdivision"] = subdivisionJson(loaded.cages);
    for (const auto* list : {"cameras", "lights", "objects", "meshes"}) json[list] = Json::array();
    for (const Camera& camera : scene.cameras) {
        json["cameras"].push_back({{"name", camera.name},
                                   {"transform", jsonOf(camera.transform)},
                                   {"near", jsonOf(camera.near)},
                                   {"far", jsonOf(camera.far)},
                                   {"fovy", jsonOf(camera.fovy)}});
    }
    for (const Light& light : scene.lights) {
        json["lights"].push_back({{"name", light.name},
                                  {"type", std::string(name(light.kind))},
                                  {"color", jsonOf(light.color)},
                                  {"intensity", jsonOf(light.intensity)},
                                  {"transform", jsonOf(light.transform)}});
    }
    for (const Object& object : scene.objects) json["objects"].push_back(objectJson(scene, object));
    for (const Mesh& mesh : scene.meshes) {
        json["meshes"].push_back({{"name", mesh.name}, {"type", std::string(name(mesh.kind))}, {"patches", mesh.patchCount()}});
    }
    json["warnings"] = loaded.warnings;
    return json;
}

std::string cameraText(const Camera& camera) {
    return "camera  '" + oneLine(camera.name) + "' at " + textOf(camera.transform.translation) + " looking along " +
           textOf(forward(camera.transform)) + ", fovy " + shortest(camera.fovy) + " degrees, near " + shortest(camera.near) + ", far " +
           shortest(camera.far) + "\n";
}

std::string lightText(const Light& light) {
    std::string place;
    if (light.kind == LightKind::point) place = " at " + textOf(light.transform.translation);
    if (light.kind == LightKind::directional) place = " shining along " + textOf(forward(light.transform));
    if (light.kind == LightKind::hemi) place = " around " + textOf(-forward(light.transform));
    return "light   '" + oneLine(light.name) + "', " + std::string(name(light.kind)) + place + ", color " + textOf(light.color) +
           ", intensity " + shortest(light.intensity) + "\n";
}

std::string objectText(const Scene& scene, const Object& object) {
    const Mesh* mesh = scene.findMesh(object.mesh);
    std::string patches = "no patches";
    if (mesh != nullptr) patches = counted(mesh->patchCount(), "patch", "patches") + " of type " + std::string(name(mesh->kind));
    return "object  '" + oneLine(object.name) + "' of mesh '" + oneLine(object.mesh) + "', " + patches + ", " +
           std::string(name(object.material.kind)) + ", color " + textOf(object.color) + ", at " + textOf(object.transform.translation) +
           "\n";
}

std::string edgesText(const WeldReport& weld) {
    std::string text = "edges   " + std::to_string(weld.edges) + ": " + std::to_string(weld.matchedEdges) + " matched by a neighbour's, " +
                       std::to_string(weld.boundaryEdges) + " boundary, without one";
    if (weld.overusedEdges > 0) text += "; " + std::to_string(weld.overusedEdges) + " shared by three patches or more";
    text += "\n        " + std::to_string(weld.degenerateEdges) + " more are degenerate, one point; " +
            std::to_string(weld.collapsedEdges) + " of them collapsed here, being shorter than the tolerance\n";
    text += "weld    within " + about(weld.tolerance) + " units: " + counted(weld.snappedPoints, "control point", "control points") +
            " moved, largest gap " + about(weld.largestGap) + " units; " + counted(weld.recordedEdges, "edge record", "edge records") +
            " for neighbours of another kind or level\n";
    if (weld.nearestMiss > 0.0) {
        text += "        nearest miss " + about(weld.nearestMiss) +
                " units: least distance of boundary edges with the same ends; a crack in the data, if it is small\n";
    }
    return text;
}

std::string infoText(const LoadedScene& loaded) {
    const Scene& scene = loaded.scene;
    std::string text = "scene   " + oneLine(scene.name) + "\npatches " + std::to_string(scene.placedPatchCount());
    std::string separator = ": ";
    for (const auto& [kind, count] : placedPatches(scene)) {
        text += separator + std::to_string(count) + " " + kind;
        separator = ", ";
    }
    const Bounds bounds = worldBounds(scene);
    text += "\nbounds  " + (bounds.empty() ? std::string("empty") : textOf(bounds.lower) + " to " + textOf(bounds.upper)) + "\n";
    text += edgesText(loaded.weld);
    for (const CageReport& report : loaded.cages) text += subdivisionText(report);
    for (const Camera& camera : scene.cameras) text += cameraText(camera);
    if (scene.cameras.empty()) text += "camera  none: a picture frames the whole scene\n";
    for (const Light& light : scene.lights) text += lightText(light);
    if (scene.lights.empty()) text += "light   none: a picture has a head-light\n";
    for (const Object& object : scene.objects) text += objectText(scene, object);
    return text;
}

struct InfoArguments {
    RenderArguments render;  // what a frame would be rendered with
    bool json = false;
    bool plan = false;
};

struct ShownPlan {
    DeviceInfo device;
    MemoryPlan plan;
};

std::optional<ShownPlan> planFor(InfoArguments& arguments, const Scene& scene) {
    if (!arguments.plan) return std::nullopt;
    RenderOptions& options = arguments.render.options;
    if (arguments.render.dicingCamera) options.dicingCamera = namedCamera(scene, *arguments.render.dicingCamera, "--dicing-camera");
    const DeviceInfo device = findDevice(arguments.render.settings.device);
    return ShownPlan{device, planMemory(options, scene, device)};
}

void showInfo(InfoArguments arguments) {
    checkFrameOptions(arguments.render);
    const LoadedScene loaded = loadScene(arguments.render.scene, false);
    const std::optional<ShownPlan> shown = planFor(arguments, loaded.scene);
    if (arguments.json) {
        Json json = sceneJson(loaded);
        if (shown) json["plan"] = planJson(shown->plan, shown->device);
        printResult(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
        return;
    }
    for (const std::string& warning : loaded.warnings) printNote(warning);
    printResult(infoText(loaded) + (shown ? planText(shown->plan, shown->device) : ""));
}

// --plan, and what needs it.
void addPlanOptions(CLI::App& app, InfoArguments& arguments) {
    CLI::Option* const plan =
        app.add_flag("--plan", arguments.plan, "Tell how rendering it would use the device's memory")->group("Memory plan");
    const std::vector<CLI::Option*> before = app.get_options();
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    addSizeOptions(app, arguments.render.options);
    addMemoryOptions(app, arguments.render.options);
    addModeOptions(app, arguments.render, ModeOptions::ofMemory);
    addDeviceOption(app, arguments.render.settings.device);
    for (CLI::Option* const option : app.get_options()) {
        if (std::find(before.begin(), before.end(), option) != before.end()) continue;
        option->needs(plan);
        if (option->get_group() == "Options") option->group("Memory plan");
    }
}

}  // namespace

Command addInfoCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "info", "Tell what a scene holds, how its patches' edges meet, what its cages became,\nand what memory it takes");
    command->get_formatter()->column_width(34);
    const auto arguments = std::make_shared<InfoArguments>();
    addSceneArguments(*command, arguments->render.scene, "Options");
    command->add_flag("--json", arguments->json, "Print JSON instead of text");
    addPlanOptions(*command, *arguments);
    return {command, [arguments] { showInfo(*arguments); }};
}

}  // namespace tessera::program
