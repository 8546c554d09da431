// The generated scene "city": blocks of houses, towers and domes around a grove, until as many patches are placed as were asked for.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "scene/builtin_scenes.h"
#include "scene/generate_city_parts.h"
#include "scene/generate_families.h"
#include "scene/generate_numbers.h"
#include "scene/generate_sheets.h"

namespace tessera {

namespace {

constexpr double kPitch = 48.0;  // of blocks, 12 of them street
constexpr double kLawn = 0.15;   // height of what one walks on beside the streets

// Of the patches, as long as the grove has room for them.
constexpr double kWillowShare = 0.34;
constexpr double kReedShare = 0.14;
constexpr std::size_t kGroveRows = 8;  // of willows, each way
constexpr std::size_t kReedRows = 22;  // of tufts, each way

// Two blocks wide and deep, the streets between them grown over; the street along x = 0 ends here on both sides.
constexpr glm::dvec2 kGroveCentre(0.0, -48.0);
constexpr double kGroveHalf = 42.0;

// Among the reeds.
constexpr glm::dvec2 kEyesplitPlace(0.0, -14.0);

struct Block {
    int column;  // centres lie at (column + 0.5, row + 0.5) pitches
    int row;
    double distance;
};

// Puts models into a scene and counts their patches.
class Builder {
public:
    Builder(const Making& making, CityKit models) : kit(std::move(models)), making_(making), random_(making.seed, 1) {
        scene.meshes = std::move(kit.meshes);
        kit.meshes.clear();
    }

    [[nodiscard]] bool full() const { return patches_ >= making_.count; }
    [[nodiscard]] std::uint64_t patches() const { return patches_; }
    [[nodiscard]] Random& random() { return random_; }

    // One of `models` at a place, turned about the vertical; nothing once the scene is full.
    void place(const std::vector<Model>& models, const glm::dvec2& at, double turns, double height = kLawn) {
        if (full()) return;
        const Model& model = models[random_.below(models.size())];
        const glm::dvec2 half = onCircle(0.5 * turns);
        for (const ModelPart& part : model.parts) {
            Object object;
            object.name = part.mesh + " " + std::to_string(scene.objects.size() + 1);
            object.mesh = part.mesh;
            object.transform.translation = {at.x, height, at.y};
            object.transform.rotation = glm::quat(static_cast<float>(half.x), 0.0F, static_cast<float>(half.y), 0.0F);
            object.color = part.colors[random_.below(part.colors.size())];
            object.color *= static_cast<float>(random_.between(0.88, 1.08));
            object.material = part.material;
            scene.objects.push_back(std::move(object));
        }
        patches_ += model.patches;
        making_.tell(patches_ / 1024 * 1024, making_.count);
    }

    // A mesh that is placed once, as it is.
    void placeOnce(Mesh mesh, const glm::vec3& color) {
        Object object;
        object.name = mesh.name;
        object.mesh = mesh.name;
        object.color = color;
        patches_ += mesh.patchCount();
        scene.meshes.push_back(std::move(mesh));
        scene.objects.push_back(std::move(object));
    }

    Scene scene;
    CityKit kit;

private:
    const Making& making_;
    Random random_;
    std::uint64_t patches_ = 0;
};

double quarter(Random& random) { return 0.25 * static_cast<double>(random.below(4)); }

// A square sheet that faces up, of smooth bumps so high that vanish at its rim.
Mesh bumpyGround(std::string name, const glm::dvec2& centre, double half, std::size_t patches, double height, double bump, Random& random) {
    Sheet sheet(patches, patches);
    const std::size_t last = 3 * patches;
    std::vector<double> heights((patches + 1) * (patches + 1));
    for (double& each : heights) each = random.between(0.0, bump);
    for (std::size_t j = 0; j <= last; ++j) {
        for (std::size_t i = 0; i <= last; ++i) {
            // Level around each corner, which makes neighbours meet smoothly.
            const bool rim = i < 2 || j < 2 || i + 2 > last || j + 2 > last;
            const double y = rim ? 0.0 : heights[(j + 1) / 3 * (patches + 1) + (i + 1) / 3];
            const glm::dvec2 at(static_cast<double>(i) / static_cast<double>(last), static_cast<double>(j) / static_cast<double>(last));
            sheet.at(i, j) = {centre.x + half * (2.0 * at.x - 1.0), height + y, centre.y - half * (2.0 * at.y - 1.0)};
        }
    }
    std::vector<glm::vec3> points;
    sheet.appendTo(points);
    return bezierMesh(std::move(name), std::move(points));
}

glm::dvec2 jittered(Random& random, const glm::dvec2& at, double by) {
    const double x = random.between(-by, by);
    return at + glm::dvec2(x, random.between(-by, by));
}

void plantTree(Builder& builder, const glm::dvec2& at, double by) {
    const glm::dvec2 place = jittered(builder.random(), at, by);
    builder.place(builder.kit.trees, place, builder.random().next());
}

// Trees and lamps along the edge of a block, on its pavement.
void plantEdge(Builder& builder, const glm::dvec2& centre) {
    for (int side = 0; side < 4; ++side) {
        const glm::dvec2 out = onCircle(0.25 * side);
        const glm::dvec2 along(-out.y, out.x);
        for (int i = -1; i <= 1; ++i) {
            const glm::dvec2 at = centre + 16.6 * out + (12.0 * i + 6.0) * along;
            if (i < 1) plantTree(builder, at, 0.4);
            builder.place(builder.kit.lamps, centre + 17.2 * out + 12.0 * i * along, 0.0);
        }
    }
}

void buildHouses(Builder& builder, const glm::dvec2& centre) {
    for (int i = 0; i < 9; ++i) {
        const glm::dvec2 at = centre + 11.0 * glm::dvec2(i % 3 - 1, i / 3 - 1);
        const double turns = quarter(builder.random());
        builder.place(i == 4 ? builder.kit.trees : builder.kit.houses, at, turns);
    }
}

void buildAround(Builder& builder, const std::vector<Model>& middle, const glm::dvec2& centre) {
    builder.place(middle, centre, quarter(builder.random()));
    for (int i = 0; i < 8; ++i) {
        const glm::dvec2 out = onCircle(i / 8.0 + 0.0625);
        plantTree(builder, centre + 14.0 * out, 0.5);
    }
}

void buildGarden(Builder& builder, const glm::dvec2& centre) {
    for (int i = 0; i < 16; ++i) {
        const int row = i / 4;
        const glm::dvec2 at = centre + 6.5 * glm::dvec2(i % 4 - 1.5, row - 1.5);
        plantTree(builder, at, 1.6);
    }
}

void buildBlock(Builder& builder, const Block& block) {
    const glm::dvec2 centre(kPitch * (block.column + 0.5), kPitch * (block.row + 0.5));
    builder.place(builder.kit.pavements, centre, 0.0, 0.0);
    const std::size_t chance = builder.random().below(20);
    if (chance < 13) buildHouses(builder, centre);
    if (chance >= 13 && chance < 16) buildAround(builder, builder.kit.towers, centre);
    if (chance >= 16 && chance < 18) buildAround(builder, builder.kit.domes, centre);
    if (chance >= 18) buildGarden(builder, centre);
    plantEdge(builder, centre);
}

// Willows all over the grove and reeds in its clearing, nearest to the clearing first.
void plantGrove(Builder& builder, std::uint64_t count) {
    builder.placeOnce(bumpyGround("grove", kGroveCentre, kGroveHalf, 12, kLawn, 0.25, builder.random()), {0.17F, 0.24F, 0.08F});
    const auto plant = [&builder](const std::vector<Model>& models, const glm::dvec2& centre, std::size_t rows, double spacing,
                                  double most) {
        std::vector<glm::dvec2> places;
        for (std::size_t i = 0; i < rows * rows; ++i) {
            const std::size_t row = i / rows;
            const glm::dvec2 cell(static_cast<double>(i % rows), static_cast<double>(row));
            const glm::dvec2 at = centre + spacing * (cell - 0.5 * static_cast<double>(rows - 1));
            places.push_back(jittered(builder.random(), at, 0.3 * spacing));
        }
        const auto distance = [](const glm::dvec2& at) { return glm::dot(at - kEyesplitPlace, at - kEyesplitPlace); };
        std::stable_sort(places.begin(), places.end(), [&](const glm::dvec2& a, const glm::dvec2& b) { return distance(a) < distance(b); });
        const std::uint64_t before = builder.patches();
        for (const glm::dvec2& at : places) {
            if (static_cast<double>(builder.patches() - before) >= most) break;
            builder.place(models, at, builder.random().next());
        }
    };
    plant(builder.kit.reeds, kEyesplitPlace, kReedRows, 0.7, kReedShare * static_cast<double>(count));
    plant(builder.kit.willows, kGroveCentre, kGroveRows, 2.0 * kGroveHalf / kGroveRows, kWillowShare * static_cast<double>(count));
}

// All blocks but the grove's, from the one nearest to a place down the street on. More than `count` patches fill.
std::vector<Block> blocksFor(std::uint64_t count) {
    // The emptiest block, a dome's in its trees, has some 8000 patches; a ring more than the count needs, for what is round is no square.
    const int reach = 4 + static_cast<int>(std::sqrt(static_cast<double>(count) / 8000.0));
    std::vector<Block> blocks;
    for (int row = -reach - 3; row < reach; ++row) {
        for (int column = -reach; column < reach; ++column) {
            if (column >= -1 && column < 1 && row >= -2 && row < 0) continue;
            const double x = column + 0.5;
            const double z = row + 3.5;
            blocks.push_back({column, row, x * x + z * z});
        }
    }
    std::stable_sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.distance < b.distance; });
    return blocks;
}

}  // namespace

Scene generateCity(const Making& making) {
    CityKit kit;
    addBuildings(kit);
    Random growth(making.seed, 2);
    addPlants(kit, growth);
    Builder builder(making, std::move(kit));
    plantGrove(builder, making.count);
    double farthest = 3.0 * kPitch;
    for (const Block& block : blocksFor(making.count)) {
        if (builder.full()) break;
        buildBlock(builder, block);
        farthest = std::max(farthest, kPitch * (std::sqrt(block.distance) + 2.0));
    }
    builder.placeOnce(bumpyGround("ground", {0.0, -3.5 * kPitch}, farthest, 16, 0.0, 0.0, builder.random()), {0.2F, 0.2F, 0.21F});
    Scene scene = std::move(builder.scene);
    addNamedCamera(scene, "average", {1.0F, 4.5F, -96.0F}, {0.0F, 6.5F, -190.0F}, 50.0F);
    addNamedCamera(scene, "spike", {0.3F, 3.2F, 12.0F}, {0.0F, 4.6F, -60.0F}, 50.0F);
    addNamedCamera(scene, "eyesplit", {0.0F, 1.3F, -7.0F}, {0.0F, 1.8F, -100.0F}, 50.0F);
    addDaylight(scene);
    return scene;
}

}  // namespace tessera
