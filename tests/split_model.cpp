// What bound and split must do, on the host.
#include "split_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

namespace tessera::splitting {

Side sideOf(std::uint32_t side) {
    const int level = static_cast<int>(side >> SIDE_LEVEL_SHIFT);
    const float size = std::ldexp(1.0F, -level);
    return {level, static_cast<float>(side & SIDE_INDEX_MASK) * size, size};
}

int levelOf(const range_t& range) {
    return static_cast<int>(range.u_side >> SIDE_LEVEL_SHIFT) + static_cast<int>(range.v_side >> SIDE_LEVEL_SHIFT);
}

double areaOf(const range_t& range) { return std::ldexp(1.0, -levelOf(range)); }

double areaOf(const std::vector<range_t>& ranges) {
    double sum = 0;
    for (const range_t& range : ranges) sum += areaOf(range);
    return sum;
}

std::array<range_t, 2> halves(const range_t& range, int action) {
    std::array<range_t, 2> result{range, range};
    for (std::uint32_t k = 0; k < 2; ++k) {
        std::uint32_t& side = action == ACTION_SPLIT_U ? result[k].u_side : result[k].v_side;
        const std::uint32_t level = (side >> SIDE_LEVEL_SHIFT) + 1;
        const std::uint32_t index = 2 * (side & SIDE_INDEX_MASK) + k;
        side = (level << SIDE_LEVEL_SHIFT) | index;
    }
    return result;
}

std::vector<range_t> sorted(std::vector<range_t> ranges) {
    std::sort(ranges.begin(), ranges.end(), [](const range_t& a, const range_t& b) {
        return std::tie(a.patch_index, a.u_side, a.v_side) < std::tie(b.patch_index, b.u_side, b.v_side);
    });
    return ranges;
}

bool same(const std::vector<range_t>& a, const std::vector<range_t>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const range_t& x, const range_t& y) {
        return x.patch_index == y.patch_index && x.u_side == y.u_side && x.v_side == y.v_side;
    });
}

Outcome depthFirst(std::uint32_t patches, const Decide& decide, std::uint64_t most) {
    Outcome outcome;
    std::vector<range_t> waiting;
    for (std::uint32_t patch = 0; patch < patches; ++patch) {
        waiting.push_back({patch, 0, 0});
        while (!waiting.empty()) {
            const range_t range = waiting.back();
            waiting.pop_back();
            if (++outcome.processed > most) throw std::runtime_error("the tree of splits is larger than the test reckoned with");
            const int action = decide(range);
            if (action == ACTION_DICE) {
                outcome.diced.push_back(range);
            } else if (action == ACTION_CULL) {
                ++outcome.culled;
                outcome.culledArea += areaOf(range);
            } else {
                for (const range_t& half : halves(range, action)) waiting.push_back(half);
            }
        }
    }
    return outcome;
}

std::vector<range_t> BoundedModel::step() {
    const std::size_t taken = std::min<std::size_t>(p_, stack_.size());
    const std::uint32_t fresh = std::min(p_ - static_cast<std::uint32_t>(taken), patches_ - nextInput_);
    std::vector<range_t> batch;
    for (std::uint32_t k = 0; k < fresh; ++k) batch.push_back({nextInput_++, 0, 0});
    batch.insert(batch.end(), stack_.end() - static_cast<std::ptrdiff_t>(taken), stack_.end());
    stack_.resize(stack_.size() - taken);
    std::vector<range_t> diced;
    for (const range_t& range : batch) {
        const int action = decide_(range);
        if (action == ACTION_DICE) diced.push_back(range);
        if (action == ACTION_DICE || action == ACTION_CULL) continue;
        for (const range_t& half : halves(range, action)) stack_.push_back(half);
    }
    return diced;
}

StackVerdict judge(const std::vector<range_t>& stack, std::uint64_t p, int depth) {
    StackVerdict verdict;
    std::array<std::uint64_t, 64> ofLevel{};  // two sides of 5 bits each
    int last = 0;
    for (const range_t& range : stack) {
        const int level = levelOf(range);
        verdict.ordered = verdict.ordered && level >= last;
        verdict.shallow = verdict.shallow && level <= depth;
        last = level;
        ++ofLevel[static_cast<std::size_t>(level)];
    }
    std::uint64_t sum = 0;
    for (std::size_t level = 0; level < ofLevel.size(); ++level) {
        sum += ofLevel[level];
        verdict.summed = verdict.summed && sum <= (level + 1) * p;
    }
    verdict.bounded = stack.size() <= (static_cast<std::uint64_t>(depth) + 1) * p;
    return verdict;
}

}  // namespace tessera::splitting
