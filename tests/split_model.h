// What bound and split must do, in plain C++ on the host: ranges, the tree of splits, and the bounded iteration. Tests hold the device
// against it.
#pragma once

#include "split/range_shared.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace tessera::splitting {

// ACTION_* of a range; the same range gets the same answer every time.
using Decide = std::function<int(const range_t&)>;

struct Side {
    int level = 0;
    float start = 0;  // 0 to 1
    float size = 0;   // 2^-level
};

[[nodiscard]] Side sideOf(std::uint32_t side);

// Splits from the patch to the range.
[[nodiscard]] int levelOf(const range_t& range);
// Share of the patch's parameter square: 2^-level.
[[nodiscard]] double areaOf(const range_t& range);
[[nodiscard]] double areaOf(const std::vector<range_t>& ranges);
// `action` is ACTION_SPLIT_U or ACTION_SPLIT_V; the lower half first.
[[nodiscard]] std::array<range_t, 2> halves(const range_t& range, int action);

// By patch, then sides: to compare multisets.
[[nodiscard]] std::vector<range_t> sorted(std::vector<range_t> ranges);
[[nodiscard]] bool same(const std::vector<range_t>& a, const std::vector<range_t>& b);

// What becomes of patches in the end. The order of work changes nothing of it.
struct Outcome {
    std::vector<range_t> diced;
    std::uint64_t processed = 0;
    std::uint64_t culled = 0;
    double culledArea = 0;
};

// The tree of splits of `patches` whole patches, depth first. Throws std::runtime_error when it has more than `most` ranges.
[[nodiscard]] Outcome depthFirst(std::uint32_t patches, const Decide& decide, std::uint64_t most = 50'000'000);

// Algorithm 4.1 of Weber's thesis with the lazy feed of DESIGN.md: up to p ranges from the stack's end, fresh patches below them where
// those are fewer, and the children back on the stack in the order of their parents.
class BoundedModel {
public:
    BoundedModel(std::uint32_t patches, std::uint32_t p, Decide decide) : patches_(patches), p_(p), decide_(std::move(decide)) {}

    // One iteration; returns the diceable ranges that it found, in order.
    std::vector<range_t> step();
    [[nodiscard]] const std::vector<range_t>& stack() const { return stack_; }
    [[nodiscard]] bool over() const { return stack_.empty() && nextInput_ == patches_; }

private:
    std::uint32_t patches_;
    std::uint32_t p_;
    Decide decide_;
    std::uint32_t nextInput_ = 0;
    std::vector<range_t> stack_;
};

// What must hold of a stack between iterations, with p ranges at a time and at most K splits.
struct StackVerdict {
    bool ordered = true;  // levels never fall towards the end (thesis, 4.3)
    bool bounded = true;  // at most (K + 1) p ranges
    bool summed = true;   // at most (i + 1) p of level i or less, for every i: what the bound is proved from
    bool shallow = true;  // nothing was split more than K times
};

[[nodiscard]] StackVerdict judge(const std::vector<range_t>& stack, std::uint64_t p, int depth);

}  // namespace tessera::splitting
