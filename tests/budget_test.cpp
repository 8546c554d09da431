// A frame keeps its memory budget, and shows the same whatever the budget, the method and the view.
#include "bounded_scenes.h"
#include "picture_scenes.h"

#include "tessera/error.h"
#include "tessera/generate.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace tessera::test {

static void PrintTo(const ClosedModel& model, std::ostream* stream) { *stream << model.name; }

namespace {

// Where a surface folds over or touches another, two of its points may be seen at exactly the same depth.
constexpr std::size_t mostTies = 4;

std::optional<MemoryPlan> planWithin(const Renderer& renderer, RenderOptions options, std::uint64_t bytes) {
    options.memoryBytes = bytes;
    try {
        return renderer.plan(options);
    } catch (const Error&) {
        return std::nullopt;
    }
}

// The fewest bytes that the plan accepts, at most 1 GiB.
std::uint64_t leastBytes(const Renderer& renderer, const RenderOptions& options) {
    std::uint64_t tooFew = 0;
    std::uint64_t enough = 1024 * mebibyte;
    while (enough - tooFew > 1) {
        const std::uint64_t middle = tooFew + (enough - tooFew) / 2;
        (planWithin(renderer, options, middle) ? enough : tooFew) = middle;
    }
    return enough;
}

void expectWithinBudget(const Statistics& s, const MemoryPlan& plan) {
    EXPECT_EQ(s.deviceBytesBudget, plan.budget);
    EXPECT_LE(s.deviceBytesPeak, s.deviceBytesBudget);
    EXPECT_LE(plan.bytes.total(), plan.budget);
    std::uint64_t sum = 0;
    for (const auto& [purpose, bytes] : s.deviceBytes) sum += bytes;
    EXPECT_EQ(s.deviceBytes.size(), 4U);
    EXPECT_EQ(sum, s.deviceBytesPeak);
    EXPECT_EQ(s.buckets, static_cast<std::uint64_t>(plan.buckets()));
    EXPECT_EQ(s.chunks, plan.chunks);
    if (s.method == "breadth") return;  // its queues are in no plan
    EXPECT_LE(s.deviceBytesPeak, plan.bytes.total());
    EXPECT_EQ(s.deviceBytes.at("scene"), plan.bytes.scene);
    EXPECT_EQ(s.deviceBytes.at("queues"), plan.bytes.queues);
    EXPECT_EQ(s.deviceBytes.at("film"), plan.bytes.film);
    EXPECT_EQ(s.deviceBytes.at("picture"), plan.bytes.picture);
}

// What frames of a matrix came to.
struct Tally {
    int frames = 0;
    int refused = 0;  // of breadth
    int inBuckets = 0;
    int inChunks = 0;
    int covered = 0;

    void add(const Statistics& s) {
        ++frames;
        inBuckets += s.buckets > 1 ? 1 : 0;
        inChunks += s.chunks > 1 ? 1 : 0;
        covered += s.pixelsCovered > 0 ? 1 : 0;
    }
};

// A frame within the options' budget, against the one without; breadth may say what it needs instead, its queues not being planned.
void expectSameWithin(Renderer& renderer, const Camera& camera, const RenderOptions& options, const Kept& free, Tally& tally) {
    SCOPED_TRACE(textOf(options));
    try {
        const MemoryPlan plan = renderer.plan(options);
        const Kept kept = draw(renderer, camera, options);
        expectWithinBudget(kept.statistics(), plan);
        expectSameButTies(free, kept, mostTies);
        tally.add(kept.statistics());
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_EQ(options.method, SplitMethod::breadth) << text;
        EXPECT_NE(text.find("would need"), std::string::npos) << text;
        EXPECT_NE(text.find("bytes)"), std::string::npos) << text;
        ++tally.refused;
    }
}

class Budget : public testing::TestWithParam<ClosedModel> {
protected:
    Budget() : renderer_(testSettings()) { renderer_.setScene(GetParam().scene); }

    [[nodiscard]] std::vector<Camera> views() const {
        const Scene& scene = GetParam().scene;
        return {scene.cameras.empty() ? viewFrom(scene, false, 900) : scene.cameras.front(), viewFrom(scene, true, 902),
                viewFrom(scene, false, 901)};
    }

    Renderer renderer_;
};

// Budgets come in an order in which they rise and fall, so that buffers of one frame are in the way of another's.
TEST_P(Budget, HoldsWithTheSamePictureByEveryMethodFromEveryView) {
    Tally tally;
    std::size_t view = 0;
    for (const Camera& camera : views()) {
        ++view;
        for (const DiceMode mode : {DiceMode::watertight, DiceMode::classical}) {
            if (!canDraw(mode, GetParam().scene)) continue;
            SCOPED_TRACE("view " + std::to_string(view));
            RenderOptions options = pictureOptions(44, 29, view % 2 == 0 ? 4 : 1);
            options.mode = mode;
            options.memoryBytes = 1024 * mebibyte;
            const Kept free = draw(renderer_, camera, options);
            EXPECT_EQ(free.statistics().buckets, 1U);
            EXPECT_EQ(free.statistics().chunks, 1U);
            for (const SplitMethod method : everyMethod) {
                options.method = method;
                const std::uint64_t least = leastBytes(renderer_, options);
                for (const std::uint64_t bytes : {2 * least, least, 64 * mebibyte, least + least / 4}) {
                    options.memoryBytes = bytes;
                    expectSameWithin(renderer_, camera, options, free, tally);
                }
            }
        }
    }
    std::printf("%d frames, %d of breadth refused, %d in buckets, %d in chunks, %d show something\n", tally.frames, tally.refused,
                tally.inBuckets, tally.inChunks, tally.covered);
    EXPECT_GT(tally.inBuckets, tally.frames / 4);
    EXPECT_GT(tally.covered, tally.frames / 2);
}

TEST_P(Budget, OneByteLessThanTheLeastIsRefusedWithWhatWouldDo) {
    for (const SplitMethod method : everyMethod) {
        RenderOptions options = pictureOptions(640, 480, 3);
        options.method = method;
        const std::uint64_t least = leastBytes(renderer_, options);
        SCOPED_TRACE(textOf(options) + ", least " + std::to_string(least));
        const std::uint64_t leastMebibytes = (least + mebibyte - 1) / mebibyte;
        for (const std::uint64_t tooFew : {least - 1, (leastMebibytes - 1) * mebibyte, std::uint64_t{1}}) {
            if (tooFew == 0) continue;
            options.memoryBytes = tooFew;
            try {
                static_cast<void>(draw(renderer_, viewFrom(GetParam().scene, false, 1), options));
                ADD_FAILURE() << tooFew << " bytes were enough";
            } catch (const Error& error) {
                EXPECT_EQ(memoryNamed(error.what()), leastMebibytes) << error.what();
            }
        }
        EXPECT_TRUE(planWithin(renderer_, options, leastMebibytes * mebibyte));
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Budget, testing::ValuesIn(boundedScenes()), [](const auto& tested) { return tested.param.name; });

// The budgets that users give, at a size at which the smaller ones make buckets.
TEST(BudgetOfUsers, From32MebibytesToAGibibyteThePictureStaysTheSame) {
    Renderer renderer(testSettings());
    const Scene scene = mixedScene();
    renderer.setScene(scene);
    Tally tally;
    for (const DiceMode mode : {DiceMode::watertight, DiceMode::classical}) {
        RenderOptions options = pictureOptions(400, 225, 4);
        options.mode = mode;
        options.memoryBytes = 2048 * mebibyte;
        const Kept free = draw(renderer, scene.cameras.front(), options);
        for (const SplitMethod method : everyMethod) {
            for (const std::uint64_t mebibytes : {32U, 64U, 128U, 1024U}) {
                options.method = method;
                options.memoryBytes = mebibytes * mebibyte;
                expectSameWithin(renderer, scene.cameras.front(), options, free, tally);
            }
        }
    }
    EXPECT_EQ(tally.refused, 0);
    EXPECT_GT(tally.inBuckets, 4);
}

// Many objects of few meshes, streamed where the budget asks for it.
TEST(BudgetOfUsers, ACityIsTheSameInChunksAndBuckets) {
    Renderer renderer(testSettings());
    const Scene scene = generateScene("city", 20000);
    renderer.setScene(scene);
    Tally tally;
    for (const bool inside : {false, true}) {
        const Camera camera = inside ? *scene.findCamera("eyesplit") : viewFrom(scene, false, 5);
        RenderOptions options = pictureOptions(96, 54, inside ? 4 : 1);
        options.memoryBytes = 1024 * mebibyte;
        const Kept free = draw(renderer, camera, options);
        for (const SplitMethod method : everyMethod) {
            options.method = method;
            for (const std::uint64_t mebibytes : {8U, 24U}) {
                options.memoryBytes = mebibytes * mebibyte;
                try {
                    static_cast<void>(renderer.plan(options));
                } catch (const Error& error) {
                    EXPECT_EQ(method, SplitMethod::breadth) << error.what();  // which cannot stream
                    EXPECT_TRUE(memoryNamed(error.what())) << error.what();
                    continue;
                }
                expectSameWithin(renderer, camera, options, free, tally);
            }
        }
    }
    EXPECT_GT(tally.inChunks, 4);
}

// Where breadth finds no room it says so, and the renderer draws on.
TEST(BudgetOfUsers, AfterBreadthWasRefusedTheNextFrameIsWhole) {
    Renderer renderer(testSettings());
    const Scene scene = generateScene("random", 3000);
    renderer.setScene(scene);
    const Camera camera = viewFrom(scene, true, 8);
    RenderOptions options = pictureOptions(120, 80, 1);
    const Kept free = draw(renderer, camera, options);
    options.method = SplitMethod::breadth;
    options.memoryBytes = leastBytes(renderer, options);
    Tally tally;
    expectSameWithin(renderer, camera, options, free, tally);
    EXPECT_EQ(tally.refused, 1);
    options.method = SplitMethod::bounded;
    expectSameWithin(renderer, camera, options, free, tally);
    options.memoryBytes = 512 * mebibyte;
    options.method = SplitMethod::breadth;
    expectSameWithin(renderer, camera, options, free, tally);
    EXPECT_EQ(tally.frames, 2);
}

}  // namespace
}  // namespace tessera::test
