// Built-in scenes of exact surfaces: a sphere, a torus, all quadrics, and NURBS.
#include "scene/builtin_scenes.h"
#include "tessera/surfaces.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

namespace tessera {

namespace {

// Stands `mesh`, modelled z up, at a place in the world.
void stand(Scene& scene, Mesh mesh, const glm::vec3& place, const glm::vec3& color, const Material& material) {
    Object object;
    object.name = mesh.name;
    object.mesh = mesh.name;
    object.transform = {place, uprightRotation()};
    object.color = color;
    object.material = material;
    scene.meshes.push_back(std::move(mesh));
    scene.objects.push_back(std::move(object));
}

// Rational meshes as one, so that a solid is closed within a mesh.
Mesh joined(std::string name, std::initializer_list<Mesh> parts) {
    Mesh whole;
    whole.name = std::move(name);
    whole.kind = PatchKind::rational;
    for (const Mesh& part : parts) {
        whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
        whole.weights.insert(whole.weights.end(), part.weights.begin(), part.weights.end());
    }
    return whole;
}

constexpr Material kGlazed{MaterialKind::plastic, 0.4F, 0.1F};
constexpr Material kMatte{MaterialKind::matte, 0.0F, 1.0F};

struct Ring {
    double radius;
    double height;
    double lobes;  // how far the ridges stand out, as part of the radius
};

// Goes up the outside from the middle of the foot, over the lip and down the inside to the middle again: a closed solid.
constexpr std::array<Ring, 15> kVase{{
    {0.0, 0.0, 0.0},
    {0.5, 0.0, 0.0},
    {0.72, 0.0, 0.02},
    {0.8, 0.12, 0.04},
    {1.3, 0.6, 0.1},
    {1.35, 1.3, 0.12},
    {0.3, 1.95, 0.12},
    {0.62, 2.75, 0.2},
    {1.05, 3.0, 0.24},
    {0.98, 3.04, 0.24},
    {0.5, 2.75, 0.2},
    {0.18, 1.95, 0.12},
    {1.2, 1.3, 0.12},
    {0.9, 0.2, 0.0},
    {0.0, 0.2, 0.0},
}};

// Around: a periodic cubic with a heavy point on each ridge, which sharpens it, turning with height. Up: a cubic whose knots lie close
// where the lip bends.
Nurbs vase() {
    constexpr std::size_t kAround = 12, kWrapped = kAround + 3;
    Nurbs surface;
    surface.name = "vase";
    surface.uCount = kWrapped;
    for (std::size_t i = 0; i < kWrapped + 4; ++i) surface.uKnots.push_back(static_cast<double>(i));
    surface.vKnots = {0.0, 0.0, 0.0, 0.0, 0.4, 0.6, 1.2, 2.2, 3.2, 4.2, 4.5, 4.7, 5.4, 6.4, 7.4, 8.4, 8.4, 8.4, 8.4};
    for (const Ring& ring : kVase) {
        for (std::size_t i = 0; i < kWrapped; ++i) {
            const std::size_t point = i % kAround;
            const bool ridge = point % 2 == 0;
            const double angle = glm::radians(360.0 * static_cast<double>(point) / static_cast<double>(kAround) + 25.0 * ring.height);
            const double radius = ring.radius * (ridge ? 1.0 + ring.lobes : 1.0 - ring.lobes);
            surface.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), ring.height);
            surface.weights.push_back(ridge ? 2.0 : 1.0);
        }
    }
    return surface;
}

// A true circle, of degree 2 and nine points, around a profile of degree 1.
Nurbs tray() {
    constexpr std::array<std::array<double, 2>, 9> kSquare{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}};
    constexpr std::array<std::array<double, 2>, 6> kProfile{
        {{0.0, -0.12}, {1.5, -0.12}, {2.0, 0.14}, {1.92, 0.17}, {1.45, 0.0}, {0.0, 0.0}}};
    Nurbs surface;
    surface.name = "tray";
    surface.uDegree = 2;
    surface.vDegree = 1;
    surface.uCount = kSquare.size();
    surface.uKnots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
    surface.vKnots = {0, 0, 1.5, 2.0, 2.1, 2.6, 4.0, 4.0};
    for (const auto& [radius, height] : kProfile) {
        for (std::size_t i = 0; i < kSquare.size(); ++i) {
            surface.points.emplace_back(radius * kSquare[i][0], radius * kSquare[i][1], height);
            surface.weights.push_back(i % 2 == 0 ? 1.0 : std::sqrt(0.5));
        }
    }
    return surface;
}

}  // namespace

Scene sphereScene() {
    Scene scene;
    scene.name = "sphere";
    stand(scene, sphere("sphere", 1.0, -1.0, 1.0), glm::vec3(0.0F), {0.09F, 0.27F, 0.62F}, kGlazed);
    addStudioLights(scene);
    addCamera(scene, {1.7F, 2.0F, 5.0F}, glm::vec3(0.0F), 26.0F);
    return scene;
}

Scene torusScene() {
    Scene scene;
    scene.name = "torus";
    stand(scene, torus("torus", 1.0, 0.4), glm::vec3(0.0F), {0.72F, 0.34F, 0.05F}, kGlazed);
    addStudioLights(scene);
    addCamera(scene, {1.8F, 3.6F, 5.0F}, glm::vec3(0.0F), 25.0F);
    return scene;
}

Scene quadricsScene() {
    Scene scene;
    scene.name = "quadrics";
    const glm::vec3 red(0.6F, 0.09F, 0.05F), ochre(0.68F, 0.4F, 0.07F), green(0.12F, 0.4F, 0.13F), blue(0.1F, 0.25F, 0.58F);
    const glm::vec3 violet(0.34F, 0.14F, 0.45F), cyan(0.08F, 0.42F, 0.45F), grey(0.5F);

    stand(scene, disk("ground", 0.0, 4.7), glm::vec3(0.0F), grey, kMatte);
    // Behind: solids. A bottom that is swept the other way faces down.
    stand(scene, joined("cone", {cone("", 2.2, 0.9), disk("", 0.0, 0.9, -360.0)}), {-2.7F, 0.0F, -1.6F}, red, kGlazed);
    stand(scene, joined("cylinder", {cylinder("", 0.8, 0.0, 1.9), disk("", 1.9, 0.8), disk("", 0.0, 0.8, -360.0)}), {0.0F, 0.0F, -2.1F},
          ochre, kGlazed);
    stand(scene, joined("dome", {sphere("", 1.25, -0.75, 1.25), disk("", -0.75, 1.0, -360.0)}), {2.7F, 0.75F, -1.6F}, green, kGlazed);
    // In front: open, or swept in part.
    stand(scene, paraboloid("paraboloid", 0.9, 0.0, 1.3), {-2.9F, 0.0F, 1.5F}, cyan, kGlazed);
    stand(scene, sphere("sphere", 0.85, -0.85, 0.7, 250.0), {-0.95F, 0.85F, 1.1F}, blue, kGlazed);
    stand(scene, hyperboloid("hyperboloid", {0.8, 0.0, 0.0}, {-0.45, 0.66, 1.7}), {1.15F, 0.0F, 0.9F}, violet, kGlazed);
    stand(scene, torus("torus", 0.7, 0.25, 0.0, 360.0, 260.0), {3.0F, 0.25F, 1.6F}, red, kGlazed);

    addStudioLights(scene);
    addCamera(scene, {0.9F, 5.4F, 12.4F}, {0.05F, 0.35F, 0.0F}, 29.5F);
    return scene;
}

Scene nurbsScene() {
    Scene scene;
    scene.name = "nurbs";
    stand(scene, nurbsMesh(vase()), glm::vec3(0.0F), {0.1F, 0.3F, 0.42F}, kGlazed);
    stand(scene, nurbsMesh(tray()), glm::vec3(0.0F), {0.5F, 0.28F, 0.1F}, kGlazed);
    addStudioLights(scene);
    addCamera(scene, {2.6F, 4.4F, 8.4F}, {0.0F, 1.28F, 0.0F}, 28.5F);
    return scene;
}

}  // namespace tessera
