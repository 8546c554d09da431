// Patches that share one border curve, by chance.
#include "border_models.h"

#include <algorithm>
#include <cmath>

namespace tessera::splitting {
namespace {

using reference::Random;

constexpr std::uint32_t unit = 1U << 24U;

struct Curve {
    std::array<glm::vec3, 4> points{};
    std::array<float, 4> weights{1.0F, 1.0F, 1.0F, 1.0F};
};

std::uint32_t below(Random& random, std::uint32_t end) { return static_cast<std::uint32_t>(random.unit() * end); }

glm::vec3 anyPoint(Random& random) { return {random.inCube(1.0)}; }

float anyWeight(Random& random) { return static_cast<float>(std::pow(3.0, random.between(-1.0, 1.0))); }

Curve anyCurve(bool rational, Random& random) {
    Curve curve;
    for (glm::vec3& point : curve.points) point = anyPoint(random);
    if (rational)
        for (float& weight : curve.weights) weight = anyWeight(random);
    return curve;
}

// A side's control points in the file, in the border's direction.
std::array<std::size_t, 4> pointsOf(PatchKind kind, std::uint32_t side) {
    using Sides = std::array<std::array<std::size_t, 4>, 4>;
    constexpr Sides gregory{{{0, 4, 9, 1}, {1, 5, 10, 2}, {3, 11, 6, 2}, {0, 8, 7, 3}}};
    constexpr Sides triangle{{{0, 1, 2, 3}, {3, 6, 8, 9}, {}, {0, 4, 7, 9}}};
    constexpr Sides bicubic{{{0, 1, 2, 3}, {3, 7, 11, 15}, {12, 13, 14, 15}, {0, 4, 8, 12}}};
    if (kind == PatchKind::gregory) return gregory[side];
    return kind == PatchKind::pn ? triangle[side] : bicubic[side];
}

BorderUser anyUser(const std::vector<PatchKind>& kinds, Random& random) {
    BorderUser user;
    user.kind = kinds[below(random, static_cast<std::uint32_t>(kinds.size()))];
    do user.side = below(random, 4);
    while (user.kind == PatchKind::pn && user.side == 2);
    user.reversed = below(random, 2) == 1;
    return user;
}

// The border of a user without a record.
Curve turned(const Curve& curve, bool reversed) {
    Curve result = curve;
    if (!reversed) return result;
    std::reverse(result.points.begin(), result.points.end());
    std::reverse(result.weights.begin(), result.weights.end());
    return result;
}

// The border of a user with a record: what lies at the curve's ends is the curve's, all else may be anything.
Curve looselyAlong(const Curve& curve, const BorderUser& user, Random& random) {
    Curve border = anyCurve(user.kind == PatchKind::rational, random);
    const bool first = user.index == 0;
    const bool last = user.index + 1 == 1U << user.level;
    if (first) border.points[user.reversed ? 3 : 0] = curve.points[0];
    if (last) border.points[user.reversed ? 0 : 3] = curve.points[3];
    return border;
}

void addPatch(SharedBorder& shared, const BorderUser& user, const Curve& border, Random& random) {
    Mesh mesh;
    mesh.name = "mesh " + std::to_string(shared.users.size());
    mesh.kind = user.kind;
    for (std::size_t k = 0; k < pointsPerPatch(user.kind); ++k) mesh.points.push_back(anyPoint(random));
    if (user.kind == PatchKind::rational)
        for (std::size_t k = 0; k < mesh.points.size(); ++k) mesh.weights.push_back(anyWeight(random));
    const std::array<std::size_t, 4> places = pointsOf(user.kind, user.side);
    for (std::size_t k = 0; k < 4; ++k) {
        mesh.points[places[k]] = border.points[k];
        if (user.kind == PatchKind::rational) mesh.weights[places[k]] = border.weights[k];
    }
    Object object;
    object.name = object.mesh = mesh.name;
    shared.scene.meshes.push_back(std::move(mesh));
    shared.scene.objects.push_back(std::move(object));
    shared.users.push_back(user);
    shared.text += std::string(name(user.kind)) + " side " + std::to_string(user.side) + (user.reversed ? " reversed" : "") + " part " +
                   std::to_string(user.index) + " of " + std::to_string(1U << user.level) + "; ";
}

void addOwn(SharedBorder& shared, const Curve& curve, bool rational, Random& random) {
    for (std::vector<std::size_t>& side : shared.onEachSide) {
        const BorderUser user =
            rational ? anyUser({PatchKind::rational}, random) : anyUser({PatchKind::bezier, PatchKind::gregory, PatchKind::pn}, random);
        side.push_back(shared.users.size());
        addPatch(shared, user, turned(curve, user.reversed), random);
    }
}

// Halves parts of the curve by chance, three times at most.
void addRow(SharedBorder& shared, std::size_t side, const Curve& curve, std::uint32_t level, std::uint32_t index, Random& random) {
    if (level < 3 && below(random, 2) == 0) {
        addRow(shared, side, curve, level + 1, 2 * index, random);
        addRow(shared, side, curve, level + 1, 2 * index + 1, random);
        return;
    }
    BorderUser user = anyUser({PatchKind::bezier, PatchKind::gregory, PatchKind::rational, PatchKind::pn}, random);
    user.level = level;
    user.index = index;
    shared.onEachSide[side].push_back(shared.users.size());
    addPatch(shared, user, looselyAlong(curve, user, random), random);
}

void addRecords(SharedBorder& shared, const Curve& curve) {
    std::uint32_t finest = 0;
    for (const BorderUser& user : shared.users) finest = std::max(finest, user.level);
    for (std::size_t k = 0; k < shared.users.size(); ++k) {
        const BorderUser& user = shared.users[k];
        shared.scene.meshes[k].edges = {{0, user.side, curve.points, curve.weights, user.level, user.index, user.reversed, finest}};
    }
}

}  // namespace

SharedBorder sharedBorder(BorderLook look, Random& random) {
    SharedBorder shared;
    shared.scene.name = "shared border";
    const bool rational = below(random, 2) == 0;
    Curve curve = anyCurve(rational, random);
    shared.onePoint = look == BorderLook::onePoint;
    if (shared.onePoint) curve.points.fill(curve.points[0]);
    if (look != BorderLook::recorded) {
        addOwn(shared, curve, rational, random);
        return shared;
    }
    for (std::size_t side = 0; side < 2; ++side) addRow(shared, side, curve, 0, 0, random);
    addRecords(shared, curve);
    return shared;
}

bool onBorder(const BorderUser& user, std::uint32_t u, std::uint32_t v) {
    const bool triangle = user.kind == PatchKind::pn;
    const std::array<bool, 4> on{v == 0, triangle ? u + v == unit : u == unit, !triangle && v == unit, u == 0};
    return on.at(user.side);
}

std::uint64_t alongCurve(const BorderUser& user, std::uint32_t u, std::uint32_t v) {
    const std::uint32_t t = user.side % 2 == 1 ? v : u;
    const std::uint64_t along = (std::uint64_t{user.index} << 24U) + (user.reversed ? unit - t : t);
    return along << (8U - user.level);
}

}  // namespace tessera::splitting
