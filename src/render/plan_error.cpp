#include "render/plan_error.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

#include "device/memory.h"
#include "tessera/error.h"

namespace tessera {
namespace {

constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;

struct Part {
    std::string_view name;
    std::uint64_t bytes = 0;
    std::string advice;  // what makes it smaller, where something does
};

Part largestPart(const RenderOptions& options, const MemoryUse& bytes) {
    const std::string bucket = options.bucketWidth != 0 ? "a smaller --bucket" : "fewer --pixel-samples";
    const Part parts[] = {
        {"the scene", bytes.scene, options.method == SplitMethod::breadth ? "--method bounded, which streams it" : ""},
        {"the queues of ranges", bytes.queues, options.batch != 0 ? "a smaller --batch" : ""},
        {"the film", bytes.film, bucket},
        {"the picture", bytes.picture, options.bucketWidth != 0 ? "a smaller --bucket" : "fewer --aov"},
    };
    return *std::max_element(std::begin(parts), std::end(parts), [](const Part& a, const Part& b) { return a.bytes < b.bytes; });
}

}  // namespace

void throwTooSmall(const RenderOptions& options, const DeviceInfo& device, std::uint64_t budget, const MemoryPlan& least) {
    const std::uint64_t bytes = least.bytes.total();
    const Part most = largestPart(options, least.bytes);
    const std::string mostText = bytesText(most.bytes) + " of it for " + std::string(most.name);
    const std::string advice = most.advice.empty() ? "" : "; use " + most.advice;
    if (bytes > device.globalBytes) {
        throw Error("the frame needs " + bytesText(bytes) + " of device memory, but " + device.name + " holds " +
                    bytesText(device.globalBytes) + ": " + mostText + advice);
    }
    throw Error("the memory budget of " + bytesText(budget) + " is too small for this frame: --memory " +
                std::to_string((bytes + mebibyte - 1) / mebibyte) + " would do, " + mostText + advice);
}

void throwTooLarge(const RenderOptions& options, const DeviceInfo& device, TooLarge what) {
    const std::string beyond = " more than " + device.name + " can give in one buffer, " + bytesText(device.maxAllocationBytes);
    switch (what) {
        case TooLarge::queues:
            throw Error("a batch of " + std::to_string(options.batch) + " ranges needs" + beyond + "; use a smaller --batch");
        case TooLarge::bucket:
            throw Error("a bucket of " + std::to_string(options.bucketWidth) + "x" + std::to_string(options.bucketHeight) +
                        " pixels needs" + beyond + ", or has more than 2^30 samples; use a smaller --bucket or fewer --pixel-samples");
        case TooLarge::scene:
            break;
    }
    throw Error(
        "the scene's patches need" + beyond +
        (options.method == SplitMethod::breadth ? "; use --method bounded, which streams them" : ", in chunks of the smallest size"));
}

}  // namespace tessera
