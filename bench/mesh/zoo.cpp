// The zoo: beasts that are balls with limbs drawn out of them, a snake and a knot, 80578 triangles of closed meshes.
#include "mesh/closed_meshes.h"
#include "mesh/mesh_scenes.h"
#include "mesh/placing.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tessera::bench {

namespace {

// Something drawn out of a ball: a leg, a neck, an ear.
struct Limb {
    glm::dvec3 toward;     // direction, of any length
    double length = 0.5;   // beyond the ball's radius of 1
    double slimness = 20;  // the greater the thinner
};

struct Beast {
    std::string name;
    std::uint32_t cuts = 4;  // 5120 triangles, four times as many with each more
    glm::dvec3 size{1.0};    // the ball's half axes
    std::vector<Limb> limbs;
};

// Four legs below, at the corners of a ball's underside.
std::vector<Limb> legs(double length, double slimness) {
    std::vector<Limb> four;
    for (const double x : {-1.0, 1.0}) {
        for (const double z : {-1.0, 1.0}) four.push_back({{0.9 * x, -1.1, 0.7 * z}, length, slimness});
    }
    return four;
}

Beast withLimbs(Beast beast, const std::vector<Limb>& more) {
    beast.limbs.insert(beast.limbs.end(), more.begin(), more.end());
    return beast;
}

TriangleMesh bodyOf(const Beast& beast) {
    return ball(beast.name, beast.cuts, [&beast](const glm::dvec3& direction) {
        double radius = 1.0;
        for (const Limb& limb : beast.limbs) {
            radius += limb.length * std::exp(limb.slimness * (glm::dot(direction, glm::normalize(limb.toward)) - 1.0));
        }
        return radius * direction * beast.size;
    });
}

// Eight of 5120 triangles and one of 20480.
std::vector<Beast> beasts() {
    std::vector<Beast> all;
    all.push_back(
        withLimbs({"elephant", 5, {1.6, 1.2, 1.0}, legs(0.9, 25)},
                  {{{1.0, 0.3, 0.0}, 0.5, 12}, {{1.0, -0.25, 0.0}, 1.1, 60}, {{0.8, 0.5, 0.9}, 0.5, 30}, {{0.8, 0.5, -0.9}, 0.5, 30}}));
    all.push_back(withLimbs({"giraffe", 4, {1.0, 1.0, 0.6}, legs(1.6, 40)}, {{{0.6, 1.0, 0.0}, 2.4, 40}, {{-1.0, 0.1, 0.0}, 0.5, 60}}));
    all.push_back(withLimbs({"bear", 4, {1.3, 1.0, 0.9}, legs(0.6, 15)}, {{{1.0, 0.4, 0.0}, 0.6, 10}, {{0.9, 0.9, 0.4}, 0.2, 60}}));
    all.push_back(withLimbs({"camel", 4, {1.2, 0.9, 0.7}, legs(1.2, 30)},
                            {{{0.5, 1.0, 0.0}, 0.6, 25}, {{-0.5, 1.0, 0.0}, 0.6, 25}, {{1.0, 0.5, 0.0}, 1.3, 35}}));
    all.push_back({"seal", 4, {1.8, 0.6, 0.7}, {{{1.0, 0.4, 0.0}, 0.5, 12}, {{-1.0, 0.0, 0.5}, 0.4, 50}, {{-1.0, 0.0, -0.5}, 0.4, 50}}});
    all.push_back(withLimbs({"tortoise", 4, {1.1, 0.6, 0.9}, legs(0.35, 20)}, {{{1.0, 0.1, 0.0}, 0.6, 25}}));
    all.push_back({"starfish", 4, {1.0, 0.3, 1.0}, {}});
    for (int arm = 0; arm < 5; ++arm) {
        const double turn = glm::two_pi<double>() * arm / 5.0;
        all.back().limbs.push_back({{std::cos(turn), 0.0, std::sin(turn)}, 1.4, 14});
    }
    all.push_back({"hedgehog", 4, {0.9, 0.6, 0.6}, {{{1.0, -0.2, 0.0}, 0.6, 20}}});
    for (int spine = 0; spine < 40; ++spine) {
        // A spiral over the upper half: the golden angle spreads the spines evenly.
        const double height = 0.1 + 0.88 * spine / 39.0;
        const double turn = 2.39996 * spine;
        const double out = std::sqrt(1.0 - height * height);
        all.back().limbs.push_back({{out * std::cos(turn), height, out * std::sin(turn)}, 0.35, 160});
    }
    all.push_back({"fish", 4, {1.4, 0.8, 0.35}, {{{-1.0, 0.45, 0.0}, 0.7, 40}, {{-1.0, -0.45, 0.0}, 0.7, 40}, {{0.1, 1.0, 0.0}, 0.4, 20}}});
    return all;
}

// A tube's ring about `centre`, in the plane that `outward` and `sideward` span.
glm::dvec3 onRing(const glm::dvec3& centre, const glm::dvec3& outward, const glm::dvec3& sideward, double radius, double turn) {
    return centre + radius * (std::cos(turn) * outward + std::sin(turn) * sideward);
}

// Coiled up thrice around the y axis, 19 sides of 251 rings: 9538 triangles.
TriangleMesh snake() {
    constexpr std::uint32_t rings = 251;
    constexpr std::uint32_t sides = 19;
    const auto spine = [](double t) {
        const double angle = 3.0 * glm::two_pi<double>() * t;
        return glm::dvec3((1.4 - 0.5 * t) * std::cos(angle), 1.5 * t, (1.4 - 0.5 * t) * std::sin(angle));
    };
    const auto point = [&](std::uint32_t i, std::uint32_t j) {
        const double t = (i + 1.0) / (rings + 1.0);
        const glm::dvec3 along = glm::normalize(spine(t + 1e-4) - spine(t - 1e-4));
        const glm::dvec3 sideward = glm::normalize(glm::cross(along, glm::dvec3(0.0, 1.0, 0.0)));
        const double radius = 0.24 * std::pow(t * (1.0 - t) * 4.0, 0.25);
        return onRing(spine(t), sideward, glm::cross(along, sideward), radius, glm::two_pi<double>() * j / sides);
    };
    return tippedTube("snake", rings, sides, point, spine(0.0), spine(1.0));
}

// A tube along a knot on a torus, twice around it and five times through it: 300 rings of 16 sides, 9600 triangles.
TriangleMesh knot() {
    constexpr std::uint32_t rings = 300;
    constexpr std::uint32_t sides = 16;
    const auto centre = [](double t) {
        const double radius = 1.3 + 0.5 * std::cos(5.0 * t);
        return glm::dvec3(radius * std::cos(2.0 * t), 0.5 * std::sin(5.0 * t), radius * std::sin(2.0 * t));
    };
    return ringTube("knot", rings, sides, [&](std::uint32_t i, std::uint32_t j) {
        const double t = glm::two_pi<double>() * i / rings;
        const glm::dvec3 along = glm::normalize(centre(t + 1e-4) - centre(t - 1e-4));
        const glm::dvec3 outward = glm::normalize(glm::cross(glm::cross(along, glm::dvec3(0.0, 1.0, 0.0)), along));
        return onRing(centre(t), outward, glm::cross(along, outward), 0.17, glm::two_pi<double>() * j / sides);
    });
}

}  // namespace

Scene zoo() {
    Scene scene;
    scene.name = "zoo";
    for (const Beast& beast : beasts()) scene.meshes.push_back(pnMesh(bodyOf(beast), false));
    scene.meshes.push_back(pnMesh(snake(), false));
    scene.meshes.push_back(pnMesh(knot(), false));
    constexpr std::array<glm::vec3, 4> colors{{{0.5F, 0.45F, 0.42F}, {0.7F, 0.5F, 0.2F}, {0.3F, 0.45F, 0.3F}, {0.6F, 0.3F, 0.25F}}};
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const std::size_t row = i / 4;
        const glm::vec3 at(5.0F * (static_cast<float>(i % 4) - 1.5F), 0.0F, 4.5F * (static_cast<float>(row) - 1.0F));
        place(scene, scene.meshes[i].name, at, glm::angleAxis(0.5F * static_cast<float>(i), glm::vec3(0.0F, 1.0F, 0.0F)),
              colors[i % colors.size()]);
    }
    addLamps(scene);
    addView(scene, "camera", {4.0F, 10.0F, 19.0F}, {0.0F, -0.8F, 0.0F}, 40.0F);
    return scene;
}

}  // namespace tessera::bench
