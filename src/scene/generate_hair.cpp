// The generated scene "hair": a bust, and strands of thin ribbons combed from the crown over the head and down.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "scene/builtin_scenes.h"
#include "scene/generate_families.h"
#include "scene/generate_numbers.h"
#include "scene/generate_sheets.h"

namespace tessera {

namespace {

constexpr std::size_t kPieces = 4;  // patches a strand
constexpr int kSteps = 4;           // of the comb a piece

// Half the skull's sides: an ellipsoid about the origin, its face towards +z.
constexpr glm::dvec3 kSkull(0.78, 1.0, 0.92);

// Below this part of the skull's height strands hang free.
constexpr double kEars = -0.12;

constexpr std::array<glm::vec3, 5> kShades{
    {{0.16F, 0.07F, 0.03F}, {0.21F, 0.1F, 0.04F}, {0.26F, 0.13F, 0.05F}, {0.32F, 0.17F, 0.07F}, {0.4F, 0.23F, 0.1F}}};

struct Strand {
    glm::dvec3 root;      // on the unit sphere that the skull is stretched from
    double length = 0.3;  // turns down the skull, and as long where it hangs
    double sweep = 0.0;   // turns about the vertical from root to tip
    double lift = 0.0;    // off the skull at the tip, in radii
    double curl = 0.0;    // how far it swings to the side
    double phase = 0.0;   // turns
    double width = 0.003;
};

// Roots lie evenly on the scalp, which ends higher above the face than at the neck.
glm::dvec3 rootPlace(Random& random) {
    while (true) {
        const glm::dvec3 unit = random.direction();
        if (unit.y > (unit.z > 0.0 ? 0.62 * unit.z - 0.05 : 0.55 * unit.z - 0.05)) return unit;
    }
}

Strand grow(Random& random, double width) {
    Strand strand;
    strand.root = rootPlace(random);
    const double front = std::max(strand.root.z, 0.0);
    strand.length = random.between(0.38, 0.46) - 0.05 * front;
    // Parted a little off the middle: what grows before the crown falls to both sides of the face.
    const double away = strand.root.x > 0.08 ? 1.0 : -1.0;
    strand.sweep = away * front * front * random.between(0.17, 0.23);
    strand.lift = random.between(0.05, 0.16);
    strand.curl = random.between(0.02, 0.05);
    // Locks: neighbours swing together.
    strand.phase = 0.9 * strand.root.x + 1.3 * strand.root.z + random.between(-0.07, 0.07);
    strand.width = width * random.between(0.7, 1.3);
    return strand;
}

glm::dvec2 turned(const glm::dvec2& v, const glm::dvec2& by) { return {v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x}; }

struct Knot {
    glm::dvec3 place;
    glm::dvec3 outward;  // of the skull
};

// Follows the skull's meridian down from the root in small steps, and falls straight where the ears are passed.
std::array<Knot, kPieces + 1> comb(const Strand& strand) {
    const double flat = std::sqrt(strand.root.x * strand.root.x + strand.root.z * strand.root.z) + 1e-9;
    glm::dvec2 fall(strand.root.y, flat);  // cosine and sine of the way down from the crown
    glm::dvec2 about = glm::dvec2(strand.root.x, strand.root.z) / flat;
    double sunk = 0.0;
    constexpr int steps = static_cast<int>(kPieces) * kSteps;
    const glm::dvec2 step = onCircle(strand.length / steps);
    // From +z to +x where the sweep is above 0.
    const glm::dvec2 aside = onCircle(-strand.sweep / steps);
    std::array<Knot, kPieces + 1> knots;
    for (int i = 0;; ++i) {
        const double along = static_cast<double>(i) / steps;
        const glm::dvec3 unit(fall.y * about.x, fall.x - sunk, fall.y * about.y);
        const double swing = strand.curl * along * onCircle(strand.phase + 1.5 * along).y;
        const double off = 0.01 + strand.lift * along * (1.6 - 0.6 * along) + 0.5 * swing;
        const glm::dvec3 outward = glm::normalize(glm::dvec3(unit.x, std::max(unit.y, 0.0), unit.z));
        if (i % kSteps == 0) {
            const glm::dvec3 sideways(about.y, 0.0, -about.x);
            knots[static_cast<std::size_t>(i / kSteps)] = {(unit + off * outward + swing * sideways) * kSkull, outward};
        }
        if (i == steps) return knots;
        about = turned(about, aside);
        if (fall.x > kEars) {
            fall = turned(fall, step);
        } else {
            sunk += 6.283185307179586 * strand.length / steps;
        }
    }
}

void appendStrand(std::vector<glm::vec3>& points, const Strand& strand) {
    const std::array<Knot, kPieces + 1> knots = comb(strand);
    const auto slope = [&knots](std::size_t k) {
        const std::size_t before = k == 0 ? 0 : k - 1;
        const std::size_t behind = std::min(k + 1, kPieces);
        return (knots[behind].place - knots[before].place) / static_cast<double>(behind - before);
    };
    const auto sideOf = [&](std::size_t k) { return glm::normalize(glm::cross(slope(k), knots[k].outward)); };
    Sheet sheet(1, kPieces);
    for (std::size_t j = 0; j <= 3 * kPieces; ++j) {
        // An inner Bezier point belongs to the knot that it is nearest to.
        const std::size_t k = (j + 1) / 3;
        const double off = (static_cast<double>(j) - 3.0 * static_cast<double>(k)) / 3.0;
        const glm::dvec3 middle = knots[k].place + off * slope(k);
        const double along = static_cast<double>(j) / (3.0 * kPieces);
        const glm::dvec3 half = sideOf(k) * (strand.width * (1.0 - 0.85 * along * along));
        for (std::size_t i = 0; i < 4; ++i) sheet.at(i, j) = middle + half * ((static_cast<double>(i) - 1.5) / 1.5);
    }
    sheet.appendTo(points);
}

// Head, neck and shoulders, turned; the face is plain.
Mesh bust() {
    Ring ring = circleRing(12);
    for (RingPoint& point : ring) point.place *= glm::dvec2(kSkull.x, kSkull.z);
    Profile profile({0.0, -2.0});
    profile.line({1.15, -2.0});
    profile.curve({1.3, -2.0}, {1.32, -1.85}, {1.1, -1.7});
    profile.curve({0.75, -1.52}, {0.5, -1.5}, {0.48, -1.2});
    profile.curve({0.47, -1.0}, {0.5, -0.95}, {0.62, -0.86, 0.0, 0.0, {0.0, 0.12}});
    profile.curve({0.8, -0.72, 0.0, 0.0, {0.0, 0.2}}, {0.985, -0.45, 0.0, 0.0, {0.0, 0.02}}, {0.985, 0.0});
    profile.curve({0.985, 0.54}, {0.54, 0.985}, {0.0, 0.985});
    std::vector<glm::vec3> points;
    appendTurned(points, ring, profile);
    return bezierMesh("bust", std::move(points));
}

void addObject(Scene& scene, Mesh mesh, const glm::vec3& color, const Material& material) {
    Object object;
    object.name = mesh.name;
    object.mesh = mesh.name;
    object.color = color;
    object.material = material;
    scene.meshes.push_back(std::move(mesh));
    scene.objects.push_back(std::move(object));
}

}  // namespace

Scene generateHair(const Making& making) {
    Scene scene;
    addObject(scene, bust(), {0.62F, 0.48F, 0.4F}, {MaterialKind::plastic, 0.15F, 0.3F});
    Random random(making.seed);
    // The more strands, the thinner, so that as much of the head is covered.
    const double width = std::clamp(0.45 / std::sqrt(static_cast<double>(making.count)), 0.0008, 0.02);
    std::array<std::vector<glm::vec3>, kShades.size()> points;
    for (std::vector<glm::vec3>& each : points) each.reserve(16 * kPieces * (making.count / points.size() + 1));
    for (std::uint64_t i = 0; i < making.count; ++i) {
        appendStrand(points[i % points.size()], grow(random, width));
        making.tell(i, making.count);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].empty()) continue;
        addObject(scene, bezierMesh("strands " + std::to_string(i + 1), std::move(points[i])), kShades[i],
                  {MaterialKind::plastic, 0.25F, 0.25F});
    }
    addNamedCamera(scene, "camera", {2.6F, 0.9F, 4.2F}, {0.0F, -0.35F, 0.0F}, 36.0F);
    addStudioLights(scene);
    return scene;
}

}  // namespace tessera
