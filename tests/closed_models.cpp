// Closed solids and views of them. A control point is a function of its place on a lattice, so whoever shares it has the same bits.
#include "closed_models.h"

#include "patch_eval.h"
#include "ray_caster.h"

#include "tessera/surfaces.h"
#include "tessera/triangles.h"
#include "tessera/weld.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace tessera::test {

namespace {

using reference::Random;

struct Control {
    glm::vec3 point;
    float weight;
};

// A random sequence of a lattice point's own.
Random randomOf(std::uint64_t seed, const glm::ivec3& place) {
    std::uint64_t state = seed;
    for (int axis = 0; axis < 3; ++axis) state = (state + static_cast<std::uint64_t>(place[axis]) + 1) * 0x2545f4914f6cdd1dU;
    return Random(state);
}

// `place` on the ball, moved by up to `roughness` along each axis.
Control roughControl(std::uint64_t seed, const glm::ivec3& place, const glm::dvec3& onBall, double roughness) {
    Random random = randomOf(seed, place);
    const glm::dvec3 moved = onBall + random.inCube(roughness);
    return {glm::vec3(moved), static_cast<float>(std::pow(3.0, random.between(-1.0, 1.0)))};
}

// A point of the surface of the cube [0, steps]^3, blown up.
Control cubeControl(std::uint64_t seed, const glm::ivec3& place, int steps, double roughness) {
    const glm::dvec3 centred = glm::dvec3(2 * place - steps) / static_cast<double>(steps);
    return roughControl(seed, place, glm::normalize(centred), roughness);
}

// One of the six sides of that cube, outward where the first step is followed by the second counter-clockwise.
struct CubeSide {
    int axis;
    bool upper;

    [[nodiscard]] glm::ivec3 place(int steps, int i, int j) const {
        glm::ivec3 result;
        result[axis] = upper ? steps : 0;
        result[(axis + (upper ? 1 : 2)) % 3] = i;
        result[(axis + (upper ? 2 : 1)) % 3] = j;
        return result;
    }
};

template <typename Visit>
void forEachCubeSide(const Visit& visit) {
    for (int axis = 0; axis < 3; ++axis)
        for (const bool upper : {false, true}) visit(CubeSide{axis, upper});
}

// Appends a patch whose parameters run one of the eight ways over `control`, and its weights.
void addPatch(Mesh& mesh, Random& random, const std::function<Control(int, int)>& control) {
    const bool exchange = random.unit() < 0.5;
    const bool flipU = random.unit() < 0.5;
    const bool flipV = random.unit() < 0.5;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            const int i = flipU ? 3 - column : column;
            const int j = flipV ? 3 - row : row;
            const Control c = exchange ? control(j, i) : control(i, j);
            mesh.points.push_back(c.point);
            if (mesh.kind == PatchKind::rational) mesh.weights.push_back(c.weight);
        }
    }
}

void addGregory(Mesh& mesh, Random& random, const std::function<Control(int, int)>& control) {
    Mesh bezier;
    addPatch(bezier, random, control);
    const Mesh gregory = reference::parted(reference::asGregory(bezier), 0.05, mesh.points.size());
    mesh.points.insert(mesh.points.end(), gregory.points.begin(), gregory.points.end());
}

// Two triangles that meet along the diagonal from (0, 0) to (3, 3), with normals away from the origin.
void addTriangles(Mesh& mesh, const std::function<Control(int, int)>& control) {
    for (const bool second : {false, true}) {
        const auto at = [&](int i, int j) { return second ? control(i, i + j).point : control(i + j, j).point; };
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i + j < 4; ++i) mesh.points.push_back(at(i, j));
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i + j < 3; ++i) mesh.points.push_back(glm::normalize(at(i, j) + at(i + 1, j) + at(i, j + 1)));
    }
}

// Appends what covers `control` to a mesh of any kind.
void addPart(Mesh& mesh, Random& random, const std::function<Control(int, int)>& control) {
    switch (mesh.kind) {
        case PatchKind::gregory:
            return addGregory(mesh, random, control);
        case PatchKind::pn:
            return addTriangles(mesh, control);
        case PatchKind::bezier:
        case PatchKind::rational:
            return addPatch(mesh, random, control);
    }
}

Mesh cubeSolidOf(PatchKind kind, std::uint64_t seed, int along) {
    Mesh mesh;
    mesh.kind = kind;
    Random random(seed + 1);
    const double roughness = 0.25 / along;
    forEachCubeSide([&](const CubeSide& side) {
        for (int patch = 0; patch < along * along; ++patch) {
            addPatch(mesh, random, [&](int i, int j) {
                return cubeControl(seed, side.place(3 * along, 3 * (patch % along) + i, 3 * (patch / along) + j), 3 * along, roughness);
            });
        }
    });
    return mesh;
}

glm::dquat anyTurn(Random& random) {
    const glm::dvec3 axis = glm::normalize(random.inCube(1.0) + glm::dvec3(1e-3, 0, 0));
    return glm::angleAxis(random.between(0.0, 2.0 * std::numbers::pi), axis);
}

// A point of the surface in the world, and the normal there that points away from the middle.
struct Spot {
    glm::dvec3 point{0.0};
    glm::dvec3 outward{0.0};
};

Spot anySpot(const Scene& scene, const glm::dvec3& middle, Random& random) {
    const auto index = [&random](std::size_t count) { return static_cast<std::size_t>(random.unit() * static_cast<double>(count)); };
    const Object& object = scene.objects[index(scene.objects.size())];
    const Mesh& mesh = *scene.findMesh(object.mesh);
    const std::size_t patch = index(mesh.patchCount());
    const std::vector<glm::dvec3> points = reference::patchPoints(mesh, patch);
    const std::vector<double> weights = reference::patchWeights(mesh, patch);
    const double u = random.unit();
    const double v = mesh.kind == PatchKind::pn ? random.between(0.0, 1.0 - u) : random.unit();
    const reference::Placement place = reference::placement(object.transform);
    const glm::dvec3 point = place(reference::evaluate(mesh.kind, points, u, v, weights).position);
    const glm::dvec3 normal = place.rotation * reference::unitNormal(mesh.kind, points, u, v, weights);
    return {point, glm::dot(normal, point - middle) < 0.0 ? -normal : normal};
}

glm::dvec3 anyDirection(Random& random) { return anyTurn(random) * glm::dvec3(0, 0, 1); }

// As cameraAt(), rolled about the view axis.
Camera rolled(const glm::dvec3& eye, const glm::dvec3& direction, double fovyDegrees, Random& random) {
    Camera camera = reference::cameraAt(eye, eye + direction, fovyDegrees);
    const glm::dquat roll = glm::angleAxis(random.between(0.0, 2.0 * std::numbers::pi), glm::dvec3(0, 0, 1));
    camera.transform.rotation = glm::quat(glm::dquat(camera.transform.rotation) * roll);
    return camera;
}

}  // namespace

Mesh cubeSolid(std::uint64_t seed, int along) { return cubeSolidOf(PatchKind::bezier, seed, along); }

Mesh weightedCubeSolid(std::uint64_t seed, int along) { return cubeSolidOf(PatchKind::rational, seed, along); }

Mesh polarSolid(std::uint64_t seed, int around, int along) {
    Mesh mesh;
    Random random(seed + 1);
    const double roughness = 0.6 / (around + along);
    const int columns = 3 * around;
    const int rows = 3 * along;
    const auto control = [&](int column, int row) {
        const bool pole = row == 0 || row == rows;
        const glm::ivec3 place(pole ? 0 : column % columns, row, 0);
        const double longitude = 2.0 * std::numbers::pi * place.x / columns;
        const double latitude = std::numbers::pi * row / rows;
        const glm::dvec3 onBall(std::sin(latitude) * std::cos(longitude), std::sin(latitude) * std::sin(longitude), std::cos(latitude));
        return roughControl(seed, place, onBall, roughness);
    };
    for (int patch = 0; patch < around * along; ++patch) {
        addPatch(mesh, random, [&](int i, int j) { return control(3 * (patch % around) + i, 3 * (patch / around) + j); });
    }
    return mesh;
}

Mesh triangleSolid(std::uint64_t seed, int along, TriangleLook look) {
    TriangleMesh triangles;
    triangles.name = "triangles";
    Random random(seed + 1);
    const auto add = [&](const std::array<glm::vec3, 3>& corners) {
        const auto first = static_cast<std::uint32_t>(triangles.positions.size());
        triangles.positions.insert(triangles.positions.end(), corners.begin(), corners.end());
        triangles.triangles.push_back({first, first + 1, first + 2});
        if (look != TriangleLook::creased) return;
        const glm::vec3 face = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        const bool own = random.unit() < 0.5;
        triangles.normals.push_back(
            {own ? face : glm::normalize(corners[0]), own ? face : glm::normalize(corners[1]), own ? face : glm::normalize(corners[2])});
    };
    forEachCubeSide([&](const CubeSide& side) {
        const auto at = [&](int i, int j) { return cubeControl(seed, side.place(along, i, j), along, 0.4 / along).point; };
        for (int j = 0; j < along; ++j) {
            for (int i = 0; i < along; ++i) {
                add({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                add({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            }
        }
    });
    return pnMesh(triangles, look == TriangleLook::flat);
}

std::vector<Mesh> mixedSolid(std::uint64_t seed, int along, const std::vector<PatchKind>& kinds) {
    Random random(seed + 1);
    std::vector<Mesh> meshes(kinds.size());
    for (std::size_t k = 0; k < kinds.size(); ++k) meshes[k].kind = kinds[k];
    forEachCubeSide([&](const CubeSide& side) {
        for (int part = 0; part < along * along; ++part) {
            Mesh& mesh = meshes[static_cast<std::size_t>(random.unit() * static_cast<double>(kinds.size()))];
            const auto borderWeight = static_cast<float>(random.between(0.5, 2.0));
            addPart(mesh, random, [&](int i, int j) {
                Control c =
                    cubeControl(seed, side.place(3 * along, 3 * (part % along) + i, 3 * (part / along) + j), 3 * along, 0.25 / along);
                if (i % 3 == 0 || j % 3 == 0) c.weight = borderWeight;
                return c;
            });
        }
    });
    return meshes;
}

Scene placedAnyhow(std::vector<Mesh> meshes, std::uint64_t seed) {
    Scene scene = reference::sceneOf(std::move(meshes));
    Random random(seed);
    const Transform transform{glm::vec3(random.inCube(3.0)), glm::quat(anyTurn(random))};
    for (Object& object : scene.objects) object.transform = transform;
    return scene;
}

std::vector<ClosedModel> closedModels() {
    std::vector<ClosedModel> models;
    const auto add = [&models](const std::string& name, std::vector<Mesh> meshes) {
        models.push_back({name, placedAnyhow(std::move(meshes), 100 + models.size())});
    };
    add("bezier_6", {cubeSolid(1, 1)});
    add("bezier_54", {cubeSolid(2, 3)});
    add("bezier_beside_gregory", mixedSolid(3, 2, {PatchKind::bezier, PatchKind::gregory}));
    add("bezier_beside_pn", mixedSolid(4, 2, {PatchKind::bezier, PatchKind::pn}));
    add("all_kinds", mixedSolid(10, 2, {PatchKind::bezier, PatchKind::gregory, PatchKind::rational, PatchKind::pn}));
    weld(models.back().scene);
    add("polar", {polarSolid(5, 5, 4)});
    add("rational", {weightedCubeSolid(6, 2)});
    add("sphere", {sphere("sphere", 1.0, -1.0, 1.0)});
    add("torus", {torus("torus", 0.75, 0.25)});
    add("pn_smooth", {triangleSolid(7, 2, TriangleLook::smooth)});
    add("pn_creased", {triangleSolid(8, 3, TriangleLook::creased)});
    add("pn_flat", {triangleSolid(9, 2, TriangleLook::flat)});
    return models;
}

Camera randomView(const Scene& scene, ViewKind kind, std::uint64_t seed) {
    Random random(seed);
    const Bounds bounds = worldBounds(scene);
    const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.lower) + glm::dvec3(bounds.upper));
    const Spot spot = anySpot(scene, middle, random);
    const glm::dvec3 away = anyDirection(random);
    // Each number is drawn in a statement of its own: compilers differ in the order of arguments.
    double fovy = 30.0;
    glm::dvec3 direction = away;
    switch (kind) {
        case ViewKind::far:
            direction = random.inCube(0.5) - away;
            return rolled(middle + random.between(6.0, 30.0) * away, direction, fovy, random);
        case ViewKind::near:
            fovy = random.between(30.0, 80.0);
            direction = random.inCube(0.5) - spot.outward;
            return rolled(spot.point + random.between(0.3, 1.5) * spot.outward, direction, fovy, random);
        case ViewKind::grazing:
            direction = glm::normalize(glm::cross(spot.outward, away)) - random.between(0.0, 0.3) * spot.outward;
            return rolled(spot.point + random.between(0.02, 0.15) * spot.outward, direction, 60.0, random);
        case ViewKind::throughNearPlane: {
            const double near = random.between(0.1, 0.6);
            // Not away from the solid, where nothing would be seen.
            if (glm::dot(away, spot.outward) > 0.3) direction = -away;
            fovy = random.between(50.0, 100.0);
            Camera camera = rolled(spot.point + random.between(-0.5, 0.5) * near * spot.outward, direction, fovy, random);
            camera.near = static_cast<float>(near);
            return camera;
        }
        case ViewKind::inside:
            fovy = random.between(40.0, 100.0);
            return rolled(middle + random.inCube(0.2), direction, fovy, random);
        case ViewKind::aside:
            break;
    }
    fovy = random.between(20.0, 90.0);
    direction = random.inCube(1.5) - away;
    return rolled(middle + random.between(0.5, 4.0) * away, direction, fovy, random);
}

}  // namespace tessera::test
