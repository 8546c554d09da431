// Tessellation patterns made by hand.
#include "hand_patterns.h"

#include "patch_eval.h"

#include <algorithm>

namespace tessera::meshing {

using reference::Random;

std::uint32_t between(Random& random, std::uint32_t low, std::uint32_t high) {
    return low + static_cast<std::uint32_t>(random.unit() * (high - low + 1));
}

namespace {

// Inner lines a third to a whole cell from the sides.
void setLines(mesh_pattern& p, Random& random) {
    const auto off = [&](std::uint32_t cells) { return static_cast<std::uint32_t>(random.between(0.3, 1.0) * unity / cells); };
    p.low_u = off(p.cells_u);
    p.high_u = unity - off(p.cells_u);
    p.low_v = off(p.cells_v);
    p.high_v = unity - off(p.cells_v);
}

}  // namespace

mesh_pattern ring(std::array<std::uint32_t, 4> sides, std::uint32_t cellsU, std::uint32_t cellsV, Random& random) {
    mesh_pattern p{};
    p.form = MESH_RING;
    std::copy(sides.begin(), sides.end(), p.side);
    p.cells_u = cellsU;
    p.cells_v = cellsV;
    setLines(p, random);
    return p;
}

namespace {

mesh_pattern triangleRing(std::array<std::uint32_t, 4> sides, std::uint32_t cells, Random& random) {
    mesh_pattern p{};
    p.form = MESH_TRIANGLE_RING;
    std::copy(sides.begin(), sides.end(), p.side);
    p.cells_u = cells;
    const double part = random.between(0.2, 0.3);
    p.low_u = p.low_v = static_cast<std::uint32_t>(part * unity / (0.25 * cells + 1));
    p.high_u = unity - p.low_u - (cells == 0 ? unity - 3 * p.low_u : 0);
    return p;
}

mesh_pattern triangleGrid(std::uint32_t n) {
    mesh_pattern p{};
    p.form = MESH_TRIANGLE_GRID;
    p.cells_u = p.side[0] = p.side[1] = p.side[3] = n;
    if (n < 3) return p;
    p.low_u = p.low_v = unity / n;
    p.high_u = unity - unity / n;
    return p;
}

// All forms in turn; about every tenth pattern is cut.
mesh_pattern anyPattern(PatchKind kind, std::size_t number, Random& random) {
    const bool large = number % 10 == 9;
    const auto side = [&] { return between(random, 1, large ? 300 : 20); };
    const std::uint32_t a = between(random, 2, 12), b = between(random, 2, 12);
    mesh_pattern p{};
    if (kind == PatchKind::pn) {
        if (large) return triangleRing({side(), side(), 0, side()}, between(random, 90, 120), random);
        switch (number % 5) {
            case 0:
                p.form = std::array{MESH_FAN_0, MESH_FAN_1, MESH_FAN_3}.at(number / 5 % 3);
                p.side[0] = p.side[1] = p.side[3] = 1;
                p.side[p.form == MESH_FAN_0 ? 0 : (p.form == MESH_FAN_1 ? 1 : 3)] = side();
                return p;
            case 1:
                return triangleGrid(between(random, 1, 20));
            default:
                return triangleRing({side(), side(), 0, side()}, between(random, 0, 14), random);
        }
    }
    if (large) return ring({side(), side(), side(), side()}, between(random, 60, 80), between(random, 75, 90), random);
    if (number % 7 == 3) return {MESH_RIBBON_U, {side(), 1, side(), 1}, 0, 0, 0, 0, 0, 0, 0, 0};
    if (number % 7 == 4) return {MESH_RIBBON_V, {1, side(), 1, side()}, 0, 0, 0, 0, 0, 0, 0, 0};
    return ring({side(), side(), side(), side()}, a, b, random);
}

Model modelOf(Scene scene, std::uint64_t seed) {
    Model model;
    Random random(seed);
    for (const PatchKind kind : {PatchKind::bezier, PatchKind::gregory, PatchKind::rational, PatchKind::pn}) {
        for (std::size_t object = 0; object < scene.objects.size(); ++object) {
            const Mesh& mesh = *scene.findMesh(scene.objects[object].mesh);
            for (std::size_t k = 0; mesh.kind == kind && k < mesh.patchCount(); ++k) {
                model.patches.push_back({kind, static_cast<std::uint32_t>(object), static_cast<std::uint32_t>(k),
                                         reference::patchPoints(mesh, k), reference::patchWeights(mesh, k)});
                model.patterns.push_back(anyPattern(kind, k, random));
            }
        }
    }
    model.scene = std::move(scene);
    return model;
}

}  // namespace

Model allKinds() {
    Scene scene = reference::sceneOf({reference::bumpyPnMesh(1, 40), reference::weighted(reference::bumpyBezierMesh(2, 20), 3.0, 3),
                                      reference::bumpyBezierMesh(4, 40),
                                      reference::parted(reference::asGregory(reference::bumpyBezierMesh(5, 20)), 0.2, 6)});
    return modelOf(std::move(scene), 7);
}

// Segments of a side from its middle's bits, which both its patches have; 0 where it is unity point.
std::vector<mesh_pattern> patternsByEdges(VerticesRig& rig, const Scene& scene) {
    Random random(3);
    rig.set(scene, {});
    const PatchSet set = rig.patches();
    std::vector<mesh_pattern> patterns;
    const std::vector<placed_patch> placed = rig.placed();
    for (std::uint32_t k = 0; k < set.patches; ++k) {
        const bool pn = k >= set.rationalEnd;
        const std::uint32_t half = unity / 2;
        const std::array<BorderPlace, 4> middles{{{k, half, 0}, {k, pn ? half : unity, half}, {k, half, unity}, {k, 0, half}}};
        const std::vector<glm::vec3> at = rig.borderVertices(middles);
        std::array<std::uint32_t, 4> sides{};
        for (std::size_t s = 0; s < 4; ++s) {
            const std::uint32_t hash = (bitsOf(at[s].x) * 31U + bitsOf(at[s].y)) * 31U + bitsOf(at[s].z);
            sides.at(s) = (placed[k].flags & (SIDE_DEGENERATE << s)) != 0 || (pn && s == 2) ? 0 : 1 + hash % 37;
        }
        if (pn) {
            patterns.push_back(triangleRing(sides, between(random, 0, k % 16 == 0 ? 100 : 12), random));
        } else {
            const std::uint32_t most = k % 16 == 0 ? 90 : 9;
            patterns.push_back(ring(sides, between(random, 2, most), between(random, 2, most), random));
        }
    }
    rig.set(scene, patterns);
    return patterns;
}

}  // namespace tessera::meshing
