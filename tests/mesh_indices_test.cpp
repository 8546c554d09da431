// The kernels that count patterns' vertices and triangles, and those that make triangles, against the patterns drawn the slow way.
#include "mesh_reference.h"
#include "split_rig.h"

#include "mesh/offsets.h"
#include "mesh/pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace tessera {
namespace {

using Patterns = std::vector<mesh_pattern>;

constexpr std::uint32_t canary = 0xdeadbeefU;
constexpr std::uint64_t margin = 16;  // triangles before and behind those that are made

// How the kernels are laid over the device.
struct Layout {
    int lanes;
    int group;
};

// Lanes in groups as on GPUs, where it is not the device's own layout.
KernelSources laidOut(KernelSources sources, Layout layout) {
    std::string& lanes = sources.at("device/lanes.clh");
    lanes = "#undef GROUP\n#define GROUP " + std::to_string(layout.group) + "\n" + lanes;
    return sources;
}

class MeshRig {
public:
    explicit MeshRig(Layout layout)
        : session_(-1, laidOut(kernelSources(), layout), splitting::kernelCache(), layout.lanes, {"mesh/offsets.cl", "mesh/indices.cl"}) {
        session_.device.shape.group = layout.group;
    }

    void setPatterns(const Patterns& patterns) {
        patches_ = static_cast<std::uint32_t>(patterns.size());
        patterns_ = buffer("patterns", patterns.size() * sizeof(mesh_pattern));
        if (patches_ > 0) session_.timeline.write(patterns_.cl(), patterns.data(), patterns.size() * sizeof(mesh_pattern));
        sums_ = buffer("sums", sumsBytes(patches_));
        // One more than there are, to see that it stays.
        offsets_ = buffer("offsets", offsetsBytes(patches_) + sizeof(mesh_offset));
        totals_ = buffer("totals", totalsBytes());
        session_.timeline.fill(offsets_.cl(), canary, offsetsBytes(patches_) + sizeof(mesh_offset));
        enqueueOffsets(session_, patches_, patterns_.cl(), sums_.cl(), offsets_.cl(), totals_.cl());
    }

    // Those of all patches, the total and the one behind it.
    [[nodiscard]] std::vector<mesh_offset> offsets() {
        std::vector<mesh_offset> result(patches_ + 2);
        session_.timeline.read(offsets_.cl(), result.data(), result.size() * sizeof(mesh_offset));
        return result;
    }

    [[nodiscard]] mesh_totals totals() {
        mesh_totals result{};
        session_.timeline.read(totals_.cl(), &result, sizeof result);
        return result;
    }

    // The indices of a run of units, `margin` triangles more on both sides.
    [[nodiscard]] std::vector<std::uint32_t> indices(const mesh_piece& piece, std::uint64_t triangles) {
        std::vector<std::uint32_t> result(3 * (triangles + 2 * margin));
        const DeviceBuffer to = buffer("indices", 4 * result.size());
        session_.timeline.fill(to.cl(), canary, 4 * result.size());
        mesh_piece moved = piece;
        moved.first_triangle -= margin;
        session_.launch(session_.kernels.with("mesh_indices", moved, offsets_.cl(), patterns_.cl(), to.cl()), "mesh_indices");
        session_.timeline.read(to.cl(), result.data(), 4 * result.size());
        return result;
    }

private:
    DeviceBuffer buffer(const char* name, std::uint64_t bytes) { return session_.memory.allocate(Purpose::scene, name, bytes); }

    DeviceSession session_;
    std::uint32_t patches_ = 0;
    DeviceBuffer patterns_, sums_, offsets_, totals_;
};

class MeshKernels : public ::testing::TestWithParam<Layout> {};

Patterns randomPatterns(std::size_t count, std::uint32_t most, unsigned seed) {
    std::mt19937 random(seed);
    Patterns patterns;
    for (std::size_t k = 0; k < count; ++k) {
        patterns.push_back(reference::randomPattern(random, most));
        patterns.back().refused = random() % 100 == 0 ? 1 : 0;
    }
    return patterns;
}

bool operator==(const mesh_offset& a, const mesh_offset& b) {
    return a.units == b.units && a.vertices == b.vertices && a.triangles == b.triangles;
}

void add(mesh_offset& sum, const mesh_offset& more) {
    sum.units += more.units;
    sum.vertices += more.vertices;
    sum.triangles += more.triangles;
}

void expectScanned(MeshRig& rig, const Patterns& patterns) {
    rig.setPatterns(patterns);
    const std::vector<mesh_offset> offsets = rig.offsets();
    const mesh_totals totals = rig.totals();
    mesh_totals expected{{}, 0, 0, 0, patterns.size()};
    for (std::size_t k = 0; k < patterns.size(); ++k) {
        ASSERT_TRUE(offsets[k] == expected.sum) << "patch " << k << " of " << patterns.size();
        const mesh_pattern& p = patterns[k];
        add(expected.sum, unitsBefore(p, patternUnits(p)));
        expected.distinct += patternVertices(p);
        expected.nothing += p.form == MESH_NOTHING ? 1U : 0U;
        expected.refused += p.refused;
        if (p.refused != 0) expected.first_refused = std::min<std::uint64_t>(expected.first_refused, k);
    }
    ASSERT_TRUE(offsets[patterns.size()] == expected.sum);
    ASSERT_TRUE(totals.sum == expected.sum);
    EXPECT_EQ(totals.distinct, expected.distinct);
    EXPECT_EQ(totals.nothing, expected.nothing);
    EXPECT_EQ(totals.refused, expected.refused);
    EXPECT_EQ(totals.first_refused, expected.first_refused);
    EXPECT_EQ(static_cast<std::uint32_t>(offsets.back().units), canary) << "behind the total";
}

TEST_P(MeshKernels, OffsetsAreSumsOfThoseBefore) {
    MeshRig rig(GetParam());
    for (const std::size_t count : {0U, 1U, 63U, 64U, 65U, 1023U, 1024U, 1025U, 100000U}) expectScanned(rig, randomPatterns(count, 200, 1));
}

TEST_P(MeshKernels, TotalsPassThirtyTwoBits) {
    MeshRig rig(GetParam());
    Patterns patterns = randomPatterns(300, MESH_RATE_MOST, 2);
    for (std::size_t k = 0; k < patterns.size(); k += 3) {
        patterns[k].form = MESH_RING;
        std::fill(std::begin(patterns[k].side), std::end(patterns[k].side), MESH_RATE_MOST);
        patterns[k].cells_u = patterns[k].cells_v = MESH_RATE_MOST;
    }
    expectScanned(rig, patterns);
    EXPECT_GT(rig.totals().sum.vertices, std::uint64_t{1} << 38U);
    EXPECT_GT(rig.totals().sum.triangles, std::uint64_t{1} << 39U);
}

// What all units of all patches hold, one after the other, vertices by their patch's numbers.
struct Expected {
    std::vector<mesh_offset> units;  // what lies before each, and at the end all
    std::vector<std::uint32_t> patch;
    std::vector<std::uint64_t> number;   // of each vertex of each unit
    std::vector<std::uint64_t> corners;  // three a triangle
};

Expected expectedOf(const Patterns& patterns) {
    Expected expected;
    expected.units.push_back({});
    std::vector<std::uint64_t> numbers;
    for (const mesh_pattern& pattern : patterns) {
        const mesh_offset first = expected.units.back();
        for (std::uint32_t unit = 0; unit < patternUnits(pattern); ++unit) {
            unitVertexNumbers(pattern, unit, numbers);
            expected.number.insert(expected.number.end(), numbers.begin(), numbers.end());
            mesh_offset behind = unitsBefore(pattern, unit + 1);
            add(behind, first);
            expected.units.push_back(behind);
        }
        for (const reference::PatternTriangle& triangle : reference::draw(pattern).triangles)
            for (const reference::PatternCorner& corner : triangle.corners) expected.corners.push_back(corner.number);
    }
    return expected;
}

// Makes units [first, end) and compares each index by the vertex that it names.
void expectPiece(MeshRig& rig, const Expected& expected, std::uint32_t patches, std::size_t first, std::size_t end) {
    SCOPED_TRACE("units " + std::to_string(first) + " to " + std::to_string(end));
    const mesh_offset &from = expected.units[first], &to = expected.units[end];
    const std::uint64_t triangles = to.triangles - from.triangles;
    const std::vector<std::uint32_t> indices = rig.indices({patches, 0, first, end - first, from.vertices, from.triangles}, triangles);
    for (std::size_t k = 0; k < 3 * margin; ++k) {
        ASSERT_EQ(indices[k], canary) << "before the first";
        ASSERT_EQ(indices[indices.size() - 1 - k], canary) << "behind the last";
    }
    std::size_t unit = first;
    for (std::uint64_t t = 0; t < triangles; ++t) {
        while (t + from.triangles >= expected.units[unit + 1].triangles) ++unit;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t vertex = indices[3 * (margin + t) + k] + from.vertices;
            ASSERT_GE(vertex, expected.units[unit].vertices) << "unit " << unit << ", triangle " << t;
            ASSERT_LT(vertex, expected.units[unit + 1].vertices) << "unit " << unit << ", triangle " << t;
            ASSERT_EQ(expected.number[vertex], expected.corners[3 * (from.triangles + t) + k]) << "unit " << unit << ", triangle " << t;
        }
    }
}

void expectIndices(MeshRig& rig, const Patterns& patterns, std::size_t pieces) {
    const Expected expected = expectedOf(patterns);
    const auto patches = static_cast<std::uint32_t>(patterns.size());
    rig.setPatterns(patterns);
    const std::size_t units = expected.units.size() - 1;
    expectPiece(rig, expected, patches, 0, units);
    std::mt19937 random(3);
    for (std::size_t k = 0; k < pieces && !::testing::Test::HasFatalFailure(); ++k) {
        const std::size_t first = random() % units;
        expectPiece(rig, expected, patches, first, first + 1 + random() % (k % 2 == 0 ? 3 : units - first) % (units - first));
    }
}

TEST_P(MeshKernels, IndicesDrawThePatterns) {
    MeshRig rig(GetParam());
    expectIndices(rig, randomPatterns(3000, 9, 4), 30);
    expectIndices(rig, randomPatterns(1000, 60, 5), 10);
}

TEST_P(MeshKernels, IndicesDrawPatternsInUnits) {
    MeshRig rig(GetParam());
    expectIndices(rig, randomPatterns(60, 300, 6), 60);
    Patterns dense;
    for (const auto& [u, v] : {std::pair{100U, 100U}, {65536U, 2U}, {2U, 65536U}, {300U, 0U}, {4099U, 4U}}) {
        mesh_pattern p{};
        p.form = v == 0 ? MESH_TRIANGLE_RING : MESH_RING;
        for (const int side : {0, 1, 2, 3}) p.side[side] = side == 2 && v == 0 ? 0 : side % 2 == 0 ? u : std::max(v, 3U);
        p.cells_u = u;
        p.cells_v = v;
        reference::placeLines(p);
        dense.push_back(p);
    }
    expectIndices(rig, dense, 40);
}

INSTANTIATE_TEST_SUITE_P(Layouts, MeshKernels, ::testing::Values(Layout{16, 1}, Layout{8, 1}, Layout{1, 64}), [](const auto& layout) {
    return "Lanes" + std::to_string(layout.param.lanes) + "Group" + std::to_string(layout.param.group);
});

}  // namespace
}  // namespace tessera
