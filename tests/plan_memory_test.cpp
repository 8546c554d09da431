// The memory plan over made-up scenes: it fits every budget that it accepts, and says the least one where it accepts none.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "render/plan_memory.h"
#include "tessera/error.h"

namespace tessera {
namespace {

constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;

DeviceInfo deviceOf(std::uint64_t globalBytes, std::uint64_t maxAllocationBytes) {
    DeviceInfo device;
    device.name = "a device";
    device.globalBytes = globalBytes;
    device.maxAllocationBytes = maxAllocationBytes;
    return device;
}

DeviceInfo largeDevice() { return deviceOf(std::uint64_t{64} << 30, std::uint64_t{16} << 30); }

// Patches of one size, as the device takes them: two sets of inputs where they are streamed.
PlannedScene sceneOf(std::uint32_t patches, std::uint64_t inputBytes = 230, std::uint64_t placedBytes = 210) {
    const auto chunks = [=](std::uint32_t each) {
        const std::uint64_t n = each;
        const std::uint64_t sets = each < patches ? 2 : 1;
        return PlannedBytes{n * (sets * inputBytes + placedBytes) + 64, n * std::max(inputBytes, placedBytes) + 16};
    };
    return {patches, 2, chunks};
}

struct Case {
    RenderOptions options;
    PlannedScene scene;
    std::string text;
};

template <typename T>
T pick(std::mt19937& random, std::initializer_list<T> values) {
    return values.begin()[random() % values.size()];
}

Case randomCase(std::mt19937& random) {
    Case made;
    RenderOptions& options = made.options;
    options.width = pick(random, {1, 31, 640, 1280, 3840, 16000});
    options.height = pick(random, {1, 17, 480, 720, 2160, 16000});
    options.pixelSamples = 1 + static_cast<int>(random() % 16);
    options.aovs = pick(random, {Aov::none, Aov::z, Aov::normal, Aov::z | Aov::normal | Aov::object | Aov::patch | Aov::uv});
    options.method = pick(random, {SplitMethod::cpu, SplitMethod::breadth, SplitMethod::bounded, SplitMethod::local});
    options.mode = pick(random, {DiceMode::watertight, DiceMode::classical});
    options.gridSize = pick(random, {1, 16, 32});
    options.occlusion = random() % 2 == 0;
    options.batch = pick(random, {0U, 0U, 0U, 1U, 777U, 40000U, 1U << 20});
    if (random() % 4 == 0) {
        options.bucketWidth = pick(random, {8, 50, 256, 5000});
        options.bucketHeight = pick(random, {8, 33, 128, 5000});
    }
    if (random() % 3 == 0) options.crop = {0.1F, 0.93F, 0.0F, 0.31F};
    const std::uint32_t patches = pick(random, {0U, 1U, 63U, 1000U, 12345U, 1000000U, 10000000U});
    made.scene = sceneOf(patches, 100 + random() % 400, 100 + random() % 600);
    made.text = std::to_string(options.width) + "x" + std::to_string(options.height) + ", " + std::to_string(options.pixelSamples) +
                " samples, " + std::string(name(options.method)) + ", " + std::string(name(options.mode)) + ", batch " +
                std::to_string(options.batch) + ", bucket " + std::to_string(options.bucketWidth) + ", " + std::to_string(patches) +
                " patches";
    return made;
}

// The MiB that an error says would do; none where it says that none would.
std::optional<std::uint64_t> leastOf(const std::string& error) {
    std::smatch found;
    if (!std::regex_search(error, found, std::regex("--memory ([0-9]+) would do"))) return std::nullopt;
    return std::stoull(found[1]);
}

std::optional<MemoryPlan> planOf(const Case& made, std::uint64_t budget, const DeviceInfo& device = largeDevice()) {
    RenderOptions options = made.options;
    options.memoryBytes = budget;
    try {
        return planMemory(options, made.scene, device);
    } catch (const Error&) {
        return std::nullopt;
    }
}

// Everything that must hold of any plan.
void expectSound(const Case& made, const MemoryPlan& plan, const DeviceInfo& device) {
    const RenderOptions& options = made.options;
    EXPECT_LE(plan.bytes.total(), plan.budget);
    EXPECT_LE(plan.budget, device.globalBytes);
    const int tile = tilePixels(options.pixelSamples);
    EXPECT_TRUE(plan.bucketsX == 1 || plan.bucketWidth % tile == 0);
    EXPECT_TRUE(plan.bucketsY == 1 || plan.bucketHeight % tile == 0);
    const FilmLayout bucket = bucketLayout(options, plan, 0);
    EXPECT_LE(bucket.samples * 20 + static_cast<std::uint64_t>(bucket.tiles), plan.bytes.film);
    EXPECT_LE(bucket.samples * 8, device.maxAllocationBytes);
    EXPECT_LE(static_cast<std::uint64_t>(bucket.width) * static_cast<std::uint64_t>(bucket.height) * 16, plan.bytes.picture);
    EXPECT_GE(plan.bytes.scene, made.scene.chunks(plan.chunkPatches).all);
    EXPECT_LE(made.scene.chunks(plan.chunkPatches).largestBuffer, device.maxAllocationBytes);
    EXPECT_GE(std::uint64_t{plan.chunks} * plan.chunkPatches, made.scene.patches);
    EXPECT_TRUE(plan.chunks == 1 || std::uint64_t{plan.chunks - 1} * plan.chunkPatches < made.scene.patches);
    const std::uint64_t range = options.mode == DiceMode::watertight ? 44 : 12;
    EXPECT_GE(plan.bytes.queues, range * (plan.stackCapacity + plan.readyCapacity));
    EXPECT_LE(range * std::max<std::uint64_t>(plan.stackCapacity, plan.readyCapacity), device.maxAllocationBytes);
    EXPECT_TRUE(options.method != SplitMethod::breadth || plan.chunks == 1);
    EXPECT_TRUE(options.batch == 0 || plan.batch == options.batch);
}

TEST(MemoryPlan, FitsTheBudgetOrNamesTheLeastThatDoes) {
    std::mt19937 random(11);
    int refused = 0;
    for (int i = 0; i < 1500; ++i) {
        Case made = randomCase(random);
        made.options.memoryBytes = mebibyte << random() % 12;
        const DeviceInfo device = random() % 3 == 0 ? deviceOf(std::uint64_t{1} << 30, std::uint64_t{128} << 20) : largeDevice();
        SCOPED_TRACE(made.text + ", budget " + std::to_string(made.options.memoryBytes >> 20) + ", case " + std::to_string(i));
        try {
            const MemoryPlan plan = planMemory(made.options, made.scene, device);
            EXPECT_EQ(plan.budget, std::min(made.options.memoryBytes, device.globalBytes));
            expectSound(made, plan, device);
        } catch (const Error& error) {
            ++refused;
            const std::optional<std::uint64_t> least = leastOf(error.what());
            if (!least) continue;
            EXPECT_GT(*least << 20, made.options.memoryBytes);
            const std::optional<MemoryPlan> plan = planOf(made, *least << 20, device);
            ASSERT_TRUE(plan) << error.what();
            expectSound(made, *plan, device);
            EXPECT_FALSE(planOf(made, (*least - 1) << 20, device)) << error.what();
        }
    }
    EXPECT_GT(refused, 100);
    EXPECT_LT(refused, 1000);
}

TEST(MemoryPlan, AFrameThatTheDeviceHoldsInNoWayIsRefusedWithAReason) {
    const DeviceInfo small = deviceOf(64 * mebibyte, 16 * mebibyte);
    const DeviceInfo roomy = deviceOf(64 * mebibyte, 64 * mebibyte);
    const auto refusal = [](const RenderOptions& options, const PlannedScene& scene, const DeviceInfo& device) -> std::string {
        try {
            static_cast<void>(planMemory(options, scene, device));
        } catch (const Error& error) {
            EXPECT_FALSE(leastOf(error.what())) << error.what();
            return error.what();
        }
        return "";
    };
    RenderOptions options;
    options.batch = 1U << 20;
    EXPECT_NE(refusal(options, sceneOf(10), small).find("use a smaller --batch"), std::string::npos);
    options.batch = 0;
    options.bucketWidth = options.bucketHeight = 4000;
    options.width = options.height = 4000;
    EXPECT_NE(refusal(options, sceneOf(10), small).find("use a smaller --bucket"), std::string::npos);
    options.bucketWidth = options.bucketHeight = 0;
    options.method = SplitMethod::breadth;
    EXPECT_NE(refusal(options, sceneOf(1000000), small).find("use --method bounded"), std::string::npos);
    EXPECT_NE(refusal(options, sceneOf(150000, 250, 250), roomy).find("device memory, but a device holds"), std::string::npos);
    options.method = SplitMethod::bounded;
    EXPECT_EQ(refusal(options, sceneOf(1000000), small), "");
}

TEST(MemoryPlan, TakesTheDefaultBudgetWhereNoneIsGiven) {
    EXPECT_EQ(planMemory({}, sceneOf(32), deviceOf(std::uint64_t{8} << 30, std::uint64_t{2} << 30)).budget, 512 * mebibyte);
    EXPECT_EQ(planMemory({}, sceneOf(32), deviceOf(std::uint64_t{1} << 30, std::uint64_t{1} << 28)).budget, 256 * mebibyte);
}

TEST(MemoryPlan, WhatFitsWholeIsNotDivided) {
    RenderOptions options;
    options.memoryBytes = 512 * mebibyte;
    const MemoryPlan plan = planMemory(options, sceneOf(12000), largeDevice());
    EXPECT_EQ(plan.buckets(), 1);
    EXPECT_EQ(plan.bucketWidth, 1280);
    EXPECT_EQ(plan.bucketHeight, 720);
    EXPECT_FALSE(plan.streamed());
    EXPECT_EQ(plan.chunkPatches, 12000U);
    EXPECT_EQ(plan.batch, 40000U);
    EXPECT_EQ(plan.stackCapacity, 25U * 40000U);
    EXPECT_EQ(plan.readyCapacity, 8U * 40000U);
}

TEST(MemoryPlan, ALargeSceneIsStreamedAndASmallOneStaysWhilePicturesAreCut) {
    RenderOptions options;
    options.memoryBytes = 64 * mebibyte;
    const MemoryPlan both = planMemory(options, sceneOf(1000000), largeDevice());
    EXPECT_TRUE(both.streamed());
    EXPECT_GT(both.buckets(), 1);
    const MemoryPlan cut = planMemory(options, sceneOf(10000), largeDevice());
    EXPECT_FALSE(cut.streamed());
    EXPECT_GT(cut.buckets(), 1);
    options.pixelSamples = 1;
    const MemoryPlan streamed = planMemory(options, sceneOf(1000000), largeDevice());
    EXPECT_TRUE(streamed.streamed());
    EXPECT_EQ(streamed.buckets(), 1);
}

TEST(MemoryPlan, ASceneStaysResidentWhereStreamingItWouldMakeMoreParts) {
    RenderOptions options;
    options.memoryBytes = 16 * mebibyte;
    const MemoryPlan plan = planMemory(options, sceneOf(15000), largeDevice());
    EXPECT_GT(plan.bytes.scene, (plan.budget - plan.bytes.queues) / 2);
    EXPECT_FALSE(plan.streamed());
}

TEST(MemoryPlan, KeepsGivenBatchesAndRoundsGivenBucketsUpToTiles) {
    RenderOptions options;
    options.pixelSamples = 3;  // tiles of 3 x 3 pixels
    options.batch = 12345;
    options.bucketWidth = 100;
    options.bucketHeight = 99;
    const MemoryPlan plan = planMemory(options, sceneOf(1000), largeDevice());
    EXPECT_EQ(plan.batch, 12345U);
    EXPECT_EQ(plan.bucketWidth, 102);
    EXPECT_EQ(plan.bucketHeight, 99);
    EXPECT_EQ(plan.bucketsX, 13);
    EXPECT_EQ(plan.bucketsY, 8);
    options.bucketWidth = options.bucketHeight = 65536;
    EXPECT_EQ(planMemory(options, sceneOf(1000), largeDevice()).buckets(), 1);
}

TEST(MemoryPlan, TheCpuMethodHasNoStackOnTheDeviceAndBreadthNoQueues) {
    RenderOptions options;
    options.batch = 1000;
    options.method = SplitMethod::cpu;
    const MemoryPlan cpu = planMemory(options, sceneOf(1000), largeDevice());
    EXPECT_EQ(cpu.stackCapacity, 0U);
    EXPECT_GE(cpu.readyCapacity, 1000U + options.threads);
    options.method = SplitMethod::breadth;
    EXPECT_EQ(planMemory(options, sceneOf(1000), largeDevice()).bytes.queues, 0U);
}

TEST(MemoryPlan, IdsOfWaitingRangesFitTheirBits) {
    RenderOptions options;
    options.gridSize = 32;
    options.batch = 1U << 20;
    options.memoryBytes = std::uint64_t{8} << 30;
    EXPECT_EQ(planMemory(options, sceneOf(1000), largeDevice()).readyCapacity, (1U << 22) - 2);
}

TEST(MemoryPlan, NormalsOfSamplesAndCoarseDepthAreInIt) {
    RenderOptions options;
    options.memoryBytes = 512 * mebibyte;
    options.pixelSamples = 1;
    options.occlusion = false;
    const std::uint64_t plain = planMemory(options, sceneOf(5000000), largeDevice()).bytes.film;
    EXPECT_EQ(plain, 1280U * 720U * 20U + 160U * 90U);
    options.aovs = Aov::normal;
    EXPECT_EQ(planMemory(options, sceneOf(5000000), largeDevice()).bytes.film, plain + std::uint64_t{1280} * 720 * 12);
    EXPECT_EQ(planMemory(options, sceneOf(50), largeDevice()).bytes.film, plain);
    options.aovs = Aov::none;
    options.occlusion = true;
    EXPECT_EQ(planMemory(options, sceneOf(50), largeDevice()).bytes.film, plain + std::uint64_t{4} * (160 * 90 + 20 * 12));
    options.mode = DiceMode::classical;
    EXPECT_EQ(planMemory(options, sceneOf(50), largeDevice()).bytes.film, plain);
}

// Of batches that are given, so that the queues' share stays.
TEST(MemoryPlan, TwiceTheMemoryNeverMeansMoreParts) {
    std::mt19937 random(5);
    for (int i = 0; i < 500; ++i) {
        Case made = randomCase(random);
        made.options.batch = 300;
        std::optional<MemoryPlan> before;
        for (std::uint64_t budget = mebibyte; budget <= 2048 * mebibyte; budget *= 2) {
            const std::optional<MemoryPlan> plan = planOf(made, budget);
            SCOPED_TRACE(made.text + ", budget " + std::to_string(budget >> 20));
            EXPECT_TRUE(plan || !before);
            if (plan && before) {
                EXPECT_LE(std::uint64_t{plan->chunks} * static_cast<std::uint64_t>(plan->buckets()),
                          std::uint64_t{before->chunks} * static_cast<std::uint64_t>(before->buckets()));
            }
            if (plan) before = plan;
        }
    }
}

TEST(MemoryPlan, MoreMemoryNeverMeansMoreBucketsForAResidentScene) {
    RenderOptions options;
    options.batch = 300;
    int before = 1 << 20;
    for (std::uint64_t budget = 2 * mebibyte; budget <= 400 * mebibyte; budget += mebibyte) {
        options.memoryBytes = budget;
        const MemoryPlan plan = planMemory(options, sceneOf(500), largeDevice());
        EXPECT_FALSE(plan.streamed());
        EXPECT_LE(plan.buckets(), before);
        before = plan.buckets();
    }
    EXPECT_EQ(before, 1);
}

TEST(MemoryPlan, BucketsCoverEveryPixelOfTheCropWindowOnce) {
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
        RenderOptions options;
        options.width = 5 + static_cast<int>(random() % 300);
        options.height = 5 + static_cast<int>(random() % 200);
        options.pixelSamples = 1 + static_cast<int>(random() % 16);
        if (random() % 2 == 0) options.crop = {0.0F, 0.77F, 0.33F, 1.0F};
        if (random() % 2 == 0) options.bucketWidth = options.bucketHeight = 8 + static_cast<int>(random() % 60);
        options.memoryBytes = mebibyte * (1 + random() % 12);
        options.batch = 64;
        SCOPED_TRACE(std::to_string(options.width) + "x" + std::to_string(options.height) + ", case " + std::to_string(i));
        const PixelWindow crop = cropWindow(options);
        const auto plan = planOf({options, sceneOf(10), ""}, options.memoryBytes);
        if (!plan) continue;
        const auto row = static_cast<std::size_t>(options.width);
        const auto at = [row](int x, int y) { return static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x); };
        std::vector<int> covered(at(0, options.height));
        for (int k = 0; k < plan->buckets(); ++k) {
            const PixelWindow bucket = bucketWindow(options, *plan, k);
            const FilmLayout layout = bucketLayout(options, *plan, k);
            EXPECT_EQ((bucket.x0 - crop.x0) * options.pixelSamples % layout.tileCells, 0);
            EXPECT_EQ((bucket.y0 - crop.y0) * options.pixelSamples % layout.tileCells, 0);
            EXPECT_EQ(layout.x0, bucket.x0);
            EXPECT_EQ(layout.height, bucket.height);
            for (int y = bucket.y0; y < bucket.y0 + bucket.height; ++y)
                for (int x = bucket.x0; x < bucket.x0 + bucket.width; ++x) ++covered.at(at(x, y));
        }
        for (int y = 0; y < options.height; ++y) {
            for (int x = 0; x < options.width; ++x) {
                const bool within = x >= crop.x0 && x < crop.x0 + crop.width && y >= crop.y0 && y < crop.y0 + crop.height;
                ASSERT_EQ(covered[at(x, y)], within ? 1 : 0) << x << ", " << y;
            }
        }
    }
}

TEST(MemoryPlan, TheLargestPictureIsPlannedInBuckets) {
    RenderOptions options;
    options.width = options.height = 65536;
    options.pixelSamples = 16;
    options.memoryBytes = 64 * mebibyte;
    const MemoryPlan plan = planMemory(options, sceneOf(1000), largeDevice());
    EXPECT_LE(plan.bytes.total(), plan.budget);
    EXPECT_GT(plan.buckets(), 1000);
    const PixelWindow last = bucketWindow(options, plan, plan.buckets() - 1);
    EXPECT_EQ(last.x0 + last.width, 65536);
    EXPECT_EQ(last.y0 + last.height, 65536);
    options.memoryBytes = std::uint64_t{60} << 30;
    EXPECT_LT(bucketLayout(options, planMemory(options, sceneOf(1000), largeDevice()), 0).samples, filmSamplesEnd);
}

}  // namespace
}  // namespace tessera
