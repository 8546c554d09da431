// feed_patches alone: which patches it feeds and in what order, against the same in words of C++.
#include "split_rig.h"

#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace tessera::splitting {
namespace {

using reference::Random;

struct Fed {
    std::vector<std::uint32_t> patches;
    split_state state{};
};

constexpr std::uint32_t noPatch = 0xdeadbeefU;

// Runs the kernel over boxes, from counts that a frame's chunks before have left.
Fed feed(SplitRig& rig, const frame_params& frame, const std::vector<patch_box>& boxes, const split_state& before) {
    const PatchSet& patches = rig.patches();
    Timeline& timeline = rig.session().timeline;
    if (!boxes.empty()) timeline.write(patches.boxes.cl(), boxes.data(), boxes.size() * sizeof(patch_box));
    const std::vector<std::uint32_t> none(boxes.size(), noPatch);
    if (!none.empty()) timeline.write(patches.feed.cl(), none.data(), none.size() * 4);
    SplitQueues queues(rig.session());
    queues.reserve({64, 64, 64}, 64);
    queues.restart();
    queues.writeState(before);
    queues.enqueueFeed(frame, patches);
    Fed fed;
    fed.state = queues.readState();
    fed.patches.resize(boxes.size());
    if (!boxes.empty()) timeline.read(patches.feed.cl(), fed.patches.data(), fed.patches.size() * 4);
    return fed;
}

bool meets(const frame_params& frame, const patch_box& box) {
    const auto first = [](std::uint32_t both) { return static_cast<int>(both & 0xffffU); };
    const auto last = [](std::uint32_t both) { return static_cast<int>(both >> 16U); };
    return std::max(first(box.columns), frame.box_x0) <= std::min(last(box.columns), frame.box_x1) &&
           std::max(first(box.rows), frame.box_y0) <= std::min(last(box.rows), frame.box_y1) && first(box.columns) <= last(box.columns) &&
           first(box.rows) <= last(box.rows);
}

// Quarters of octaves beyond the near plane's own, by the logarithm's whole part and the fraction's quarter.
int binOf(const frame_params& frame, float nearest) {
    const auto quarters = [](double depth) {
        int exponent = 0;
        const double fraction = std::frexp(depth, &exponent);  // 0.5 to 1
        return 4 * exponent + static_cast<int>(std::floor(8.0 * fraction - 4.0));
    };
    const auto near = static_cast<double>(frame.near_plane);
    // Less than the near plane, or none.
    const double depth = static_cast<double>(nearest) > near ? static_cast<double>(nearest) : near;
    if (std::isinf(depth)) return 63;
    return std::clamp(quarters(depth) - quarters(near), 0, 63);
}

std::vector<std::uint32_t> expectedFeed(const frame_params& frame, const std::vector<patch_box>& boxes) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t k = 0; k < boxes.size(); ++k)
        if (frame.feed_boxes == 0 || meets(frame, boxes[k])) order.push_back(k);
    if (frame.occlusion != 0 && frame.feed_boxes != 0) {
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return binOf(frame, boxes[a].nearest) < binOf(frame, boxes[b].nearest); });
    }
    return order;
}

patch_box randomBox(Random& random, const frame_params& frame) {
    const auto side = [&](int end) {
        const auto a = static_cast<std::uint32_t>(random.between(0.0, 2.5 * end + 2.0));
        const auto b = static_cast<std::uint32_t>(random.between(0.0, 2.5 * end + 2.0));
        if (random.unit() < 0.1) return (std::min(a, b) << 16U) | (std::max(a, b) + 1U);  // none
        return (std::max(a, b) << 16U) | std::min(a, b);
    };
    constexpr float infinity = std::numeric_limits<float>::infinity();
    patch_box box{side(frame.box_x1), side(frame.box_y1), static_cast<float>(std::exp2(random.between(-9.0, 14.0)))};
    const double what = random.unit();
    if (what < 0.02) box.nearest = infinity;
    if (what > 0.98) box.nearest = -box.nearest;
    if (what > 0.4 && what < 0.42) box.nearest = std::numeric_limits<float>::quiet_NaN();
    if (what > 0.5 && what < 0.55) box.nearest = frame.near_plane;
    return box;
}

// What chunks before this one left: its own counts begin anew, the frame's go on.
split_state stateBefore() {
    split_state state{};
    state.stack_count = 7;
    state.next_input = 5;
    state.feed_count = 3;
    state.ready_count = 4;
    state.hidden = 2;
    state.processed_low = 1000;
    state.area_done = 12.0F;
    state.run_iterations = 9;
    state.iterations = 30;
    state.skipped_low = 0xfffffff0U;
    return state;
}

void expectFeed(const Fed& found, const frame_params& frame, const std::vector<patch_box>& boxes) {
    const std::vector<std::uint32_t> expected = expectedFeed(frame, boxes);
    ASSERT_EQ(found.state.feed_count, expected.size());
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), found.patches.begin()));
    EXPECT_TRUE(std::all_of(found.patches.begin() + static_cast<std::ptrdiff_t>(expected.size()), found.patches.end(),
                            [](std::uint32_t patch) { return patch == noPatch; }));
    const split_state before = stateBefore();
    const std::uint64_t skipped = boxes.size() - expected.size();
    EXPECT_EQ(wide(found.state.skipped_low, found.state.skipped_high), wide(before.skipped_low, before.skipped_high) + skipped);
    EXPECT_EQ(found.state.area_done, static_cast<float>(skipped));
    EXPECT_EQ(found.state.stack_count, 0U);
    EXPECT_EQ(found.state.next_input, 0U);
    EXPECT_EQ(found.state.run_iterations, 0U);
    EXPECT_EQ(found.state.iterations, before.iterations);
    EXPECT_EQ(found.state.processed_low, before.processed_low);
    EXPECT_EQ(found.state.ready_count, 0U);
    EXPECT_EQ(found.state.hidden, 0U);
}

RenderOptions optionsOf() {
    RenderOptions options;
    options.mode = DiceMode::classical;
    options.width = 200;
    options.height = 120;
    return options;
}

class Feed : public testing::TestWithParam<Shape> {
protected:
    Feed() : rig_(kernelSources(), GetParam()) {}

    void place(std::size_t patches) {
        rig_.place(reference::sceneOf({reference::bumpyBezierMesh(51, patches)}), reference::cameraAt({0, 0, 4}, {0, 0, 0}, 40),
                   optionsOf());
    }
    [[nodiscard]] std::vector<patch_box> randomBoxes(std::uint64_t seed) const {
        Random random(seed);
        std::vector<patch_box> boxes(rig_.patches().patches);
        for (patch_box& box : boxes) box = randomBox(random, rig_.frame());
        return boxes;
    }

    SplitRig rig_;
};

// Numbers around those of work-items and their runs.
constexpr std::array<std::size_t, 8> counts{1, 2, 15, 64, 65, 257, 1000, 5003};

TEST_P(Feed, AllPatchesComeOnceInTheirOrder) {
    for (const std::size_t count : counts) {
        SCOPED_TRACE(count);
        place(count);
        frame_params frame = rig_.frame();
        frame.feed_boxes = 0;
        frame.occlusion = 0;
        const std::vector<patch_box> boxes = randomBoxes(count);
        const Fed fed = feed(rig_, frame, boxes, stateBefore());
        expectFeed(fed, frame, boxes);
        std::vector<std::uint32_t> all(count);
        std::iota(all.begin(), all.end(), 0U);
        EXPECT_EQ(fed.patches, all);
    }
}

TEST_P(Feed, PatchesWhoseBoxesMissTheFilmAreLeftOutAndCounted) {
    for (const std::size_t count : counts) {
        SCOPED_TRACE(count);
        place(count);
        frame_params frame = rig_.frame();
        frame.feed_boxes = 1;
        frame.occlusion = 0;
        for (const auto& [x0, x1, y0, y1] : {std::array{0, 24, 0, 14}, std::array{3, 3, 7, 9}, std::array{24, 24, 14, 14}}) {
            frame.box_x0 = x0;
            frame.box_x1 = x1;
            frame.box_y0 = y0;
            frame.box_y1 = y1;
            const std::vector<patch_box> boxes = randomBoxes(100 + count);
            expectFeed(feed(rig_, frame, boxes, stateBefore()), frame, boxes);
        }
    }
}

TEST_P(Feed, FromFrontToBackInBinsOfDepthEachInTheirOrder) {
    for (const std::size_t count : counts) {
        SCOPED_TRACE(count);
        place(count);
        for (const std::uint32_t boxed : {0U, 1U}) {
            for (const float near : {0.01F, 0.75F, 3.0F}) {
                frame_params frame = rig_.frame();
                frame.feed_boxes = boxed;
                frame.occlusion = 1;
                frame.near_plane = near;
                const std::vector<patch_box> boxes = randomBoxes(200 + count);
                const Fed fed = feed(rig_, frame, boxes, stateBefore());
                expectFeed(fed, frame, boxes);
                if (boxed == 0) continue;  // in the order of the file: there are no boxes
                // What a bin is for: a patch comes before all that are two quarters of an octave farther.
                float farthest = 0.0F;
                for (std::uint32_t k = 0; k < fed.state.feed_count; ++k) {
                    const float depth = std::max(boxes[fed.patches[k]].nearest, near);
                    if (std::isfinite(depth) && depth < 1000.0F * near) {
                        ASSERT_GT(1.5F * depth, farthest);
                        farthest = std::max(farthest, depth);
                    }
                }
            }
        }
    }
}

TEST_P(Feed, OfNoPatchesIsNothing) {
    place(3);
    frame_params frame = rig_.frame();
    frame.patches = 0;
    frame.feed_boxes = 1;
    frame.occlusion = 1;
    EXPECT_EQ(feed(rig_, frame, {}, stateBefore()).state.feed_count, 0U);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Feed, testing::Values(Shape::native, Shape::gpu),
                         [](const auto& tested) { return tested.param == Shape::gpu ? "gpu" : "native"; });

}  // namespace
}  // namespace tessera::splitting
