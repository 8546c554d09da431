#include "render/plan_memory.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "film/picture_layout.h"
#include "render/frame_setup.h"
#include "render/plan_error.h"
#include "shade/light_shared.h"
#include "split/local_queues.h"
#include "split/queues.h"

namespace tessera {
namespace {

// Batches that the plan chooses from. Below the last a batch would not fill a work-group of a GPU (device/open_device.cpp).
constexpr std::array<std::uint32_t, 10> batches{40000, 20000, 10000, 5000, 2500, 1250, 600, 300, 150, 64};

// A smaller chunk could not fill the smallest batch.
constexpr std::uint32_t leastChunk = batches.back();

// The smallest bucket that the plan makes, as the smallest that a user may ask for.
constexpr int leastBucketSide = 8;

// Room in `ready`, in batches: each time it is full the film is resolved, which costs a pass over the tiles touched; 12 bytes a range
// are cheap beside it.
constexpr std::uint64_t batchesReady = 8;

// The cpu method hands out about p ranges, and one a thread at least: RenderOptions::threads at most.
constexpr std::uint32_t mostThreads = 1024;

constexpr int roundedUp(int value, int step) { return (value + step - 1) / step * step; }

struct Bucket {
    int width = 0;  // pixels
    int height = 0;
};

// Film and picture of a bucket.
struct Image {
    std::uint64_t film = 0;
    std::uint64_t picture = 0;
    bool possible = false;  // on the device, whatever the budget
    [[nodiscard]] std::uint64_t bytes() const { return film + picture; }
};

// How the room that the queues leave is used.
struct Division {
    Bucket bucket;
    std::uint32_t patchesEach = 0;
};

class Planner {
public:
    Planner(const RenderOptions& options, const PlannedScene& scene, const DeviceInfo& device)
        : options_(options), scene_(scene), device_(device), window_(cropWindow(options)), patches_(std::max(scene.patches, 1U)) {}

    // The plan within a budget, or none.
    [[nodiscard]] std::optional<MemoryPlan> within(std::uint64_t budget);
    // The plan that takes least, its bytes being its budget; none where some buffer is beyond the device in every plan.
    [[nodiscard]] std::optional<MemoryPlan> least();
    // What is beyond the device then.
    [[nodiscard]] TooLarge tooLarge();

private:
    [[nodiscard]] PlannedBytes queues(std::uint32_t batch) const;
    [[nodiscard]] std::vector<std::uint32_t> batchesFor(std::uint64_t budget) const;
    [[nodiscard]] std::uint32_t leastBatch() const { return options_.batch != 0 ? options_.batch : batches.back(); }
    [[nodiscard]] bool allocatable(std::uint64_t buffer) const { return buffer <= device_.maxAllocationBytes; }
    [[nodiscard]] bool mayStream() const { return options_.method != SplitMethod::breadth; }

    [[nodiscard]] PlannedBytes sceneBytes(std::uint32_t patchesEach);
    [[nodiscard]] bool sceneFits(std::uint32_t patchesEach, std::uint64_t room);
    [[nodiscard]] std::optional<std::uint32_t> chunkWithin(std::uint64_t room);
    [[nodiscard]] std::optional<std::uint32_t> smallestChunk();

    [[nodiscard]] int tile() const { return tilePixels(options_.pixelSamples); }
    [[nodiscard]] bool streamed(std::uint32_t patchesEach) const { return patchesEach < patches_; }
    [[nodiscard]] Image image(const Bucket& bucket, bool isStreamed) const;
    [[nodiscard]] Bucket largestBucket() const;
    [[nodiscard]] Bucket smallestBucket() const;
    [[nodiscard]] std::optional<Bucket> bucketWithin(std::uint64_t room, bool isStreamed) const;

    [[nodiscard]] std::optional<Division> divide(std::uint64_t room);
    [[nodiscard]] std::optional<Division> streamedWithin(std::uint64_t room);
    [[nodiscard]] std::optional<Division> inOneBucket(std::uint64_t room);
    [[nodiscard]] std::optional<Division> withScene(std::uint32_t patchesEach, std::uint64_t room);
    [[nodiscard]] std::uint64_t parts(const Division& division) const;
    [[nodiscard]] MemoryPlan planOf(const Division& division, std::uint32_t batch, std::uint64_t budget);

    const RenderOptions& options_;
    const PlannedScene& scene_;
    const DeviceInfo& device_;
    PixelWindow window_;
    std::uint32_t patches_;
    std::map<std::uint32_t, PlannedBytes> sceneBytes_;  // by patchesEach: asked for again with every batch
};

PlannedBytes Planner::queues(std::uint32_t batch) const {
    if (options_.method == SplitMethod::breadth) return {};
    const QueueRoom room = queueRoom(options_, batch, device_);
    const auto ranges = std::max<std::uint64_t>({room.stack, room.limits.batch, room.limits.ready_capacity});
    PlannedBytes bytes{SplitQueues::bytes(room.limits, room.stack, options_.mode), SplitQueues::rangeBytes(options_.mode) * ranges};
    if (options_.method == SplitMethod::local) {
        const std::uint64_t pool = LocalQueues::bytes(localShape(device_, options_.mode), options_.mode);
        bytes.all += pool;
        bytes.largestBuffer = std::max(bytes.largestBuffer, pool);
    }
    return bytes;
}

// Largest first. The queues get a quarter of the budget at most, where they can do with it.
std::vector<std::uint32_t> Planner::batchesFor(std::uint64_t budget) const {
    std::vector<std::uint32_t> tried;
    if (options_.batch != 0 || options_.method == SplitMethod::breadth) return {options_.batch};
    for (const std::uint32_t batch : batches) {
        if (queues(batch).all <= budget / 4 || batch == batches.back()) tried.push_back(batch);
    }
    return tried;
}

PlannedBytes Planner::sceneBytes(std::uint32_t patchesEach) {
    const auto known = sceneBytes_.find(patchesEach);
    if (known != sceneBytes_.end()) return known->second;
    PlannedBytes bytes = scene_.chunks(patchesEach);
    const auto add = [&bytes](std::uint64_t buffer) {
        bytes.all += DeviceMemory::bytesFor(buffer);
        bytes.largestBuffer = std::max(bytes.largestBuffer, DeviceMemory::bytesFor(buffer));
    };
    add(std::max<std::uint64_t>(scene_.lights, 1) * sizeof(eye_light));
    // Shading a streamed scene takes a flag a chunk: whether it is seen.
    if (streamed(patchesEach)) add((patches_ + std::uint64_t{patchesEach} - 1) / patchesEach * sizeof(uint));
    sceneBytes_.emplace(patchesEach, bytes);
    return bytes;
}

bool Planner::sceneFits(std::uint32_t patchesEach, std::uint64_t room) {
    const PlannedBytes bytes = sceneBytes(patchesEach);
    return bytes.all <= room && allocatable(bytes.largestBuffer);
}

// All patches, or else the most that fit, to a sixteenth. Bytes need not grow with every patch more, for chunks begin elsewhere then.
std::optional<std::uint32_t> Planner::chunkWithin(std::uint64_t room) {
    std::uint32_t each = patches_;
    std::uint32_t tooMany = patches_;
    while (!sceneFits(each, room)) {
        if (each <= leastChunk || !mayStream()) return std::nullopt;
        tooMany = each;
        each = std::max(leastChunk, each / 2);
    }
    const std::uint32_t finest = std::max(each / 16, 1U);
    for (std::uint32_t step = each / 2; step >= finest; step /= 2) {
        if (each + step < tooMany && sceneFits(each + step, room)) each += step;
    }
    return each;
}

// Of the sizes that chunkWithin() halves through, all patches left out, that which takes least.
std::optional<std::uint32_t> Planner::smallestChunk() {
    std::optional<std::uint32_t> best;
    if (!mayStream()) return best;
    for (std::uint32_t each = patches_; each > leastChunk;) {
        each = std::max(leastChunk, each / 2);
        if (!allocatable(sceneBytes(each).largestBuffer)) continue;
        if (!best || sceneBytes(each).all < sceneBytes(*best).all) best = each;
    }
    return best;
}

Image Planner::image(const Bucket& bucket, bool isStreamed) const {
    const bool coarse = options_.occlusion && options_.mode == DiceMode::watertight;
    const FilmBytes film =
        filmBytes(bucket.width, bucket.height, options_.pixelSamples, {isStreamed && contains(options_.aovs, Aov::normal), coarse});
    const std::uint64_t floats = layOutPicture(bucket.width, bucket.height, options_.aovs).floats;
    const std::uint64_t picture = DeviceMemory::bytesFor(floats * sizeof(float));
    const bool numbered = filmSamples(bucket.width, bucket.height, options_.pixelSamples) < filmSamplesEnd && floats < NO_PLANE;
    return {film.all, picture, numbered && allocatable(std::max(film.largestBuffer, picture))};
}

Bucket Planner::largestBucket() const {
    if (options_.bucketWidth == 0) return {window_.width, window_.height};
    return {std::min(roundedUp(options_.bucketWidth, tile()), window_.width),
            std::min(roundedUp(options_.bucketHeight, tile()), window_.height)};
}

Bucket Planner::smallestBucket() const {
    if (options_.bucketWidth != 0) return largestBucket();
    const int side = roundedUp(leastBucketSide, tile());
    return {std::min(side, window_.width), std::min(side, window_.height)};
}

// By cutting the larger side into one part more until they fit: halves would often leave a third of the room unused.
std::optional<Bucket> Planner::bucketWithin(std::uint64_t room, bool isStreamed) const {
    const Bucket largest = largestBucket();
    const Bucket smallest = smallestBucket();
    const auto part = [this](int side, int parts, int least) { return std::max(roundedUp((side - 1) / parts + 1, tile()), least); };
    Bucket bucket = largest;
    int across = 1;
    int down = 1;
    while (true) {
        const Image made = image(bucket, isStreamed);
        if (made.possible && made.bytes() <= room) return bucket;
        const bool wide = bucket.width > smallest.width;
        const bool high = bucket.height > smallest.height;
        if (!wide && !high) return std::nullopt;
        if (wide && (bucket.width >= bucket.height || !high)) {
            bucket.width = part(largest.width, ++across, smallest.width);
        } else {
            bucket.height = part(largest.height, ++down, smallest.height);
        }
    }
}

// The buckets that the room beside such chunks allows; then larger chunks where these leave room.
std::optional<Division> Planner::withScene(std::uint32_t patchesEach, std::uint64_t room) {
    if (!sceneFits(patchesEach, room)) return std::nullopt;
    const std::optional<Bucket> bucket = bucketWithin(room - sceneBytes(patchesEach).all, streamed(patchesEach));
    if (!bucket || !streamed(patchesEach)) return bucket ? std::optional(Division{*bucket, patchesEach}) : std::nullopt;
    const std::uint32_t larger = chunkWithin(room - image(*bucket, true).bytes()).value_or(patchesEach);
    return Division{*bucket, std::max(patchesEach, larger)};
}

// One bucket, or those asked for, and the patches streamed beside: where that leaves a quarter of the room to them.
std::optional<Division> Planner::inOneBucket(std::uint64_t room) {
    const Bucket bucket = largestBucket();
    const Image made = image(bucket, true);
    if (!made.possible || made.bytes() > room / 4 * 3) return std::nullopt;
    const std::optional<std::uint32_t> each = chunkWithin(room - made.bytes());
    return each ? std::optional(Division{bucket, *each}) : std::nullopt;
}

std::optional<Division> Planner::streamedWithin(std::uint64_t room) {
    std::optional<Division> division = inOneBucket(room);
    // What is left are budgets that both have to share, and those so small that only the least of each fits.
    for (const std::optional<std::uint32_t>& each : {chunkWithin(room / 4), smallestChunk()}) {
        if (each && !division) division = withScene(*each, room);
    }
    return division;
}

std::uint64_t Planner::parts(const Division& division) const {
    const auto over = [](std::uint64_t all, std::uint64_t each) { return (all - 1) / each + 1; };
    const auto pixels = [](int side) { return static_cast<std::uint64_t>(side); };
    return over(pixels(window_.width), pixels(division.bucket.width)) * over(pixels(window_.height), pixels(division.bucket.height)) *
           over(patches_, division.patchesEach);
}

// A resident scene is kept where that does not cut the picture into more parts than streaming would cut picture and scene.
std::optional<Division> Planner::divide(std::uint64_t room) {
    const std::optional<Division> resident = withScene(patches_, room);
    if (!mayStream() || (resident && parts(*resident) == 1)) return resident;
    const std::optional<Division> streaming = streamedWithin(room);
    if (!resident || !streaming) return resident ? resident : streaming;
    return parts(*resident) <= parts(*streaming) ? resident : streaming;
}

MemoryPlan Planner::planOf(const Division& division, std::uint32_t batch, std::uint64_t budget) {
    MemoryPlan plan;
    plan.budget = budget;
    const Image made = image(division.bucket, streamed(division.patchesEach));
    plan.bytes = {sceneBytes(division.patchesEach).all, queues(batch).all, made.film, made.picture};
    plan.batch = batch;
    if (options_.method != SplitMethod::breadth) {
        const QueueRoom room = queueRoom(options_, batch, device_);
        plan.readyCapacity = room.limits.ready_capacity;
        plan.stackCapacity = options_.method == SplitMethod::local ? localShape(device_, options_.mode).stackBound() : room.stack;
    }
    plan.bucketWidth = division.bucket.width;
    plan.bucketHeight = division.bucket.height;
    plan.bucketsX = (window_.width - 1) / division.bucket.width + 1;
    plan.bucketsY = (window_.height - 1) / division.bucket.height + 1;
    plan.chunkPatches = division.patchesEach;
    plan.chunks = (patches_ - 1) / division.patchesEach + 1;
    return plan;
}

std::optional<MemoryPlan> Planner::within(std::uint64_t budget) {
    for (const std::uint32_t batch : batchesFor(budget)) {
        const PlannedBytes queue = queues(batch);
        if (queue.all > budget || !allocatable(queue.largestBuffer)) continue;
        // What breadth will need is not known: it gets a quarter where the rest can do with less.
        std::optional<Division> division;
        if (options_.method == SplitMethod::breadth) division = divide(budget - budget / 4);
        if (!division) division = divide(budget - queue.all);
        if (division) return planOf(*division, batch, budget);
    }
    return std::nullopt;
}

std::optional<MemoryPlan> Planner::least() {
    std::optional<MemoryPlan> best;
    if (!allocatable(queues(leastBatch()).largestBuffer)) return best;
    for (const std::optional<std::uint32_t>& each : {std::optional(patches_), smallestChunk()}) {
        if (!each || !allocatable(sceneBytes(*each).largestBuffer)) continue;
        if (!image(smallestBucket(), streamed(*each)).possible) continue;
        MemoryPlan plan = planOf({smallestBucket(), *each}, leastBatch(), 0);
        plan.budget = plan.bytes.total();
        if (!best || plan.budget < best->budget) best = plan;
    }
    return best;
}

TooLarge Planner::tooLarge() {
    if (!allocatable(queues(leastBatch()).largestBuffer)) return TooLarge::queues;
    return image(smallestBucket(), false).possible ? TooLarge::scene : TooLarge::bucket;
}

}  // namespace

std::uint64_t frameBudget(const RenderOptions& options, const DeviceInfo& device) {
    return std::min(options.memoryBytes != 0 ? options.memoryBytes : defaultBudget(device), device.globalBytes);
}

QueueRoom queueRoom(const RenderOptions& options, std::uint32_t batch, const DeviceInfo& device) {
    const bool watertight = options.mode == DiceMode::watertight;
    const std::uint64_t numbered = mostNumbered(rateBits(watertight ? options.gridSize : options.diceRate));
    const auto ready = static_cast<std::uint32_t>(std::min(batchesReady * std::uint64_t{batch}, numbered));
    const int depth = watertight ? 2 * QUAD_LEVEL_MOST : options.maxDepth;
    switch (options.method) {
        case SplitMethod::cpu:
            return {{1, batch + mostThreads, batch + mostThreads}, 0};
        case SplitMethod::breadth:
            return {};
        case SplitMethod::local: {
            // Its ranges lie in a pool of its own.
            const std::uint32_t round = localShape(device, options.mode).batch();
            return {{round, std::max(ready, round), std::max(ready, round)}, 0};
        }
        case SplitMethod::bounded:
            break;
    }
    return {{batch, ready, ready}, (static_cast<std::uint64_t>(depth) + 1) * batch};
}

MemoryPlan planMemory(const RenderOptions& options, const PlannedScene& scene, const DeviceInfo& device) {
    options.validate();
    Planner planner(options, scene, device);
    const std::uint64_t budget = frameBudget(options, device);
    if (const std::optional<MemoryPlan> plan = planner.within(budget)) return *plan;
    if (const std::optional<MemoryPlan> least = planner.least()) throwTooSmall(options, device, budget, *least);
    throwTooLarge(options, device, planner.tooLarge());
}

PixelWindow bucketWindow(const RenderOptions& options, const MemoryPlan& plan, int k) {
    const PixelWindow crop = cropWindow(options);
    const int x = k % plan.bucketsX * plan.bucketWidth;
    const int y = k / plan.bucketsX * plan.bucketHeight;
    return {crop.x0 + x, crop.y0 + y, std::min(plan.bucketWidth, crop.width - x), std::min(plan.bucketHeight, crop.height - y)};
}

FilmLayout bucketLayout(const RenderOptions& options, const MemoryPlan& plan, int k) {
    return layOutFilm(bucketWindow(options, plan, k), options.pixelSamples);
}

}  // namespace tessera
