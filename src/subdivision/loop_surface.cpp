// Loop's surfaces as PN triangles. The limit surface is Bfr's, in double precision: unlike limit masks after some levels of refinement it
// knows what is left of semi-sharp creases.
#include "subdivision/loop_surface.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "subdivision/loop_grid.h"

namespace tessera::subdivision {

namespace {

namespace Bfr = OpenSubdiv::Bfr;

constexpr std::uint32_t kLeastLevel = 2, kMostLevel = 5;
constexpr std::size_t kMostPatches = std::size_t{1} << 20U;  // below 1 GB on the way
// How far Bfr isolates: a grid's points other than corners of faces, and what is looked at between them, lie outside its last cells. No
// farther, as it costs by the square of the valence for each face and level. Sharpness is isolated as far as it goes.
constexpr std::uint32_t kBeyondGrid = 3;
constexpr int kSharpLevel = 10;

struct LimitPoint {
    glm::dvec3 place{0.0}, du{0.0}, dv{0.0};
};

// The limit surface, a face at a time.
class LimitFaces {
public:
    LimitFaces(const Refiner& refiner, std::span<const glm::vec3> points, std::uint32_t level)
        : factory_(refiner,
                   Factory::Options().SetApproxLevelSmooth(static_cast<int>(level + kBeyondGrid)).SetApproxLevelSharp(kSharpLevel)) {
        for (const glm::vec3& point : points) points_.insert(points_.end(), {point.x, point.y, point.z});
    }

    // Whether the face has a limit surface; it is then the one that at() is of.
    bool take(int face) {
        if (!factory_.InitVertexSurface(face, &surface_)) return false;
        patchPoints_.resize(static_cast<std::size_t>(surface_.GetNumPatchPoints()) * 3);
        surface_.PreparePatchPoints(points_.data(), 3, patchPoints_.data(), 3);
        return true;
    }

    [[nodiscard]] LimitPoint at(double u, double v) const {
        const std::array<double, 2> uv{u, v};
        LimitPoint limit;
        surface_.Evaluate(uv.data(), patchPoints_.data(), 3, &limit.place.x, &limit.du.x, &limit.dv.x);
        return limit;
    }

private:
    using Factory = Bfr::RefinerSurfaceFactory<>;
    Factory factory_;
    std::vector<double> points_;
    Bfr::Surface<double> surface_;
    std::vector<double> patchPoints_;
};

// Zero where the derivatives have no common normal: pnMesh() then finds one.
glm::vec3 unitNormal(const LimitPoint& limit) {
    const glm::dvec3 normal = glm::cross(limit.du, limit.dv);
    const double length = glm::length(normal), scale = glm::length(limit.du) * glm::length(limit.dv);
    return length > 1e-9 * scale ? glm::vec3(normal / length) + 0.0F : glm::vec3(0.0F);
}

// A triangle of a face's grid: corners (i, j), and along u and v from there, backwards where it points the other way.
struct GridTriangle {
    int face = 0;
    std::array<std::array<std::uint32_t, 2>, 3> corners{};
    bool upright = true;
};

struct LoopTriangles {
    CageTriangles triangles;
    std::vector<GridTriangle> places;
};

// The triangles of one level.
class LoopMaker {
public:
    LoopMaker(const Refiner& refiner, LimitFaces& limit, std::span<const glm::vec2> textures, std::uint32_t level)
        : refiner_(refiner),
          limit_(limit),
          textures_(textures),
          grid_(refiner, level),
          placed_(grid_.points()),
          pointed_(grid_.normalSlots()) {
        made_.triangles.mesh.positions.resize(grid_.points());
        slots_.resize(grid_.normalSlots());
    }

    LoopTriangles make() {
        for (int face = 0; face < refiner_.GetLevel(0).GetNumFaces(); ++face) {
            if (limit_.take(face)) addFace(face);
        }
        return std::move(made_);
    }

private:
    void addFace(int face) {
        const std::uint32_t size = grid_.size();
        rowNormals_.assign(std::size_t{size + 1} * (size + 1), glm::vec3(0.0F));
        for (std::uint32_t j = 0; j <= size; ++j) {
            for (std::uint32_t i = 0; i + j <= size; ++i) evaluate(face, i, j);
        }
        for (std::uint32_t j = 0; j < size; ++j) {
            for (std::uint32_t i = 0; i + j < size; ++i) {
                addTriangle({face, {{{i, j}, {i + 1, j}, {i, j + 1}}}, true});
                if (i + j + 1 < size) addTriangle({face, {{{i + 1, j + 1}, {i, j + 1}, {i + 1, j}}}, false});
            }
        }
    }

    // What faces share is the first one's, to the bit.
    void evaluate(int face, std::uint32_t i, std::uint32_t j) {
        const double size = grid_.size();
        const std::uint32_t point = grid_.point(face, i, j), slot = grid_.normalSlot(face, i, j);
        const bool own = grid_.ownsNormal(face, i, j);
        glm::vec3& normal = rowNormals_[j * (grid_.size() + 1) + i];
        if (placed_[point] && pointed_[slot] && !own) {
            normal = slots_[slot];
            return;
        }
        const LimitPoint limit = limit_.at(i / size, j / size);
        if (!placed_[point]) made_.triangles.mesh.positions[point] = glm::vec3(limit.place) + 0.0F;
        placed_[point] = true;
        normal = own || !pointed_[slot] ? unitNormal(limit) : slots_[slot];
        if (own) return;
        slots_[slot] = normal;
        pointed_[slot] = true;
    }

    void addTriangle(const GridTriangle& triangle) {
        std::array<std::uint32_t, 3> points{};
        std::array<glm::vec3, 3> normals{};
        std::array<glm::vec2, 3> textures{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [i, j] = triangle.corners[k];
            points[k] = grid_.point(triangle.face, i, j);
            normals[k] = rowNormals_[j * (grid_.size() + 1) + i];
            if (!textures_.empty()) textures[k] = texture(triangle.face, i, j);
        }
        made_.triangles.mesh.triangles.push_back(points);
        made_.triangles.mesh.normals.push_back(normals);
        if (!textures_.empty()) made_.triangles.textures.push_back(textures);
        made_.places.push_back(triangle);
    }

    // Linear over the cage's face.
    [[nodiscard]] glm::vec2 texture(int face, std::uint32_t i, std::uint32_t j) const {
        const auto values = refiner_.GetLevel(0).GetFaceFVarValues(face);
        const auto value = [&](int k) { return glm::dvec2(textures_[static_cast<std::size_t>(values[k])]); };
        const double size = grid_.size(), u = i / size, v = j / size;
        return {(1.0 - u - v) * value(0) + u * value(1) + v * value(2)};
    }

    const Refiner& refiner_;
    LimitFaces& limit_;
    std::span<const glm::vec2> textures_;
    LoopGrid grid_;
    std::vector<bool> placed_, pointed_;
    std::vector<glm::vec3> slots_;       // normals that are shared
    std::vector<glm::vec3> rowNormals_;  // of the face at hand, row by row
    LoopTriangles made_;
};

// How far `place` lies from the surface near (u, v): two steps along the tangent plane towards the foot, and the least distance met.
double distanceFrom(const LimitFaces& limit, const glm::dvec3& place, double u, double v) {
    double least = std::numeric_limits<double>::infinity();
    for (int step = 0; step < 3; ++step) {
        const LimitPoint here = limit.at(u, v);
        const glm::dvec3 away = place - here.place;
        least = std::min(least, glm::length(away));
        const double uu = glm::dot(here.du, here.du), uv = glm::dot(here.du, here.dv), vv = glm::dot(here.dv, here.dv);
        const double det = uu * vv - uv * uv;
        if (!(det > 1e-12 * uu * vv)) break;
        const double toU = glm::dot(away, here.du), toV = glm::dot(away, here.dv);
        u = std::clamp(u + (vv * toU - uv * toV) / det, 0.0, 1.0);
        v = std::clamp(v + (uu * toV - uv * toU) / det, 0.0, 1.0 - u);
    }
    return least;
}

// A patch's point at (u, v).
glm::dvec3 patchPoint(std::span<const glm::vec3> patch, double u, double v) {
    const double w = 1.0 - u - v;
    // Rows of rising powers of v, in a row of rising powers of u.
    const std::array<double, 10> weights{w * w * w,     3 * w * w * u, 3 * w * u * u, u * u * u,     3 * w * w * v,
                                         6 * w * u * v, 3 * u * u * v, 3 * w * v * v, 3 * u * v * v, v * v * v};
    glm::dvec3 sum(0.0);
    for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * glm::dvec3(patch[k]);
    return sum;
}

double measure(LimitFaces& limit, const PnCage& made, std::span<const GridTriangle> places, std::uint32_t level) {
    const double size = 1U << level;
    double greatest = 0;
    int taken = -1;
    for (std::size_t p = 0; p < made.sources.size(); ++p) {
        const GridTriangle& triangle = places[made.sources[p]];
        if (triangle.face != std::exchange(taken, triangle.face)) limit.take(triangle.face);
        const std::span<const glm::vec3> patch(&made.mesh.points[p * pointsPerPatch(PatchKind::pn)], pointsPerPatch(PatchKind::pn));
        const auto look = [&](double b, double c) {
            std::array<glm::dvec2, 3> corner;
            for (std::size_t k = 0; k < 3; ++k) corner[k] = glm::dvec2(triangle.corners[k][0], triangle.corners[k][1]) / size;
            const glm::dvec2 uv = corner[0] + b * (corner[1] - corner[0]) + c * (corner[2] - corner[0]);
            const glm::dvec3 place = made.turned[p] ? patchPoint(patch, c, b) : patchPoint(patch, b, c);
            greatest = std::max(greatest, distanceFrom(limit, place, uv.x, uv.y));
        };
        look(1.0 / 3.0, 1.0 / 3.0);
        // All sides inside a face, and on its edges, are sides of upright triangles.
        if (!triangle.upright) continue;
        look(0.5, 0.0);
        look(0.5, 0.5);
        look(0.0, 0.5);
    }
    return greatest;
}

}  // namespace

LoopSurface loopSurface(const Refiner& refiner, std::span<const glm::vec3> points, std::span<const glm::vec2> textures, double tolerance,
                        const std::string& name) {
    const auto faces = static_cast<std::size_t>(refiner.GetLevel(0).GetNumFaces());
    LoopSurface surface;
    for (std::uint32_t level = kLeastLevel; level <= kMostLevel; ++level) {
        if (level > kLeastLevel && faces << (2 * level) > kMostPatches) break;
        LimitFaces limit(refiner, points, level);
        LoopTriangles made = LoopMaker(refiner, limit, textures, level).make();
        made.triangles.mesh.name = name;
        std::optional<PnCage> patches = pnCage(made.triangles);
        if (!patches.has_value()) break;
        surface.level = level;
        surface.limitDistance = measure(limit, *patches, made.places, level);
        surface.mesh = std::move(patches->mesh);
        if (surface.limitDistance <= tolerance) break;
    }
    return surface;
}

}  // namespace tessera::subdivision
