// Models for the tests of weld(): closed patchworks whose neighbours are known, and what the renderer would draw of their borders.
#include "weld_models.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>

namespace tessera::test {

namespace {

constexpr std::array<std::array<std::size_t, 2>, 4> kEnds{{{0, 1}, {1, 2}, {3, 2}, {0, 3}}};
constexpr std::array<std::size_t, 16> kGregoryNet{0, 4, 9, 1, 8, 12, 13, 5, 7, 15, 14, 10, 3, 11, 6, 2};  // file place of net point k

double uniform(std::mt19937& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
}

// The points along a border, and the corners at its ends as points.
std::array<std::size_t, 4> sidePoints(PatchKind kind, std::size_t side) {
    if (kind == PatchKind::pn) {
        constexpr std::array<std::array<std::size_t, 4>, 4> triangle{{{0, 1, 2, 3}, {3, 6, 8, 9}, {0, 0, 0, 0}, {0, 4, 7, 9}}};
        return triangle[side];
    }
    std::array<std::size_t, 4> points{};
    for (std::size_t k = 0; k < 4; ++k) {
        const std::array<std::size_t, 4> ways{k, 4 * k + 3, 12 + k, 4 * k};
        points[k] = kind == PatchKind::gregory ? kGregoryNet[ways[side]] : ways[side];
    }
    return points;
}

glm::vec3 evaluate(const std::array<glm::vec3, 4>& c, const std::array<float, 4>& w, float t) {
    const float s = 1.0F - t;
    const float b0 = (s * s) * s, b1 = 3.0F * ((s * s) * t), b2 = 3.0F * ((t * t) * s), b3 = (t * t) * t;
    if (w[0] == w[1] && w[0] == w[2] && w[0] == w[3]) return (b0 * c[0] + b3 * c[3]) + (b1 * c[1] + b2 * c[2]);
    const glm::vec3 sum = (b0 * (w[0] * c[0]) + b3 * (w[3] * c[3])) + (b1 * (w[1] * c[1]) + b2 * (w[2] * c[2]));
    return sum / ((b0 * w[0] + b3 * w[3]) + (b1 * w[1] + b2 * w[2]));
}

const EdgeRecord* recordOf(const Mesh& mesh, std::size_t patch, std::size_t side) {
    const auto found = std::find_if(mesh.edges.begin(), mesh.edges.end(),
                                    [&](const EdgeRecord& record) { return record.patch == patch && record.side == side; });
    return found == mesh.edges.end() ? nullptr : &*found;
}

float alongCurve(const EdgeRecord& record, float t) {
    return (static_cast<float>(record.index) + (record.reversed ? 1.0F - t : t)) / static_cast<float>(1U << record.level);
}

glm::vec3 drawnCorner(const Mesh& mesh, std::size_t patch, const glm::vec3& own, std::size_t point) {
    for (std::size_t side = 0; side < 4; ++side) {
        const EdgeRecord* record = recordOf(mesh, patch, side);
        if (record == nullptr) continue;
        const std::array<std::size_t, 4> points = sidePoints(mesh.kind, side);
        for (const float t : {0.0F, 1.0F}) {
            if (points[t == 0.0F ? 0 : 3] != point) continue;
            const float along = alongCurve(*record, t);
            if (along > 0.0F && along < 1.0F) return evaluate(record->points, record->weights, along);
        }
    }
    return own;
}

std::array<std::uint32_t, 3> bitsOf(const glm::vec3& v) {
    return {std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y), std::bit_cast<std::uint32_t>(v.z)};
}

std::pair<int, int> edgeKey(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// One lattice point of the tori and balls, and its weight.
struct Lattice {
    int columns, rows;
    bool ball;
    std::vector<glm::dvec3> points;
    std::vector<double> weights;

    [[nodiscard]] std::size_t at(int i, int j) const {
        const int row = ball ? j : j % (3 * rows);
        const int place = row * 3 * columns + i % (3 * columns);
        return static_cast<std::size_t>(place);
    }
};

Lattice makeLattice(int columns, int rows, bool ball, std::mt19937& random) {
    Lattice lattice{columns, rows, ball, {}, {}};
    const int lines = 3 * rows + (ball ? 1 : 0);
    for (int j = 0; j < lines; ++j) {
        for (int i = 0; i < 3 * columns; ++i) {
            const double a = 2.0 * std::numbers::pi * i / (3 * columns);
            const double b = (ball ? 1.0 : 2.0) * std::numbers::pi * j / (3 * rows);
            const bool pole = ball && (j == 0 || j == lines - 1);
            const double bump = pole ? 1.0 : uniform(random, 0.85, 1.15);
            const double ring = ball ? (pole ? 0.0 : std::sin(b) * bump) : 3.0 + std::cos(b) * bump;
            lattice.points.emplace_back(ring * std::cos(a), ring * std::sin(a), (ball ? std::cos(b) : std::sin(b)) * bump);
            lattice.weights.push_back(1.0);
        }
    }
    return lattice;
}

Model patchwork(const Lattice& lattice) {
    Model model;
    const int lines = lattice.rows + (lattice.ball ? 1 : 0);
    model.vertices = lattice.columns * lines;
    const auto vertex = [&](int i, int j) { return (i % lattice.columns) + lattice.columns * (j % lines); };
    for (int j = 0; j < lattice.rows; ++j) {
        for (int i = 0; i < lattice.columns; ++i) {
            ModelPatch patch;
            for (int k = 0; k < 16; ++k) {
                const std::size_t from = lattice.at(3 * i + k % 4, 3 * j + k / 4), to = static_cast<std::size_t>(k);
                patch.net[to] = lattice.points[from];
                patch.weights[to] = lattice.weights[from];
            }
            patch.corners = {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)};
            model.patches.push_back(patch);
        }
    }
    return model;
}

void permute(ModelPatch& patch, const std::array<std::size_t, 16>& from, const std::array<std::size_t, 4>& cornerFrom) {
    const ModelPatch old = patch;
    for (std::size_t k = 0; k < 16; ++k) {
        patch.net[k] = old.net[from[k]];
        patch.weights[k] = old.weights[from[k]];
    }
    for (std::size_t k = 0; k < 4; ++k) patch.corners[k] = old.corners[cornerFrom[k]];
}

void transpose(ModelPatch& patch) {
    std::array<std::size_t, 16> from{};
    for (std::size_t k = 0; k < 16; ++k) from[k] = 4 * (k % 4) + k / 4;
    permute(patch, from, {0, 3, 2, 1});
}

void mirror(ModelPatch& patch) {
    std::array<std::size_t, 16> from{};
    for (std::size_t k = 0; k < 16; ++k) from[k] = 4 * (k / 4) + 3 - k % 4;
    permute(patch, from, {1, 0, 3, 2});
}

int middleOf(Model& model, int a, int b) {
    const auto [found, isNew] = model.middles.emplace(edgeKey(a, b), model.vertices);
    if (isNew) ++model.vertices;
    return found->second;
}

glm::vec3 moved(const glm::dvec3& point, double noise, std::mt19937& random) {
    glm::dvec3 by(1.0);
    while (glm::length(by) > 1.0) by = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
    return {point + noise * by};
}

void append(Mesh& mesh, const ModelPatch& patch) {
    const std::size_t first = mesh.points.size();
    mesh.points.resize(first + pointsPerPatch(mesh.kind));
    for (std::size_t k = 0; k < 16; ++k) {
        const glm::vec3 point(patch.net[k]);
        mesh.points[first + (mesh.kind == PatchKind::gregory ? kGregoryNet[k] : k)] = point;
        if (mesh.kind == PatchKind::rational) mesh.weights.push_back(static_cast<float>(patch.weights[k]));
    }
    if (mesh.kind != PatchKind::gregory) return;
    for (std::size_t k = 0; k < 4; ++k) mesh.points[first + 16 + k] = mesh.points[first + 12 + k];
}

// What all patches draw along the model's edges, by place: (edge as it was before any halving, parameter in 64ths).
using Drawn = std::map<std::tuple<int, int, int>, std::set<std::array<std::uint32_t, 3>>>;

struct Interval {
    int a, b;      // the whole edge
    int from, to;  // in 64ths of it
};

// `halved` tells for each vertex that is a middle of which edge.
Interval wholeEdge(int a, int b, const std::map<int, std::pair<int, int>>& halved) {
    for (const auto& [end, other] : {std::pair(a, b), std::pair(b, a)}) {
        const auto found = halved.find(end);
        if (found == halved.end()) continue;
        const auto [first, second] = found->second;
        if (first != other && second != other) continue;
        const Interval parent = wholeEdge(first, second, halved);
        const int middle = (parent.from + parent.to) / 2, far = other == first ? parent.from : parent.to;
        return end == a ? Interval{parent.a, parent.b, middle, far} : Interval{parent.a, parent.b, far, middle};
    }
    return {a, b, 0, 64};
}

}  // namespace

Model torusModel(int columns, int rows, bool mixed, std::mt19937& random) {
    Lattice lattice = makeLattice(columns, rows, false, random);
    if (!mixed) return patchwork(lattice);
    Model model = patchwork(lattice);
    constexpr std::array<PatchKind, 3> kinds{PatchKind::bezier, PatchKind::gregory, PatchKind::rational};
    for (ModelPatch& patch : model.patches) patch.kind = kinds[random() % 3];
    // Only what belongs to rational patches alone may have weights that differ.
    std::vector<std::uint8_t> polynomial(lattice.points.size());
    const auto visit = [&](auto&& act) {
        for (int k = 0; k < columns * rows; ++k) {
            ModelPatch& patch = model.patches[static_cast<std::size_t>(k)];
            for (int p = 0; p < 16; ++p)
                act(patch, static_cast<std::size_t>(p), lattice.at(3 * (k % columns) + p % 4, 3 * (k / columns) + p / 4));
        }
    };
    visit([&](ModelPatch& patch, std::size_t, std::size_t at) { polynomial[at] |= patch.kind == PatchKind::rational ? 0 : 1; });
    for (std::size_t k = 0; k < lattice.weights.size(); ++k) lattice.weights[k] = polynomial[k] != 0 ? 1.0 : uniform(random, 0.5, 2.0);
    visit([&](ModelPatch& patch, std::size_t p, std::size_t at) { patch.weights[p] = lattice.weights[at]; });
    return model;
}

Model ballModel(int columns, int rows, std::mt19937& random) { return patchwork(makeLattice(columns, rows, true, random)); }

void halve(Model& model, std::size_t index) {
    ModelPatch first = model.patches[index], second = first;
    for (std::size_t row = 0; row < 16; row += 4) {
        std::array<glm::dvec4, 4> p{};
        for (std::size_t k = 0; k < 4; ++k) p[k] = glm::dvec4(first.net[row + k] * first.weights[row + k], first.weights[row + k]);
        for (std::size_t done = 0; done < 4; ++done) {
            first.net[row + done] = glm::dvec3(p[0]) / p[0].w;
            first.weights[row + done] = p[0].w;
            second.net[row + 3 - done] = glm::dvec3(p[3 - done]) / p[3 - done].w;
            second.weights[row + 3 - done] = p[3 - done].w;
            for (std::size_t k = 0; k + done < 3; ++k) p[k] = (p[k] + p[k + 1]) * 0.5;
        }
    }
    const int low = middleOf(model, first.corners[0], first.corners[1]), high = middleOf(model, first.corners[3], first.corners[2]);
    first.corners[1] = second.corners[0] = low;
    first.corners[2] = second.corners[3] = high;
    model.patches[index] = first;
    model.patches.push_back(second);
}

void turn(Model& model, std::mt19937& random) {
    for (ModelPatch& patch : model.patches) {
        if (random() % 2 == 0) transpose(patch);
        if (random() % 2 == 0) mirror(patch);
        if (random() % 2 == 0) transpose(patch);
        const double factor = random() % 2 == 0 ? 1.0 : uniform(random, 0.3, 3.0);
        for (double& weight : patch.weights) weight *= factor;
    }
}

Scene sceneOf(const Model& model, std::mt19937& random, std::vector<PatchPlace>& places) {
    Scene scene;
    scene.name = "model";
    for (const PatchKind kind : {PatchKind::bezier, PatchKind::gregory, PatchKind::rational}) {
        for (const char* half : {" a", " b"}) {
            Mesh mesh;
            mesh.name = std::string(name(kind)) + half;
            mesh.kind = kind;
            Object object;
            object.name = object.mesh = mesh.name;
            scene.meshes.push_back(std::move(mesh));
            scene.objects.push_back(std::move(object));
        }
    }
    places.clear();
    for (const ModelPatch& patch : model.patches) {
        const std::size_t kind = patch.kind == PatchKind::bezier ? 0 : patch.kind == PatchKind::gregory ? 2 : 4;
        Mesh& mesh = scene.meshes[kind + random() % 2];
        places.push_back({static_cast<std::size_t>(&mesh - scene.meshes.data()), mesh.patchCount()});
        append(mesh, patch);
    }
    return scene;
}

double diagonal(const Mesh& mesh) {
    Bounds bounds;
    for (const glm::vec3& point : mesh.points) bounds.include(point);
    return bounds.empty() ? 0.0 : glm::distance(glm::dvec3(bounds.lower), glm::dvec3(bounds.upper));
}

void disturb(Scene& scene, double distance, std::mt19937& random) {
    for (Mesh& mesh : scene.meshes) {
        for (glm::vec3& point : mesh.points) point = moved(point, distance, random);
    }
}

void disturb(Scene& scene, double part, double tolerance, std::mt19937& random) {
    double least = std::numeric_limits<double>::infinity();
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.points.empty()) least = std::min(least, diagonal(mesh));
    }
    disturb(scene, part * tolerance * least, random);
}

std::array<glm::vec3, 4> borderOf(const Mesh& mesh, std::size_t patch, std::size_t side) {
    std::array<glm::vec3, 4> points{};
    const std::array<std::size_t, 4> from = sidePoints(mesh.kind, side);
    for (std::size_t k = 0; k < 4; ++k) points[k] = mesh.points[patch * pointsPerPatch(mesh.kind) + from[k]];
    return points;
}

glm::vec3 drawnPoint(const Mesh& mesh, std::size_t patch, std::size_t side, float t) {
    const std::array<std::size_t, 4> from = sidePoints(mesh.kind, side);
    const std::array<glm::vec3, 4> points = borderOf(mesh, patch, side);
    if (t == 0.0F) return drawnCorner(mesh, patch, points[0], from[0]);
    if (t == 1.0F) return drawnCorner(mesh, patch, points[3], from[3]);
    if (const EdgeRecord* record = recordOf(mesh, patch, side)) return evaluate(record->points, record->weights, alongCurve(*record, t));
    std::array<float, 4> weights{1.0F, 1.0F, 1.0F, 1.0F};
    if (mesh.kind == PatchKind::rational) {
        for (std::size_t k = 0; k < 4; ++k) weights[k] = mesh.weights[patch * pointsPerPatch(mesh.kind) + from[k]];
    }
    return evaluate(points, weights, t);
}

std::size_t openPlaces(const Model& model, const Scene& scene, const std::vector<PatchPlace>& places) {
    std::map<int, std::pair<int, int>> halved;
    for (const auto& [edge, middle] : model.middles) halved.emplace(middle, edge);
    Drawn drawn;
    std::map<int, std::set<std::array<std::uint32_t, 3>>> vertices;
    for (std::size_t p = 0; p < model.patches.size(); ++p) {
        const Mesh& mesh = scene.meshes[places[p].mesh];
        for (std::size_t side = 0; side < 4; ++side) {
            const int a = model.patches[p].corners[kEnds[side][0]], b = model.patches[p].corners[kEnds[side][1]];
            vertices[a].insert(bitsOf(drawnPoint(mesh, places[p].patch, side, 0.0F)));
            vertices[b].insert(bitsOf(drawnPoint(mesh, places[p].patch, side, 1.0F)));
            Interval part = wholeEdge(a, b, halved);
            if (part.a > part.b) part = {part.b, part.a, 64 - part.from, 64 - part.to};
            const int count = std::abs(part.to - part.from), step = part.to > part.from ? 1 : -1;
            for (int k = 0; k <= count; ++k) {
                const float t = static_cast<float>(k) / static_cast<float>(count);
                drawn[{part.a, part.b, part.from + step * k}].insert(bitsOf(drawnPoint(mesh, places[p].patch, side, t)));
            }
        }
    }
    const auto open = [](const auto& place) { return place.second.size() != 1; };
    return static_cast<std::size_t>(std::count_if(drawn.begin(), drawn.end(), open) +
                                    std::count_if(vertices.begin(), vertices.end(), open));
}

}  // namespace tessera::test
