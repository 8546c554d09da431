// The generated city's houses, towers, domes, lamps and pavements.
#include <array>
#include <cstddef>

#include "scene/generate_city_parts.h"
#include "scene/generate_sheets.h"

namespace tessera {

namespace {

constexpr Material kStone{MaterialKind::matte, 0.0F, 1.0F};
constexpr Material kTiles{MaterialKind::plastic, 0.12F, 0.35F};
constexpr Material kMetal{MaterialKind::plastic, 0.45F, 0.15F};

const std::vector<glm::vec3>& plasters() {
    static const std::vector<glm::vec3> colors{{0.78F, 0.62F, 0.4F},  {0.8F, 0.74F, 0.62F},  {0.74F, 0.5F, 0.4F},
                                               {0.62F, 0.66F, 0.68F}, {0.82F, 0.78F, 0.72F}, {0.7F, 0.66F, 0.48F}};
    return colors;
}

const std::vector<glm::vec3>& roofTiles() {
    static const std::vector<glm::vec3> colors{{0.48F, 0.16F, 0.09F}, {0.42F, 0.2F, 0.12F}, {0.3F, 0.26F, 0.25F}};
    return colors;
}

// Storeys of a wall with one row of panes each: sill, the way in, the pane, the way out.
void appendStoreys(Profile& profile, std::size_t count, double height, double relief) {
    for (std::size_t i = 0; i < count; ++i) {
        ProfilePoint at = profile.end();
        const double floor = at.height;
        at.height = floor + 0.28 * height;
        profile.line(at);
        at.height = floor + 0.33 * height;
        at.relief = relief;
        profile.ease(at);
        at.height = floor + 0.8 * height;
        profile.line(at);
        at.height = floor + 0.85 * height;
        at.relief = 0.0;
        profile.ease(at);
    }
}

// Up to `height` and out by `out`, hollow and then round, as mouldings are.
void appendCornice(Profile& profile, double height, double out) {
    ProfilePoint end = profile.end();
    end.height += height;
    end.grow += out;
    profile.ease(end);
    end.height += 0.4 * height;
    profile.line(end);
}

struct HousePlan {
    double x;  // half the sides
    double z;
    std::size_t xBays;
    std::size_t zBays;
    std::size_t storeys;
    double roof;  // height
};

void addHouse(CityKit& kit, const HousePlan& plan, const std::string& name) {
    Model model;
    Profile walls({1.0, -0.5, 0.12});
    walls.line({1.0, 0.5, 0.12}).ease({1.0, 0.62});
    appendStoreys(walls, plan.storeys, 3.1, 0.28);
    walls.line({1.0, walls.end().height + 0.6});
    const double eaves = walls.end().height;
    appendCornice(walls, 0.3, 0.3);
    std::vector<glm::vec3> points;
    appendTurned(points, wallRing({plan.x, plan.z, 0.18, plan.xBays, plan.zBays}), walls);
    kit.addPart(model, name + " walls", std::move(points), plasters(), kStone);

    // A hipped roof that sweeps up, closed below.
    Profile roof({0.0, eaves + 0.3});
    roof.line({1.0, eaves + 0.3, 0.55});
    roof.line({1.0, eaves + 0.45, 0.6});
    const double top = eaves + 0.45 + plan.roof;
    roof.curve({0.78, eaves + 0.45 + 0.12 * plan.roof, 0.4}, {0.42, eaves + 0.45 + 0.55 * plan.roof, 0.2}, {0.08, top, 0.1});
    roof.line({0.0, top, 0.0});
    points.clear();
    appendTurned(points, wallRing({plan.x, plan.z, 0.1, 0, 0}), roof);
    kit.addPart(model, name + " roof", std::move(points), roofTiles(), kTiles);
    kit.houses.push_back(std::move(model));
}

// Three stacked blocks, each a little narrower, under a spire.
void addTower(CityKit& kit, std::size_t bays, std::size_t storeys, double half, const std::string& name) {
    Model model;
    Profile walls({1.0, -0.5, 0.2});
    walls.line({1.0, 1.2, 0.2});
    walls.ease({1.0, 1.5});
    double scale = 1.0;
    for (int block = 0; block < 3; ++block) {
        appendStoreys(walls, storeys, 3.4, 0.35);
        appendCornice(walls, 0.5, 0.35);
        const double height = walls.end().height;
        scale -= 0.14;
        walls.curve({scale + 0.1, height + 0.05, 0.2}, {scale, height + 0.3}, {scale, height + 1.0});
    }
    std::vector<glm::vec3> points;
    appendTurned(points, wallRing({half, half, 0.12 * half, bays, bays}), walls);
    kit.addPart(model, name + " walls", std::move(points), plasters(), kStone);

    const double foot = walls.end().height;
    Profile spire({0.0, foot});
    spire.line({1.06 * scale, foot}).line({1.06 * scale, foot + 0.4});
    spire.curve({0.75 * scale, foot + 1.2}, {0.55 * scale, foot + 4.0}, {0.28 * scale, foot + 7.0});
    spire.curve({0.16 * scale, foot + 9.0}, {0.02, foot + 11.0}, {0.0, foot + 15.0});
    points.clear();
    appendTurned(points, wallRing({half, half, 0.12 * half, 1, 1}), spire);
    kit.addPart(model, name + " spire", std::move(points), {{0.16F, 0.34F, 0.3F}, {0.28F, 0.3F, 0.34F}}, kMetal);
    kit.towers.push_back(std::move(model));
}

// A round hall of fluted walls, a ribbed dome and its lantern.
void addDome(CityKit& kit, std::size_t ribs, double radius, double rise, const std::string& name) {
    Model model;
    Profile hall({radius + 1.2, -0.5});
    hall.line({radius + 1.2, 0.6}).line({radius + 0.5, 0.6}).line({radius + 0.5, 1.2}).line({radius, 1.2});
    hall.line({radius, 2.2}).ease({radius, 2.6, 0.0, 0.5}).line({radius, 8.0, 0.0, 0.5}).ease({radius, 8.6});
    appendCornice(hall, 0.8, 0.6);
    const double foot = hall.end().height;
    hall.line({0.8 * radius, foot});
    std::vector<glm::vec3> points;
    appendTurned(points, flutedRing(ribs), hall);
    kit.addPart(model, name + " hall", std::move(points), {{0.8F, 0.76F, 0.68F}, {0.74F, 0.68F, 0.6F}}, kStone);

    const double wide = 0.93 * radius;
    Profile shell({wide, foot - 0.1});
    shell.line({wide, foot + 1.0, 0.0, 0.1});
    shell.curve({wide, foot + 1.0 + 0.55 * rise, 0.0, 0.35}, {0.55 * wide, foot + 1.0 + rise, 0.0, 0.3}, {1.1, foot + 1.2 + rise});
    shell.line({1.1, foot + 3.4 + rise}).ease({1.4, foot + 3.8 + rise});
    shell.curve({1.4, foot + 5.0 + rise}, {0.2, foot + 5.0 + rise}, {0.0, foot + 7.5 + rise});
    points.clear();
    appendTurned(points, flutedRing(ribs), shell);
    kit.addPart(model, name + " shell", std::move(points), {{0.2F, 0.42F, 0.36F}, {0.5F, 0.38F, 0.16F}, {0.3F, 0.34F, 0.4F}}, kMetal);
    kit.domes.push_back(std::move(model));
}

void addLamp(CityKit& kit) {
    Model model;
    Profile post({0.16, -0.2});
    post.line({0.16, 0.5}).ease({0.06, 0.9}).line({0.05, 3.6}).ease({0.14, 3.75}).line({0.0, 3.75});
    std::vector<glm::vec3> points;
    appendTurned(points, circleRing(6), post);
    kit.addPart(model, "lamp post", std::move(points), {{0.06F, 0.07F, 0.08F}}, kMetal);
    Profile globe({0.0, 3.75});
    globe.curve({0.3, 3.75}, {0.34, 3.9}, {0.34, 4.1}).curve({0.34, 4.3}, {0.2, 4.45}, {0.0, 4.45});
    points.clear();
    appendTurned(points, circleRing(6), globe);
    kit.addPart(model, "lamp globe", std::move(points), {{0.95F, 0.92F, 0.8F}}, kTiles);
    kit.lamps.push_back(std::move(model));
}

void addPavement(CityKit& kit) {
    Model model;
    Profile profile({1.0, -0.4});
    profile.line({1.0, 0.1}).curve({1.0, 0.13}, {1.0, 0.15, -0.02}, {1.0, 0.15, -0.05}).line({0.5, 0.15}).line({0.0, 0.15});
    std::vector<glm::vec3> points;
    appendTurned(points, wallRing({18.0, 18.0, 2.5, 2, 2}), profile);
    kit.addPart(model, "pavement", std::move(points), {{0.46F, 0.43F, 0.4F}, {0.4F, 0.38F, 0.36F}, {0.22F, 0.32F, 0.1F}}, kStone);
    kit.pavements.push_back(std::move(model));
}

}  // namespace

void addBuildings(CityKit& kit) {
    constexpr std::array<HousePlan, 7> houses{{{5.0, 4.4, 3, 3, 4, 2.6},
                                               {4.6, 5.0, 3, 3, 3, 3.2},
                                               {5.2, 5.2, 4, 4, 4, 2.2},
                                               {4.2, 4.2, 2, 2, 5, 3.4},
                                               {5.2, 4.6, 4, 3, 5, 2.4},
                                               {4.0, 5.0, 2, 3, 4, 3.0},
                                               {4.8, 4.8, 3, 3, 6, 2.0}}};
    for (std::size_t i = 0; i < houses.size(); ++i) addHouse(kit, houses[i], "house " + std::to_string(i + 1));
    addTower(kit, 3, 3, 7.5, "tower 1");
    addTower(kit, 2, 4, 5.5, "tower 2");
    addTower(kit, 4, 2, 8.5, "tower 3");
    addDome(kit, 24, 9.0, 7.0, "dome 1");
    addDome(kit, 16, 7.0, 9.0, "dome 2");
    addDome(kit, 32, 10.0, 5.5, "dome 3");
    addLamp(kit);
    addPavement(kit);
}

}  // namespace tessera
