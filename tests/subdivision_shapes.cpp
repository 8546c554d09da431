// Control cages by rule, and what is drawn of them.
#include "subdivision_shapes.h"

#include "subdivision_nets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string_view>
#include <utility>

namespace tessera::test {

namespace {

std::string inWords(float sharpness) {
    const int tenths = static_cast<int>(std::lround(sharpness * 10.0F));
    return std::to_string(tenths / 10) + "_" + std::to_string(tenths % 10);
}

class Shapes {
public:
    std::vector<NamedCage> made;

    void add(const std::string& name, Cage cage) {
        cage.name = name;
        made.push_back({name, std::move(cage)});
    }

    void creasedBoxes();
    void cornersAndDarts();
    void boundaries();
    void valences();
    void polygons();
    void holesAndShells();
    void toriAndSeams();
};

using BoxEdges = std::array<std::pair<std::uint32_t, std::uint32_t>, 12>;

BoxEdges boxEdges() {
    BoxEdges edges;
    std::size_t count = 0;
    for (std::uint32_t a = 0; a < 8; ++a)
        for (const std::uint32_t bit : {1U, 2U, 4U})
            if ((a & bit) == 0) edges[count++] = {a, a | bit};
    return edges;
}

// One set of edges, a bit each, of all that a box' symmetries make of it: the least.
std::vector<std::uint32_t> edgePatterns() {
    const BoxEdges edges = boxEdges();
    std::vector<std::array<std::uint32_t, 12>> symmetries;  // where an edge comes to lie
    std::array<std::uint32_t, 3> axes{0, 1, 2};
    do {
        for (std::uint32_t mirror = 0; mirror < 8; ++mirror) {
            const auto moved = [&](std::uint32_t vertex) {
                std::uint32_t to = mirror;
                for (std::uint32_t axis = 0; axis < 3; ++axis) to ^= (vertex >> axis & 1U) << axes[axis];
                return to;
            };
            std::array<std::uint32_t, 12> symmetry{};
            for (std::size_t k = 0; k < 12; ++k) {
                const std::uint32_t a = moved(edges[k].first), b = moved(edges[k].second);
                const auto at = std::find(edges.begin(), edges.end(), std::pair(std::min(a, b), std::max(a, b)));
                symmetry[k] = static_cast<std::uint32_t>(at - edges.begin());
            }
            symmetries.push_back(symmetry);
        }
    } while (std::next_permutation(axes.begin(), axes.end()));
    std::set<std::uint32_t> least;
    for (std::uint32_t pattern = 0; pattern < 4096; ++pattern) {
        std::uint32_t best = pattern;
        for (const auto& symmetry : symmetries) {
            std::uint32_t image = 0;
            for (std::size_t k = 0; k < 12; ++k) image |= (pattern >> k & 1U) << symmetry[k];
            best = std::min(best, image);
        }
        least.insert(best);
    }
    return {least.begin(), least.end()};
}

// Patterns take the sharpnesses in turn; every third has them mixed.
void Shapes::creasedBoxes() {
    const BoxEdges edges = boxEdges();
    const std::vector<float>& tried = triedSharpness();
    std::size_t turn = 0;
    for (const std::uint32_t pattern : edgePatterns()) {
        Cage cage = boxNet();
        const bool mixed = turn % 3 == 2;
        const float sharpness = tried[turn % tried.size()];
        std::size_t next = turn;
        for (std::size_t k = 0; k < 12; ++k) {
            if ((pattern >> k & 1U) == 0) continue;
            cage.creases.push_back({edges[k].first, edges[k].second, mixed ? tried[next++ % tried.size()] : sharpness});
        }
        add("box_edges_" + std::to_string(pattern) + "_" + (mixed ? "mixed" : inWords(sharpness)), std::move(cage));
        ++turn;
    }
}

void Shapes::cornersAndDarts() {
    for (const float sharpness : triedSharpness()) {
        Cage corner = boxNet();
        corner.corners = {{0, sharpness}, {7, 10.0F}};
        add("box_corner_" + inWords(sharpness), corner);
        // With creases of another sharpness through it.
        corner.creases = {{0, 1, 1.7F}, {0, 2, 3.0F}, {3, 7, sharpness}};
        add("box_corner_creased_" + inWords(sharpness), corner);

        Cage dart = torusNet(6, 5);
        for (std::uint32_t k = 0; k < 3; ++k) dart.creases.push_back({6 + k, 7 + k, sharpness});
        dart.creases.push_back({20, 26, sharpness});
        add("torus_darts_" + inWords(sharpness), std::move(dart));
        Cage fan = drumNet(5);
        fan.creases = {{0, 2, sharpness}, {1, 12, 10.0F}};
        add("drum_dart_" + inWords(sharpness), std::move(fan));
    }
}

void Shapes::boundaries() {
    for (const BoundaryRule rule : {BoundaryRule::edgeAndCorner, BoundaryRule::edgeOnly, BoundaryRule::none}) {
        const std::string by = rule == BoundaryRule::none ? "_none" : (rule == BoundaryRule::edgeOnly ? "_edge" : "_corner");
        const auto addBy = [&](const std::string& name, Cage cage) {
            cage.boundary = rule;
            add(name + by, std::move(cage));
        };
        addBy("grid_5x4", gridNet(5, 4));
        addBy("grid_3x3", gridNet(3, 3));
        Cage creased = gridNet(5, 5);
        creased.creases = {{6, 12, 1.7F}, {12, 18, 10.0F}, {18, 24, 0.5F}, {24, 30, 3.0F}, {14, 15, 5.5F}, {14, 20, 9.5F}, {13, 14, 1.0F}};
        std::erase_if(creased.creases, [](const Crease& crease) { return crease.b - crease.a != 1 && crease.b - crease.a != 6; });
        creased.corners = {{7, 10.0F}, {22, 1.7F}, {28, 0.5F}};
        addBy("grid_tagged", std::move(creased));
        Cage concave = cornerNet(rule == BoundaryRule::none ? 3 : 2);
        addBy("concave", concave);
        // The middle vertex: three faces and two boundary edges.
        for (std::uint32_t v = 0; v < concave.points.size(); ++v)
            if (std::count(concave.faceVertices.begin(), concave.faceVertices.end(), v) == 3) concave.corners = {{v, 10.0F}};
        addBy("concave_corner", concave);
        concave.corners.front().sharpness = 1.7F;
        addBy("concave_soft_corner", std::move(concave));
        if (rule == BoundaryRule::none) continue;
        addBy("quad", gridNet(1, 1));
        addBy("strip_1x4", gridNet(4, 1));
        addBy("fan_5", fanNet(5));
        addBy("triangle", [] {
            Cage cage;
            cage.points = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.1F, 0.2F}, {0.2F, 1.0F, -0.1F}};
            addFace(cage, {0, 1, 2});
            return cage;
        }());
    }
}

void Shapes::valences() {
    for (const int sides : {3, 5, 6, 7, 8, 9, 12, 17, 25, 50}) {
        add("drum_" + std::to_string(sides), drumNet(sides));
        if (sides != 5) add("fan_" + std::to_string(sides), fanNet(sides));
    }
    Cage creased = drumNet(9);
    creased.creases = {{0, 2, 10.0F}, {0, 8, 10.0F}, {1, 20, 1.7F}, {1, 24, 0.5F}, {1, 30, 3.0F}};
    std::erase_if(creased.creases, [](const Crease& crease) { return crease.b % 2 != 0; });
    add("drum_9_creased", std::move(creased));
    // Without creases, which OpenSubdiv cannot have there (clean_cage.h).
    add("valence_2", valenceTwoNet());
}

void Shapes::polygons() {
    for (const int sides : {3, 5, 6, 7, 12}) add("prism_" + std::to_string(sides), prismNet(sides));
    for (const int sides : {3, 4, 5, 9}) add("pyramid_" + std::to_string(sides), pyramidNet(sides));
    add("icosahedron", icosahedronNet());
    add("dodecahedron", dodecahedronNet());
    add("cut_box", cutBoxNet());
    for (const float sharpness : {0.5F, 1.7F, 10.0F}) {
        Cage cage = cutBoxNet();
        cage.creases = {{7, 8, sharpness}, {8, 9, sharpness}, {7, 9, sharpness}, {0, 1, 3.0F}};
        cage.corners = {{2, sharpness}};
        add("cut_box_tagged_" + inWords(sharpness), std::move(cage));
        Cage prism = prismNet(5);
        for (std::uint32_t k = 0; k < 5; ++k) prism.creases.push_back({2 * k + 1, (2 * k + 3) % 10, sharpness});
        add("prism_5_tagged_" + inWords(sharpness), std::move(prism));
    }
}

void Shapes::holesAndShells() {
    Cage torus = torusNet(6, 5);
    torus.holes = {0, 1, 7, 20};
    add("torus_holes", torus);
    Cage box = boxNet();
    box.holes = {1};
    box.creases = {{0, 1, 1.7F}};
    add("box_hole", std::move(box));
    Cage prism = prismNet(5);
    prism.holes = {0};
    add("prism_hole", std::move(prism));
    add("shells_closed", together({boxNet(), torusNet(4, 3), drumNet(5), cutBoxNet()}));
    add("shells_mixed", together({fanNet(3), torus, pyramidNet(5), gridNet(2, 3)}));
}

// Texture coordinates by place, apart in every face where `islands` has it so.
void addTexture(Cage& cage, bool islands, float seamAt) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
    std::size_t corner = 0;
    for (std::uint32_t face = 0; face < cage.faceCount(); ++face) {
        const std::size_t first = corner;
        float middle = 0.0F;
        for (std::uint32_t k = 0; k < cage.faceSizes[face]; ++k) middle += cage.points[cage.faceVertices[first + k]].x;
        const bool beyond = middle > seamAt * static_cast<float>(cage.faceSizes[face]);
        for (; corner < first + cage.faceSizes[face]; ++corner) {
            const std::uint32_t vertex = cage.faceVertices[corner];
            const auto [at, isNew] = numbers.emplace(std::pair(islands ? face : (beyond ? 1U : 0U), vertex), numbers.size());
            if (isNew) {
                const glm::vec3& p = cage.points[vertex];
                cage.texturePoints.emplace_back(0.3F * p.x + 0.1F * p.z + (beyond ? 2.0F : 0.0F), 0.4F * p.y - 0.2F * p.z);
            }
            cage.faceTexturePoints.push_back(at->second);
        }
    }
}

void Shapes::toriAndSeams() {
    for (const auto& [columns, rows] : {std::pair(3, 3), std::pair(3, 4), std::pair(5, 3), std::pair(8, 5)})
        add("torus_" + std::to_string(columns) + "x" + std::to_string(rows), torusNet(columns, rows));
    Cage ring = torusNet(8, 5);
    for (std::uint32_t k = 0; k < 8; ++k) ring.creases.push_back({k, (k + 1) % 8, triedSharpness()[k % 7]});
    for (std::uint32_t k = 0; k < 8; ++k) ring.creases.push_back({16 + k, 16 + (k + 1) % 8, 10.0F});
    add("torus_creased", std::move(ring));
    Cage seam = torusNet(8, 5);
    addTexture(seam, false, 0.0F);
    add("torus_seam", std::move(seam));
    Cage islands = cutBoxNet();
    islands.creases = {{0, 1, 1.7F}, {0, 2, 10.0F}};
    addTexture(islands, true, 0.0F);
    add("cut_box_islands", std::move(islands));
    Cage grid = gridNet(5, 4);
    addTexture(grid, false, 0.2F);
    add("grid_seam", std::move(grid));
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        NamedCage shape = randomShape(seed, 2 + static_cast<int>(seed) % 4 * 2);
        if (seed % 4 == 0) addTexture(shape.cage, false, 0.1F);
        made.push_back(std::move(shape));
    }
}

// The face's outline moves out and shrinks; quadrilaterals close the gap.
void grow(Cage& cage, std::size_t face, float distance, float shrink) {
    std::array<std::uint32_t, 4> from{};
    std::copy_n(cage.faceVertices.begin() + 4 * static_cast<std::ptrdiff_t>(face), 4, from.begin());
    const auto point = [&](std::size_t k) { return cage.points[from[k % 4]]; };
    const glm::vec3 middle = 0.25F * (point(0) + point(1) + point(2) + point(3));
    const glm::vec3 out = glm::normalize(glm::cross(point(2) - point(0), point(3) - point(1)));
    const auto first = static_cast<std::uint32_t>(cage.points.size());
    for (std::size_t k = 0; k < 4; ++k) cage.points.push_back(glm::mix(point(k), middle, shrink) + distance * out);
    for (std::uint32_t k = 0; k < 4; ++k) {
        addFace(cage, {from[k], from[(k + 1) % 4], first + (k + 1) % 4, first + k});
        cage.faceVertices[4 * face + k] = first + k;
    }
}

}  // namespace

NamedCage randomShape(std::uint32_t seed, int steps) {
    std::mt19937 random(seed);
    const auto unit = [&] { return static_cast<float>(random() % 1000U) / 1000.0F; };
    Cage cage = boxNet();
    for (int step = 0; step < steps; ++step) grow(cage, random() % cage.faceCount(), 0.3F + unit(), 0.1F + 0.4F * unit());
    shake(cage, 0.05F, seed);
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t f = 0; f < cage.faceCount(); ++f) {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t a = cage.faceVertices[4 * f + k], b = cage.faceVertices[4 * f + (k + 1) % 4];
            edges.emplace(std::min(a, b), std::max(a, b));
        }
    }
    const std::vector<float>& tried = triedSharpness();
    for (const auto& [a, b] : edges)
        if (random() % 4U == 0) cage.creases.push_back({a, b, random() % 4U == 0 ? 6.0F * unit() : tried[random() % tried.size()]});
    for (std::uint32_t v = 0; v < cage.points.size(); ++v)
        if (random() % 12U == 0) cage.corners.push_back({v, tried[random() % tried.size()]});
    cage.name = "random_" + std::to_string(seed);
    return {cage.name, cage};
}

const std::vector<float>& triedSharpness() {
    static const std::vector<float> tried{0.5F, 1.0F, 1.7F, 3.0F, 5.5F, 9.5F, 10.0F};
    return tried;
}

std::vector<NamedCage> allShapes() {
    Shapes shapes;
    shapes.creasedBoxes();
    shapes.cornersAndDarts();
    shapes.boundaries();
    shapes.valences();
    shapes.polygons();
    shapes.holesAndShells();
    shapes.toriAndSeams();
    return std::move(shapes.made);
}

std::vector<NamedCage> everyShape(std::size_t step, std::size_t first) {
    std::vector<NamedCage> all = allShapes(), some;
    for (std::size_t k = first; k < all.size(); k += step) some.push_back(std::move(all[k]));
    return some;
}

std::vector<NamedCage> someShapes() {
    constexpr std::array<std::string_view, 20> names{"box_corner_1_7",
                                                     "box_corner_creased_5_5",
                                                     "torus_darts_3_0",
                                                     "drum_dart_0_5",
                                                     "grid_5x4_corner",
                                                     "grid_5x4_edge",
                                                     "grid_5x4_none",
                                                     "grid_tagged_edge",
                                                     "concave_corner_corner",
                                                     "fan_7",
                                                     "drum_9_creased",
                                                     "drum_25",
                                                     "valence_2",
                                                     "prism_5",
                                                     "pyramid_3",
                                                     "cut_box_tagged_1_7",
                                                     "torus_holes",
                                                     "shells_closed",
                                                     "torus_3x3",
                                                     "cut_box_islands"};
    std::vector<NamedCage> some;
    for (NamedCage& shape : allShapes()) {
        const bool named = std::find(names.begin(), names.end(), shape.name) != names.end();
        if (named || shape.name == "random_4" || shape.name == "random_7") some.push_back(std::move(shape));
    }
    return some;
}

Drawn drawnOf(const Cage& cage) {
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    std::vector<std::vector<std::uint32_t>> faces;
    std::map<Edge, int> allEdges, edges;
    const auto count = [](std::map<Edge, int>& to, const std::vector<std::uint32_t>& face) {
        for (std::size_t k = 0; k < face.size(); ++k) {
            const std::uint32_t a = face[k], b = face[(k + 1) % face.size()];
            ++to[{std::min(a, b), std::max(a, b)}];
        }
    };
    std::size_t first = 0;
    for (const std::uint32_t size : cage.faceSizes) {
        const auto begin = cage.faceVertices.begin() + static_cast<std::ptrdiff_t>(first);
        count(allEdges, faces.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(size)));
        first += size;
    }
    std::set<std::uint32_t> rim;
    for (const auto& [edge, uses] : allEdges)
        if (uses == 1) rim.insert({edge.first, edge.second});
    Drawn drawn;
    std::set<std::uint32_t> vertices;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const bool atRim = std::any_of(faces[f].begin(), faces[f].end(), [&](std::uint32_t v) { return rim.contains(v); });
        if (std::find(cage.holes.begin(), cage.holes.end(), f) != cage.holes.end()) continue;
        if (cage.boundary == BoundaryRule::none && atRim) continue;
        ++drawn.faces;
        count(edges, faces[f]);
        vertices.insert(faces[f].begin(), faces[f].end());
    }
    for (const auto& [edge, uses] : edges) drawn.boundaryEdges += uses == 1 ? 1U : 0U;
    drawn.euler = static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) + static_cast<long>(drawn.faces);
    return drawn;
}

double sizeOf(const Cage& cage) {
    Bounds box;
    for (const glm::vec3& point : cage.points) box.include(point);
    return glm::distance(glm::dvec3(box.lower), glm::dvec3(box.upper));
}

Scene sceneOf(const NamedCage& shape) {
    Scene scene;
    scene.name = shape.name;
    scene.cages.push_back(shape.cage);
    Object object;
    object.name = shape.name;
    object.mesh = shape.cage.name;
    scene.objects.push_back(object);
    return scene;
}

}  // namespace tessera::test
