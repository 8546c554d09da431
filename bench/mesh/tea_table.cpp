// The tea table: a teapot, cups and what belongs to them on a round table with a cloth, of quadrics, tori and a NURBS sheet.
#include "mesh/mesh_scenes.h"
#include "mesh/placing.h"
#include "tessera/surfaces.h"

#include <glm/gtc/constants.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace tessera::bench {

namespace {

constexpr glm::vec3 kWood{0.4F, 0.22F, 0.1F};
constexpr glm::vec3 kChina{0.85F, 0.86F, 0.9F};
constexpr glm::vec3 kTea{0.45F, 0.2F, 0.05F};
constexpr glm::vec3 kLinen{0.75F, 0.7F, 0.6F};
constexpr glm::vec3 kSilver{0.6F, 0.62F, 0.65F};

void revolve(Scene& scene, Mesh mesh, const glm::vec3& at, const glm::vec3& color) {
    place(scene, addMesh(scene, std::move(mesh)), at, upright(), color);
}

// Top at y = 0, radius 9: 16 patches, and 12 a leg.
void addTable(Scene& scene) {
    const glm::quat downward = glm::angleAxis(glm::half_pi<float>(), glm::vec3(1.0F, 0.0F, 0.0F));
    revolve(scene, disk("table top", 0.0, 9.0), glm::vec3(0.0F), kWood);
    place(scene, addMesh(scene, disk("table bottom", 0.0, 9.0)), {0.0F, -0.4F, 0.0F}, downward, kWood);
    revolve(scene, torus("table rim", 9.0, 0.2, -90.0, 90.0), {0.0F, -0.2F, 0.0F}, kWood);
    for (int leg = 0; leg < 4; ++leg) {
        const float x = leg % 2 == 0 ? -5.5F : 5.5F;
        const float z = leg / 2 == 0 ? -5.5F : 5.5F;
        revolve(scene, hyperboloid("leg", {0.3, 0.0, -8.0}, {0.2, 0.4, -0.4}), {x, 0.0F, z}, kWood);
        revolve(scene, sphere("foot", 0.45, -0.45, 0.45), {x, -8.2F, z}, kWood);
    }
}

// 24 patches of one sheet, that lies in waves.
void addCloth(Scene& scene) {
    Nurbs sheet;
    sheet.name = "cloth";
    sheet.uCount = 9;
    constexpr std::size_t rows = 7;
    const auto uniform = [](std::size_t count) {
        std::vector<double> knots;
        for (std::size_t i = 0; i < count + 4; ++i) knots.push_back(static_cast<double>(i));
        return knots;
    };
    sheet.uKnots = uniform(sheet.uCount);
    sheet.vKnots = uniform(rows);
    for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < sheet.uCount; ++i) {
            const double x = 1.9 * (static_cast<double>(i) - 4.0);
            const double z = 1.9 * (static_cast<double>(j) - 3.0);
            const double height = 0.12 + 0.1 * std::sin(1.7 * x) * std::cos(1.3 * z);
            sheet.points.emplace_back(x, height, -z);
        }
    }
    place(scene, addMesh(scene, nurbsMesh(sheet)), glm::vec3(0.0F), glm::quat(1.0F, 0.0F, 0.0F, 0.0F), kLinen);
}

// A ring's half beside an upright axis, `toward` its side in the x-z plane.
void addHandle(Scene& scene, const std::string& name, double radius, double thickness, const glm::vec3& at, float toward) {
    const glm::quat sideways = glm::angleAxis(-glm::half_pi<float>(), glm::vec3(0.0F, 0.0F, 1.0F));
    const glm::quat turned = glm::angleAxis(toward, glm::vec3(0.0F, 1.0F, 0.0F)) * sideways;
    place(scene, addMesh(scene, torus(name, radius, thickness, 0.0, 360.0, 180.0)), at, turned, kChina);
}

// A cup of 32 patches on a saucer of 8.
void addCup(Scene& scene, const glm::vec3& at, float toward) {
    revolve(scene, disk("saucer", 0.0, 0.8), at + glm::vec3(0.0F, 0.05F, 0.0F), kChina);
    revolve(scene, hyperboloid("saucer rim", {0.8, 0.0, 0.0}, {1.5, 0.0, 0.25}), at + glm::vec3(0.0F, 0.05F, 0.0F), kChina);
    const glm::vec3 foot = at + glm::vec3(0.0F, 0.1F, 0.0F);
    revolve(scene, cylinder("cup foot", 0.4, 0.0, 0.2), foot, kChina);
    revolve(scene, paraboloid("cup outside", 0.9, 0.1, 1.3), foot, kChina);
    revolve(scene, paraboloid("cup inside", 0.82, 0.18, 1.3), foot, kChina);
    revolve(scene, torus("cup lip", 0.86, 0.04, 0.0, 180.0), foot + glm::vec3(0.0F, 1.3F, 0.0F), kChina);
    revolve(scene, disk("tea", 1.1, 0.75), foot, kTea);
    const glm::vec3 side(std::cos(toward), 0.0F, -std::sin(toward));
    addHandle(scene, "cup handle", 0.35, 0.07, foot + 0.75F * side + glm::vec3(0.0F, 0.8F, 0.0F), toward);
}

// Tray 20, teapot 32.
void addTeapot(Scene& scene) {
    revolve(scene, disk("tray", 0.25, 3.4), glm::vec3(0.0F), kSilver);
    revolve(scene, torus("tray rim", 3.4, 0.12), {0.0F, 0.3F, 0.0F}, kSilver);
    const Scene pot = builtinScene("teapot");
    scene.meshes.push_back(pot.meshes.front());
    Object object = pot.objects.front();
    object.transform.translation += glm::vec3(0.0F, 0.27F, 0.0F);
    scene.objects.push_back(std::move(object));
}

// Sugar 16, milk 16.
void addSugarAndMilk(Scene& scene) {
    const glm::vec3 sugar(-4.2F, 0.95F, 2.2F);
    revolve(scene, sphere("sugar bowl", 1.0, -0.8, 0.5), sugar, kChina);
    revolve(scene, sphere("sugar lid", 1.0, 0.5, 0.95), sugar, kChina);
    revolve(scene, sphere("sugar knob", 0.2, -0.2, 0.2), sugar + glm::vec3(0.0F, 1.1F, 0.0F), kSilver);
    const glm::vec3 milk(4.3F, 0.2F, 2.4F);
    revolve(scene, disk("milk bottom", 0.0, 0.8), milk, kChina);
    revolve(scene, hyperboloid("milk jug", {0.8, 0.0, 0.0}, {0.35, 0.5, 1.8}), milk, kChina);
    addHandle(scene, "milk handle", 0.5, 0.08, milk + glm::vec3(0.6F, 0.9F, 0.0F), 0.0F);
}

}  // namespace

Scene teaTable() {
    Scene scene;
    scene.name = "tea_table";
    addTable(scene);
    addCloth(scene);
    addTeapot(scene);
    addSugarAndMilk(scene);
    constexpr std::array<glm::vec3, 4> cups{{{-5.4F, 0.15F, -1.8F}, {5.4F, 0.15F, -1.8F}, {-1.8F, 0.15F, 5.2F}, {1.9F, 0.15F, 5.2F}}};
    for (std::size_t i = 0; i < cups.size(); ++i) addCup(scene, cups[i], 0.7F * static_cast<float>(i));
    addLamps(scene);
    addView(scene, "camera", {6.0F, 10.0F, 19.0F}, {0.0F, -2.2F, 0.0F}, 46.0F);
    return scene;
}

}  // namespace tessera::bench
