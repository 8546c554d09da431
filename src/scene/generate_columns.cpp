// The generated scene "columns": a hall of fluted columns under beams, on a floor of slabs.
#include <array>
#include <cmath>
#include <cstddef>

#include "scene/builtin_scenes.h"
#include "scene/generate_families.h"
#include "scene/generate_numbers.h"
#include "scene/generate_sheets.h"

namespace tessera {

namespace {

constexpr double kSpacing = 3.2;
constexpr double kTop = 7.4;  // of a column

constexpr std::array<glm::vec3, 3> kStones{{{0.78F, 0.73F, 0.64F}, {0.74F, 0.69F, 0.6F}, {0.8F, 0.76F, 0.69F}}};
constexpr Material kStone{MaterialKind::plastic, 0.12F, 0.35F};

// A slab with rounded edges, closed all around: half its sides, and its height from 0.
void appendSlab(std::vector<glm::vec3>& points, double x, double z, double low, double high) {
    const double edge = 0.15 * (high - low);
    const Ring ring = wallRing({x - edge, z - edge, 0.02, 0, 0});
    const double reach = 0.5523 * edge;
    Profile profile({0.0, low});
    profile.line({1.0, low});
    profile.curve({1.0, low, reach}, {1.0, low + edge - reach, edge}, {1.0, low + edge, edge});
    profile.line({1.0, high - edge, edge});
    profile.curve({1.0, high - edge + reach, edge}, {1.0, high, reach}, {1.0, high});
    profile.line({0.0, high});
    appendTurned(points, ring, profile);
}

// A rounded ring bulging out by half its height, up to `high`.
void bulge(Profile& profile, double high) {
    const ProfilePoint start = profile.end();
    const double out = 0.66 * (high - start.height);
    ProfilePoint first = start;
    ProfilePoint second = start;
    first.grow += out;
    second.grow += out;
    second.height = high;
    ProfilePoint end = start;
    end.height = high;
    profile.curve(first, second, end);
}

// Base with two rounded rings, sixteen flutes that run out at both ends of a swelling shaft, and a capital below a slab.
Mesh columnMesh() {
    std::vector<glm::vec3> points;
    appendSlab(points, 0.74, 0.74, 0.0, 0.22);
    // Open at both ends, which lie on slabs.
    Profile profile({0.58, 0.22});
    bulge(profile, 0.42);
    profile.curve({0.53, 0.44}, {0.53, 0.5}, {0.57, 0.52});
    bulge(profile, 0.64);
    profile.curve({0.52, 0.64}, {0.5, 0.7}, {0.5, 0.85});
    profile.ease({0.497, 1.1, 0.0, 0.055});
    profile.curve({0.49, 2.8, 0.0, 0.055}, {0.45, 4.8, 0.0, 0.05}, {0.42, 6.3, 0.0, 0.046});
    profile.ease({0.415, 6.55});
    bulge(profile, 6.66);
    profile.curve({0.415, 6.8}, {0.45, 6.95}, {0.6, 7.05});
    bulge(profile, 7.15);
    appendTurned(points, flutedRing(16), profile);
    appendSlab(points, 0.72, 0.72, 7.15, kTop);
    return bezierMesh("column", std::move(points));
}

Mesh slabMesh(std::string name, double x, double z, double low, double high) {
    std::vector<glm::vec3> points;
    appendSlab(points, x, z, low, high);
    return bezierMesh(std::move(name), std::move(points));
}

// The floor: a bay of four hollowed tiles a column, all of one sheet, so that it has no seams.
Mesh floorMesh(std::size_t across, std::size_t along) {
    Sheet sheet(2 * across, 2 * along);
    for (std::size_t j = 0; j < sheet.pointRows(); ++j) {
        for (std::size_t i = 0; i < sheet.pointColumns(); ++i) {
            const bool inner = i % 3 != 0 && j % 3 != 0;
            // v runs against z, so that the floor faces up.
            const double x = kSpacing * (static_cast<double>(i) / 6.0 - 0.5 * static_cast<double>(across));
            const double z = kSpacing * (0.5 * static_cast<double>(along) - static_cast<double>(j) / 6.0);
            sheet.at(i, j) = {x, inner ? 0.0 : -0.03, z};
        }
    }
    std::vector<glm::vec3> points;
    sheet.appendTo(points);
    return bezierMesh("floor", std::move(points));
}

}  // namespace

Scene generateColumns(const Making& making) {
    // Two and a half times as long as wide, as near as whole rows come.
    auto across = static_cast<std::size_t>(std::sqrt(static_cast<double>(making.count) / 2.5));
    if (across == 0) across = 1;
    const std::size_t along = (making.count + across - 1) / across;
    Scene scene;
    scene.meshes = {columnMesh(), slabMesh("beam", 0.5 * kSpacing - 0.005, 0.45, kTop, kTop + 0.7), floorMesh(across, along)};
    addObject(scene, "floor", "floor", glm::dvec3(0.0), {0.5F, 0.44F, 0.38F}, kStone);
    Random random(making.seed);
    for (std::size_t i = 0; i < making.count; ++i) {
        const std::size_t row = i / across;
        const double x = kSpacing * (static_cast<double>(i % across) + 0.5 - 0.5 * static_cast<double>(across));
        const double z = kSpacing * (0.5 * static_cast<double>(along) - 0.5 - static_cast<double>(row));
        addObject(scene, "column", "column " + std::to_string(i + 1), {x, 0.0, z}, kStones[random.below(kStones.size())], kStone);
        if (i % across + 1 < across && i + 1 < making.count) {
            addObject(scene, "beam", "beam " + std::to_string(i + 1), {x + 0.5 * kSpacing, 0.0, z}, kStones[random.below(kStones.size())],
                      kStone);
        }
        making.tell(i, making.count);
    }
    const auto width = static_cast<float>(kSpacing * static_cast<double>(across));
    const auto depth = static_cast<float>(kSpacing * static_cast<double>(along));
    addNamedCamera(scene, "camera", {-0.75F * width, 5.0F, 0.5F * depth + 9.0F}, {-0.12F * width, 3.0F, 0.1F * depth}, 42.0F);
    addDaylight(scene);
    return scene;
}

}  // namespace tessera
