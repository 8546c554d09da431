#include "split/local_queues.h"

#include <algorithm>
#include <string>

#include "tessera/error.h"

namespace tessera {
namespace {

std::uint64_t stackBytes(std::uint32_t width, DiceMode mode) { return std::uint64_t{LOCAL_LEVELS} * width * SplitQueues::rangeBytes(mode); }

// What a group takes of the device's local memory.
std::uint64_t localBytes(std::uint32_t width, DiceMode mode) {
    return stackBytes(width, mode) + (mode == DiceMode::watertight ? LOCAL_QUADS_SCRATCH : LOCAL_BOXES_SCRATCH);
}

std::uint32_t mostWidth(DiceMode mode) { return mode == DiceMode::watertight ? LOCAL_QUADS_MOST : LOCAL_BOXES_MOST; }

void requireLocalMemory(const DeviceInfo& device, std::uint32_t width, DiceMode mode) {
    if (localBytes(width, mode) <= device.localBytes) return;
    throw Error("method local needs " + std::to_string(localBytes(width, mode)) + " bytes of local memory, and " + device.name + " has " +
                std::to_string(device.localBytes) + "; use --method bounded");
}

struct PoolBytes {
    std::uint64_t pool, groups, ranks, run;
};

PoolBytes poolBytes(const LocalShape& shape, DiceMode mode) {
    return {std::uint64_t{2} * shape.groups * stackBytes(shape.width, mode), shape.groups * sizeof(local_group),
            std::uint64_t{LOCAL_LEVELS} * shape.groups * sizeof(local_rank), sizeof(local_run)};
}

}  // namespace

LocalShape localShape(const DeviceInfo& device, DiceMode mode) {
    std::uint32_t width = mostWidth(mode);
    while (width > 1 && localBytes(width, mode) > device.localBytes) width /= 2;
    requireLocalMemory(device, width, mode);
    return {std::max(1U, device.computeUnits), width};
}

std::uint64_t LocalQueues::bytes(const LocalShape& shape, DiceMode mode) {
    const PoolBytes bytes = poolBytes(shape, mode);
    std::uint64_t sum = 0;
    for (const std::uint64_t buffer : {bytes.pool, bytes.groups, bytes.ranks, bytes.run}) sum += DeviceMemory::bytesFor(buffer);
    return sum;
}

void LocalQueues::reserve(const LocalShape& shape, DiceMode mode) {
    requireLocalMemory(session_.device.info, shape.width, mode);
    DeviceMemory& memory = session_.memory;
    const PoolBytes bytes = poolBytes(shape, mode);
    memory.ensure(pool_, Purpose::queues, "the pool of ranges", bytes.pool);
    memory.ensure(groups_, Purpose::queues, "the work-groups' counts", bytes.groups);
    memory.ensure(ranks_, Purpose::queues, "the pool's order", bytes.ranks);
    memory.ensure(run_, Purpose::queues, "the pool's counts", bytes.run);
    shape_ = shape;
    mode_ = mode;
}

void LocalQueues::release() {
    for (DeviceBuffer* const buffer : {&pool_, &groups_, &ranks_, &run_}) *buffer = DeviceBuffer();
}

void LocalQueues::restart() {
    session_.timeline.fill(run_.cl(), 0, sizeof(local_run));
    session_.timeline.fill(groups_.cl(), 0, shape_.groups * sizeof(local_group));
}

void LocalQueues::enqueueLaunch(const frame_params& frame, const split_limits& limits, const PatchSet& patches, const cl::Buffer& coarse,
                                SplitQueues& queues, std::uint32_t mostRounds) {
    Kernels& kernels = session_.kernels;
    const local_limits shape{shape_.groups, shape_.width, mostRounds};
    const cl::LocalSpaceArg stack = cl::Local(stackBytes(shape_.width, mode_));
    if (mode_ == DiceMode::watertight)
        session_.launch(kernels.with("local_quads", frame, limits, shape, patches.eyePoints.cl(), patches.dicingPoints.cl(),
                                     patches.placed.cl(), patches.records.cl(), patches.feed.cl(), coarse, queues.state(), run_.cl(),
                                     groups_.cl(), ranks_.cl(), pool_.cl(), queues.ready(), stack),
                        "local_quads", shape_.groups);
    else
        session_.launch(kernels.with("local_boxes", frame, limits, shape, patches.eyePoints.cl(), patches.feed.cl(), queues.state(),
                                     run_.cl(), groups_.cl(), ranks_.cl(), pool_.cl(), queues.ready(), stack),
                        "local_boxes", shape_.groups);
    session_.launch(kernels.with("local_book", limits, shape, queues.state(), run_.cl(), groups_.cl(), ranks_.cl()), "local_book", 1);
}

std::vector<local_group> LocalQueues::readGroups() {
    std::vector<local_group> groups(shape_.groups);
    session_.timeline.read(groups_.cl(), groups.data(), groups.size() * sizeof(local_group));
    return groups;
}

std::vector<std::uint64_t> LocalQueues::groupRanges() {
    std::vector<std::uint64_t> ranges;
    for (const local_group& group : readGroups()) ranges.push_back(wide(group.frame_low, group.frame_high));
    return ranges;
}

}  // namespace tessera
