// The generated city's trees, willows and reeds: trunks and branches of closed surfaces, leaves of a patch each.
#include <cmath>
#include <cstddef>

#include "scene/generate_city_parts.h"
#include "scene/generate_sheets.h"

namespace tessera {

namespace {

constexpr Material kBark{MaterialKind::matte, 0.0F, 1.0F};
constexpr Material kLeaf{MaterialKind::plastic, 0.15F, 0.3F};

const std::vector<glm::vec3>& barks() {
    static const std::vector<glm::vec3> colors{{0.24F, 0.16F, 0.1F}, {0.3F, 0.22F, 0.15F}};
    return colors;
}

// A trunk that leans and tapers, with branches from its upper half.
std::vector<glm::vec3> trunk(Random& random, double height, double radius, std::size_t branches, double reach) {
    const double tilt = random.between(0.0, 0.06 * height);
    const glm::dvec2 lean = tilt * onCircle(random.next());
    Profile profile({1.7 * radius, -0.4});
    profile.curve({1.3 * radius, 0.1}, {radius, 0.3}, {radius, 0.2 * height, 0.0, 0.0, 0.3 * lean});
    profile.curve({0.9 * radius, 0.45 * height, 0.0, 0.0, 0.7 * lean}, {0.7 * radius, 0.7 * height, 0.0, 0.0, lean},
                  {0.4 * radius, height, 0.0, 0.0, lean});
    profile.line({0.0, height, 0.0, 0.0, lean});
    std::vector<glm::vec3> points;
    appendTurned(points, circleRing(6), profile);
    for (std::size_t i = 0; i < branches; ++i) {
        const glm::dvec2 side = onCircle((static_cast<double>(i) + random.between(0.0, 0.6)) / static_cast<double>(branches));
        const glm::dvec3 out(side.x, random.between(0.5, 0.9), side.y);
        const glm::dvec3 foot(lean.x, height * random.between(0.62, 0.9), lean.y);
        const glm::dvec3 bend(0.0, 0.3 * reach, 0.0);
        appendRod(points,
                  {{foot, foot + 0.3 * reach * out, foot + 0.7 * reach * out, foot + reach * out + bend}, 0.45 * radius, 0.12 * radius}, 4);
    }
    return points;
}

// A leaf at `at`, pointing along `direction`; broad ends, for a patch that ends in a point has two borders with the same ends.
void appendLeaf(std::vector<glm::vec3>& points, Random& random, const glm::dvec3& at, const glm::dvec3& direction, double length) {
    const glm::dvec3 any = random.direction();
    const glm::dvec3 across = glm::cross(direction, any);
    const double size = glm::length(across);
    const glm::dvec3 side = size > 0.05 ? across / size : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 droop(0.0, -0.25 * length, 0.0);
    const glm::dvec3 tip = at + length * direction + droop;
    Blade leaf;
    leaf.spine[0] = at;
    leaf.spine[1] = at + 0.33 * length * direction;
    leaf.spine[2] = at + 0.66 * length * direction + 0.3 * droop;
    leaf.spine[3] = tip;
    leaf.half[0] = 0.1 * length;
    leaf.half[1] = 0.5 * length;
    leaf.half[2] = 0.45 * length;
    leaf.half[3] = 0.06 * length;
    leaf.side = side;
    leaf.fold = 0.12 * length * glm::cross(side, direction);
    appendBlade(points, leaf);
}

// A closed lump, so that crowns are not seen through.
void appendLump(std::vector<glm::vec3>& points, const glm::dvec3& centre, double wide, double high) {
    const double reach = 0.5523;
    const double y = centre.y;
    const glm::dvec2 shift(centre.x, centre.z);
    Profile profile({0.0, y - high, 0.0, 0.0, shift});
    profile.curve({reach * wide, y - high, 0.0, 0.0, shift}, {wide, y - reach * high, 0.0, 0.0, shift}, {wide, y, 0.0, 0.0, shift});
    profile.curve({wide, y + reach * high, 0.0, 0.0, shift}, {reach * wide, y + high, 0.0, 0.0, shift}, {0.0, y + high, 0.0, 0.0, shift});
    appendTurned(points, circleRing(6), profile);
}

void addTree(CityKit& kit, Random& random, std::size_t leaves, double height, double wide, const std::string& name) {
    Model model;
    kit.addPart(model, name + " trunk", trunk(random, 0.7 * height, 0.22, 6, 0.8 * wide), barks(), kBark);
    std::vector<glm::vec3> points;
    // Three lumps, each with its share of leaves.
    for (std::size_t lump = 0; lump < 3; ++lump) {
        const glm::dvec2 aside = onCircle(static_cast<double>(lump) / 3.0 + random.between(0.0, 0.2)) * (0.4 * wide);
        const glm::dvec3 centre(aside.x, height * random.between(0.58, 0.78), aside.y);
        const double half = wide * random.between(0.5, 0.62);
        appendLump(points, centre, 0.8 * half, 0.85 * half);
        for (std::size_t i = 0; i < leaves / 3; ++i) {
            const glm::dvec3 out = random.direction();
            const glm::dvec3 sprout = glm::normalize(out + 0.7 * random.direction() + glm::dvec3(0.0, 0.2, 0.0));
            const double far = half * random.between(0.72, 1.0);
            appendLeaf(points, random, centre + far * out, sprout, random.between(0.28, 0.45));
        }
    }
    kit.addPart(model, name + " crown", std::move(points), {{0.16F, 0.32F, 0.06F}, {0.22F, 0.38F, 0.08F}, {0.3F, 0.36F, 0.07F}}, kLeaf);
    kit.trees.push_back(std::move(model));
}

// Boughs in storeys that get shorter, each a drooping blade.
void addFir(CityKit& kit, Random& random, std::size_t storeys, double height, const std::string& name) {
    Model model;
    kit.addPart(model, name + " trunk", trunk(random, 0.96 * height, 0.16, 0, 1.0), barks(), kBark);
    std::vector<glm::vec3> points;
    for (std::size_t storey = 0; storey < storeys; ++storey) {
        const double up = static_cast<double>(storey) / static_cast<double>(storeys);
        const std::size_t boughs = 8 + static_cast<std::size_t>(14.0 * (1.0 - up));
        for (std::size_t i = 0; i < boughs; ++i) {
            const glm::dvec2 side = onCircle((static_cast<double>(i) + random.next()) / static_cast<double>(boughs));
            const double reach = (2.3 * (1.0 - up) + 0.25) * random.between(0.85, 1.1);
            const glm::dvec3 out(side.x, 0.0, side.y);
            const glm::dvec3 foot(0.0, height * (0.14 + 0.84 * up), 0.0);
            Blade bough;
            for (int k = 0; k < 4; ++k) {
                const double along = k / 3.0;
                bough.spine[k] = foot + reach * along * out + glm::dvec3(0.0, reach * (0.25 * along - 0.75 * along * along), 0.0);
                bough.half[k] = 0.05 + 0.3 * reach * along * (1.15 - along);
            }
            bough.side = {-side.y, 0.0, side.x};
            bough.fold = {0.0, -0.08 * reach, 0.0};
            appendBlade(points, bough);
        }
    }
    kit.addPart(model, name + " boughs", std::move(points), {{0.06F, 0.18F, 0.09F}, {0.08F, 0.22F, 0.08F}}, kLeaf);
    kit.trees.push_back(std::move(model));
}

// Fronds over the whole crown, each one patch from where it springs to its tip near the ground.
void addWillow(CityKit& kit, Random& random, std::size_t fronds, const std::string& name) {
    Model model;
    kit.addPart(model, name + " trunk", trunk(random, 6.0, 0.42, 8, 2.6), barks(), kBark);
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i < fronds; ++i) {
        const glm::dvec2 side = onCircle(random.next());
        const double far = std::sqrt(random.between(0.02, 1.0));
        const glm::dvec3 out(side.x, 0.0, side.y);
        const glm::dvec3 start = 3.2 * far * out + glm::dvec3(0.0, 8.6 - 2.4 * far * far + random.between(-0.5, 0.3), 0.0);
        const double drop = (start.y - 0.9) * random.between(0.55, 1.0);
        const double swing = random.between(0.4, 1.4);
        const glm::dvec3 sway = 0.35 * random.direction();
        Blade frond;
        frond.spine[0] = start;
        frond.spine[1] = start + swing * out + glm::dvec3(0.0, 0.35, 0.0);
        frond.spine[2] = start + 1.15 * swing * out + sway - glm::dvec3(0.0, 0.5 * drop, 0.0);
        frond.spine[3] = start + swing * out + 0.5 * sway - glm::dvec3(0.0, drop, 0.0);
        const double half = random.between(0.01, 0.018);
        frond.half[0] = half;
        frond.half[1] = half;
        frond.half[2] = 1.2 * half;
        frond.half[3] = half;
        const glm::dvec2 facing = onCircle(random.next());
        frond.side = {facing.x, 0.0, facing.y};
        appendBlade(points, frond);
    }
    kit.addPart(model, name + " fronds", std::move(points), {{0.3F, 0.42F, 0.1F}, {0.36F, 0.46F, 0.12F}, {0.26F, 0.4F, 0.12F}}, kLeaf);
    kit.willows.push_back(std::move(model));
}

void addReeds(CityKit& kit, Random& random, std::size_t blades, const std::string& name) {
    Model model;
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i < blades; ++i) {
        const glm::dvec3 foot = random.within(0.6) * glm::dvec3(1.0, 0.0, 1.0);
        const double tilt = random.between(0.1, 0.6);
        const glm::dvec2 lean = tilt * onCircle(random.next());
        const double height = random.between(1.5, 2.7);
        const glm::dvec3 out(lean.x, 0.0, lean.y);
        const double half = random.between(0.007, 0.014);
        Blade blade;
        for (int k = 0; k < 4; ++k) {
            const double along = k / 3.0;
            blade.spine[k] = foot + along * along * out + glm::dvec3(0.0, height * along * (1.15 - 0.15 * along), 0.0);
            blade.half[k] = half * (1.0 - 0.6 * along);
        }
        blade.side = glm::normalize(glm::dvec3(-lean.y, 0.0, lean.x));
        appendBlade(points, blade);
    }
    kit.addPart(model, name, std::move(points), {{0.4F, 0.44F, 0.16F}, {0.34F, 0.42F, 0.12F}, {0.46F, 0.44F, 0.2F}}, kLeaf);
    kit.reeds.push_back(std::move(model));
}

}  // namespace

void addPlants(CityKit& kit, Random& random) {
    addTree(kit, random, 600, 6.5, 2.3, "tree 1");
    addTree(kit, random, 660, 7.5, 2.5, "tree 2");
    addTree(kit, random, 540, 5.5, 2.1, "tree 3");
    addTree(kit, random, 600, 8.0, 2.2, "tree 4");
    addFir(kit, random, 20, 9.0, "fir 1");
    addFir(kit, random, 24, 11.0, "fir 2");
    addWillow(kit, random, 5500, "willow 1");
    addWillow(kit, random, 6000, "willow 2");
    addWillow(kit, random, 5000, "willow 3");
    addReeds(kit, random, 320, "reeds 1");
    addReeds(kit, random, 320, "reeds 2");
    addReeds(kit, random, 320, "reeds 3");
}

}  // namespace tessera
