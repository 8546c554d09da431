// The watertight rule, compiled as C++ from the kernels' own headers, under edge rates made to do harm: whatever they are, as long as they
// are functions of the edge, the ranges' borders meet. Rates are hashes of edges here, and what the interior asks for is chance.
#include "split/quad_shared.h"
#include "surface/patch_shared.h"

#include "core/frame_shared.h"
#include "device/lanes_host.h"

#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

// clang-format off
#include "device/kernel_headers_begin.h"
namespace tessera::kernels {
#include "split/quad_measure.clh"
}  // namespace tessera::kernels
#include "device/kernel_headers_end.h"
// clang-format on

namespace tessera::splitting {
namespace {

using kernels::quad_edge;
using kernels::quad_point;

// Rules that look as good, and leave cracks.
enum class Wrong {
    no,
    remeasured,   // parts of uniform edges are measured again
    oneAtMiddle,  // an edge of rate one is cut at its middle, and its parts have rate one
    endsByDepth,  // a range of so many cuts is drawn though an edge is not uniform, with the largest rate there
};

// An experiment: one patch, and chances of rates in percent.
struct Trial {
    std::uint64_t seed = 0;
    int kind = KIND_BEZIER;
    std::uint32_t degenerateSides = 0;  // SIDE_DEGENERATE << side
    std::uint32_t gridBits = 4;
    std::uint32_t levelMost = 4;
    std::uint32_t nonUniform = 60;
    std::uint32_t one = 30;
    std::uint32_t inner = 20;  // chance that the interior wants more than its edges
    Wrong wrong = Wrong::no;
};

std::uint64_t mixed(std::uint64_t x) {
    x ^= x >> 31U;
    x *= 0x7fb5d329728ea185U;
    x ^= x >> 27U;
    x *= 0x81dadef4bc2dd44dU;
    return x ^ (x >> 33U);
}

bool before(const quad_point& a, const quad_point& b) { return a.u < b.u || (a.u == b.u && a.v < b.v); }
bool equal(const quad_point& a, const quad_point& b) { return a.u == b.u && a.v == b.v; }

std::uint64_t hashOf(std::uint64_t seed, quad_point a, quad_point b) {
    if (before(b, a)) std::swap(a, b);
    std::uint64_t state = seed;
    for (const int coordinate : {a.u, a.v, b.u, b.v}) state = mixed(state ^ static_cast<std::uint64_t>(coordinate) * 0x9e3779b97f4a7c15U);
    return state;
}

// An edge's rate: what edge_rate() would say of some surface or other. Where an edge must be one point, edge_level() knows.
std::uint32_t adversary(const Trial& trial, const kernels::patch_ref& patch, const quad_edge& edge) {
    bool zero = false;
    bool forced = false;
    const std::uint32_t level = kernels::edge_level(patch, edge, &zero, &forced);
    if (zero) return RATE_ZERO;
    if (level >= trial.levelMost) return RATE_ONE + trial.gridBits;
    const std::uint64_t hash = hashOf(trial.seed, edge.from, edge.to);
    if (hash % 100 < trial.nonUniform) return RATE_NONUNIFORM;
    if ((hash >> 8U) % 100 < trial.one) return RATE_ONE;
    return RATE_ONE + static_cast<std::uint32_t>((hash >> 16U) % (trial.gridBits + 1));
}

constexpr int unit = UNIT;

// The patch's corners, as numbers of bits u and v, at the ends of each side. A triangle has no side 2.
std::array<std::array<std::size_t, 2>, 4> endsOf(int kind) {
    if (kind == KIND_PN) return {{{0, 1}, {1, 2}, {2, 2}, {0, 2}}};
    return {{{0, 1}, {1, 3}, {2, 3}, {0, 2}}};
}

bool onSide(int kind, std::size_t side, const quad_point& p) {
    const std::array<bool, 4> on{p.v == 0, kind == KIND_PN ? p.u + p.v == unit : p.u == unit, kind != KIND_PN && p.v == unit, p.u == 0};
    return on[side];
}

// The point that all points of a side are which is one point: the first of the corners that sides have made one.
quad_point settled(const Trial& trial, const quad_point& p) {
    const auto ends = endsOf(trial.kind);
    const auto isPoint = [&](std::size_t side) { return (trial.degenerateSides & (SIDE_DEGENERATE << side)) != 0; };
    std::array<std::size_t, 4> first{0, 1, 2, 3};
    for (int round = 0; round < 3; ++round)
        for (std::size_t side = 0; side < 4; ++side)
            if (isPoint(side)) first[ends[side][0]] = first[ends[side][1]] = std::min(first[ends[side][0]], first[ends[side][1]]);
    for (std::size_t side = 0; side < 4; ++side) {
        if (!isPoint(side) || !onSide(trial.kind, side, p)) continue;
        const std::size_t corner = first[ends[side][0]];
        return {(corner & 1U) != 0 ? unit : 0, (corner & 2U) != 0 ? unit : 0};
    }
    return p;
}

// Segments between vertices that differ, each with how often it was walked forward less backward.
class Walks {
public:
    explicit Walks(const Trial& trial) : trial_(trial) {}

    // Along an edge of 2^k segments by halving it, `times` times.
    void uniform(const quad_point& a, const quad_point& b, std::uint32_t segments, int times) {
        if (segments < 2) return segment(settled(trial_, a), settled(trial_, b), times);
        const quad_point middle{(a.u + b.u) >> 1, (a.v + b.v) >> 1};
        uniform(a, middle, segments / 2, times);
        uniform(middle, b, segments / 2, times);
    }

    // How many segments do not cancel.
    [[nodiscard]] std::size_t open() {
        std::sort(walked_.begin(), walked_.end());
        std::size_t open = 0;
        for (auto first = walked_.begin(); first != walked_.end();) {
            const auto end = std::find_if(first, walked_.end(), [&](const auto& one) { return one.first != first->first; });
            int sum = 0;
            for (auto one = first; one != end; ++one) sum += one->second;
            open += sum != 0 ? 1U : 0U;
            first = end;
        }
        return open;
    }

private:
    using Key = std::array<int, 4>;
    void segment(const quad_point& a, const quad_point& b, int times) {
        if (before(a, b)) walked_.push_back({{a.u, a.v, b.u, b.v}, times});
        if (before(b, a)) walked_.push_back({{b.u, b.v, a.u, a.v}, -times});
    }

    const Trial& trial_;
    std::vector<std::pair<Key, int>> walked_;
};

// A range cut with the rate-one edges at their middles.
std::array<quad_range, 2> cutAtMiddles(const quad_range& parent, int direction, const std::array<std::uint32_t, 5>& rates) {
    std::array<quad_range, 2> children{parent, parent};
    const auto put = [](quad_range& range, int k, const quad_point& p) {
        range.corner_u[k & 3] = static_cast<std::uint32_t>(p.u);
        range.corner_v[k & 3] = static_cast<std::uint32_t>(p.v);
    };
    const auto middle = [&](int k) {
        const quad_point a = kernels::quad_corner(&parent, k);
        const quad_point b = kernels::quad_corner(&parent, k + 1);
        return quad_point{(a.u + b.u) >> 1, (a.v + b.v) >> 1};
    };
    for (quad_range& child : children) child.sizes += 1U << (8 * direction);
    const std::array<std::array<std::uint32_t, 3>, 2> rate{{{rates[0], rates[4], rates[3]}, {rates[1], rates[4], rates[2]}}};
    for (std::size_t which = 0; which < 2; ++which) {
        quad_range& child = children[which];
        put(child, direction + (which == 0 ? 1 : 0), middle(direction));
        put(child, direction + (which == 0 ? 2 : 3), middle(direction + 2));
        child.rates = kernels::quad_with_byte(child.rates, direction, rate[which][0]);
        child.rates = kernels::quad_with_byte(child.rates, direction + (which == 0 ? 1 : 3), rate[which][1]);
        child.rates = kernels::quad_with_byte(child.rates, direction + 2, rate[which][2]);
    }
    return children;
}

struct Outcome {
    std::size_t open = 0;    // segments that do not cancel
    std::size_t ranges = 0;  // diced
    std::uint32_t cutsMost = 0;
    std::int64_t areaMissing = 0;        // twice the patch's area less that of the ranges, in units of 2^-48
    bool sound = true;                   // no range turned over, grids as large as their edges need and no larger than they may be
    std::array<std::size_t, 8> rates{};  // of diced ranges
};

class Experiment {
public:
    explicit Experiment(const Trial& trial)
        : trial_(trial), patch_{nullptr, trial.kind, trial.degenerateSides, nullptr, nullptr}, random_(trial.seed), walks_(trial) {}

    Outcome run() {
        stack_.push_back(whole());
        walkPatch(-1);
        while (!stack_.empty()) {
            const quad_range range = stack_.back();
            stack_.pop_back();
            step(range);
        }
        outcome_.open = walks_.open();
        outcome_.areaMissing += (trial_.kind == KIND_PN ? 1 : 2) * (std::int64_t{1} << 48);
        return outcome_;
    }

private:
    [[nodiscard]] quad_range whole() {
        quad_range range{0, 0, 0, {0, UNIT, trial_.kind == KIND_PN ? 0U : UNIT, 0}, {0, 0, UNIT, UNIT}};
        for (int k = 0; k < 4; ++k)
            range.rates = kernels::quad_with_byte(range.rates, k, adversary(trial_, patch_, kernels::quad_own_edge(&range, k)));
        return range;
    }

    // What its edges are when nothing but them is asked.
    void walkPatch(int times) {
        const quad_range range = whole();
        for (int k = 0; k < 4; ++k) walkMeasured(kernels::quad_own_edge(&range, k), times);
    }
    void walkMeasured(const quad_edge& edge, int times) {
        const std::uint32_t rate = adversary(trial_, patch_, edge);
        const quad_point middle{(edge.from.u + edge.to.u) >> 1, (edge.from.v + edge.to.v) >> 1};
        if (rate == RATE_NONUNIFORM) {
            walkMeasured({edge.from, middle, edge.cuts + 1}, times);
            walkMeasured({middle, edge.to, edge.cuts + 1}, times);
        } else if (rate != RATE_ZERO) {
            walks_.uniform(edge.from, edge.to, 1U << (rate - RATE_ONE), times);
        }
    }

    [[nodiscard]] std::uint32_t chance(std::uint32_t end) { return static_cast<std::uint32_t>(random_.unit() * end); }

    [[nodiscard]] bool tooDeep(const quad_range& range) const {
        const std::uint32_t cuts = (range.sizes & 0xffU) + ((range.sizes >> 8U) & 0xffU);
        return trial_.wrong == Wrong::endsByDepth && cuts >= trial_.levelMost;
    }

    void step(quad_range range) {
        kernels::quad_interior interior{{0, 0}};
        for (std::uint32_t& wanted : interior.wanted) wanted = chance(100) < trial_.inner ? chance(7) : 0;
        if (tooDeep(range)) {
            for (int k = 0; k < 4; ++k)
                if (kernels::quad_byte(range.rates, k) == RATE_NONUNIFORM)
                    range.rates = kernels::quad_with_byte(range.rates, k, RATE_ONE + trial_.gridBits);
        }
        const int action = kernels::quad_decide(&range, interior, trial_.gridBits, trial_.levelMost);
        if (action == QUAD_DICE || tooDeep(range))
            dice(kernels::quad_diced(&range, interior, trial_.gridBits));
        else
            split(range, action - QUAD_SPLIT);
    }

    void split(const quad_range& range, int direction) {
        std::array<quad_edge, 5> edges{};
        kernels::quad_cut_edges(&range, direction, edges.data());
        std::array<std::uint32_t, 5> rates{};
        for (int k = 0; k < 5; ++k) {
            const bool measured = kernels::quad_cut_measures(&range, direction, k) || trial_.wrong == Wrong::remeasured;
            const auto at = static_cast<std::size_t>(k);
            rates[at] = measured ? adversary(trial_, patch_, edges[at]) : kernels::quad_cut_share(&range, direction, k);
        }
        if (trial_.wrong == Wrong::oneAtMiddle) {
            for (int k = 0; k < 4; ++k)
                if (kernels::quad_byte(range.rates, direction + (k < 2 ? 0 : 2)) == RATE_ONE) rates[static_cast<std::size_t>(k)] = RATE_ONE;
            for (const quad_range& child : cutAtMiddles(range, direction, rates)) stack_.push_back(child);
            return;
        }
        quad_cut cut{0, rates[4]};
        for (int k = 0; k < 4; ++k) cut.halves = kernels::quad_with_byte(cut.halves, k, rates[static_cast<std::size_t>(k)]);
        for (int which = 0; which < 2; ++which) stack_.push_back(kernels::quad_child(&range, direction, cut, which));
    }

    void dice(const quad_range& range) {
        ++outcome_.ranges;
        const std::array<std::uint32_t, 2> cuts{range.sizes & 0xffU, (range.sizes >> 8U) & 0xffU};
        const std::array<std::uint32_t, 2> grid{(range.sizes >> 16U) & 0xffU, range.sizes >> 24U};
        outcome_.cutsMost = std::max(outcome_.cutsMost, cuts[0] + cuts[1]);
        outcome_.sound = outcome_.sound && cuts[0] <= trial_.levelMost && cuts[1] <= trial_.levelMost;
        outcome_.sound = outcome_.sound && grid[0] >= grid[1] && grid[0] <= trial_.gridBits;
        std::int64_t area = 0;
        for (int k = 0; k < 4; ++k) {
            const quad_point a = kernels::quad_corner(&range, k);
            const quad_point b = kernels::quad_corner(&range, k + 1);
            area += std::int64_t{a.u} * b.v - std::int64_t{a.v} * b.u;
            const std::uint32_t rate = kernels::quad_byte(range.rates, k);
            ++outcome_.rates.at(rate);
            if (rate == RATE_ZERO) {
                outcome_.sound = outcome_.sound && equal(settled(trial_, a), settled(trial_, b));
                continue;
            }
            outcome_.sound = outcome_.sound && rate - RATE_ONE <= grid[static_cast<std::size_t>(k & 1)];
            walks_.uniform(a, b, 1U << (rate - RATE_ONE), 1);
        }
        outcome_.sound = outcome_.sound && area >= 0;
        outcome_.areaMissing -= area;
    }

    const Trial& trial_;
    kernels::patch_ref patch_;
    reference::Random random_;
    Walks walks_;
    std::vector<quad_range> stack_;
    Outcome outcome_;
};

// Patches whose borders differ: a square, one side of it a point, two of them, a triangle, one with a side that is a point.
Trial randomTrial(std::uint64_t seed) {
    reference::Random random(seed);
    const auto below = [&random](std::uint32_t end) { return static_cast<std::uint32_t>(random.unit() * end); };
    Trial trial;
    trial.seed = mixed(seed + 1);
    trial.kind = below(2) == 0 ? KIND_PN : KIND_BEZIER;
    for (std::uint32_t points = below(3); points > 0; --points) trial.degenerateSides |= SIDE_DEGENERATE << below(4);
    if (trial.kind == KIND_PN) trial.degenerateSides &= ~(SIDE_DEGENERATE << 2U);
    trial.gridBits = below(6);
    trial.levelMost = 1 + below(5);
    trial.nonUniform = 20 * below(6);
    trial.one = 25 * below(5);
    trial.inner = 25 * below(4);
    return trial;
}

std::string textOf(const Trial& trial) {
    return "seed " + std::to_string(trial.seed) + ", kind " + std::to_string(trial.kind) + ", sides that are points " +
           std::to_string(trial.degenerateSides) + ", grid bits " + std::to_string(trial.gridBits) + ", level " +
           std::to_string(trial.levelMost) + ", non-uniform " + std::to_string(trial.nonUniform) + " %, one " + std::to_string(trial.one) +
           " %, inner " + std::to_string(trial.inner) + " %";
}

TEST(QuadRule, BordersMeetWhateverTheRatesOfEdgesAre) {
    std::size_t ranges = 0;
    std::size_t deepest = 0;
    std::array<std::size_t, 8> rates{};
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        const Trial trial = randomTrial(seed);
        const Outcome outcome = Experiment(trial).run();
        SCOPED_TRACE(textOf(trial));
        ASSERT_EQ(outcome.open, 0U);
        ASSERT_EQ(outcome.areaMissing, 0);
        ASSERT_LE(outcome.cutsMost, 2 * trial.levelMost);
        ASSERT_TRUE(outcome.sound);
        ranges += outcome.ranges;
        deepest += outcome.cutsMost == 2 * trial.levelMost ? 1U : 0U;
        for (std::size_t k = 0; k < rates.size(); ++k) rates[k] += outcome.rates[k];
    }
    EXPECT_GT(ranges, 200'000U);
    EXPECT_GT(deepest, 500U) << "the trials must reach the greatest depth";
    for (std::size_t rate = RATE_ZERO; rate <= RATE_ONE + 5; ++rate) EXPECT_GT(rates[rate], 1000U) << "rate " << rate;
    RecordProperty("ranges", std::to_string(ranges));
}

// At the depth that pictures are made with, where middles of inner edges are rounded.
TEST(QuadRule, BordersMeetAtTheGreatestLevel) {
    std::uint32_t deepest = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        Trial trial = randomTrial(seed);
        trial.levelMost = QUAD_LEVEL_MOST;
        trial.nonUniform = 40;
        trial.inner = 10;
        const Outcome outcome = Experiment(trial).run();
        SCOPED_TRACE(textOf(trial));
        ASSERT_EQ(outcome.open, 0U);
        ASSERT_EQ(outcome.areaMissing, 0);
        ASSERT_LE(outcome.cutsMost, 2U * QUAD_LEVEL_MOST);
        ASSERT_TRUE(outcome.sound);
        deepest = std::max(deepest, outcome.cutsMost);
    }
    EXPECT_GT(deepest, 18U);
}

// What the experiment would say of rules that are wrong: most of their patches are open.
TEST(QuadRule, ExperimentSeesRulesThatLeaveCracks) {
    for (const Wrong wrong : {Wrong::remeasured, Wrong::oneAtMiddle, Wrong::endsByDepth}) {
        int open = 0;
        int trials = 0;
        for (std::uint64_t seed = 0; trials < 200; ++seed) {
            Trial trial = randomTrial(seed);
            // Where nothing is left to be done wrong, nothing is wrong.
            if (trial.levelMost < 3 || trial.gridBits < 1 || trial.nonUniform < 20 || trial.nonUniform > 80 || trial.one < 25) continue;
            ++trials;
            trial.inner = std::max(trial.inner, 25U);
            trial.wrong = wrong;
            open += Experiment(trial).run().open > 0 ? 1 : 0;
        }
        EXPECT_GT(open, 100) << "wrong rule " << static_cast<int>(wrong);
        RecordProperty("open" + std::to_string(static_cast<int>(wrong)), open);
    }
}

}  // namespace
}  // namespace tessera::splitting
