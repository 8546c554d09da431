// What a renderer holds, and the frames that it draws with it: bucket by bucket, chunk by chunk.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "film/film.h"
#include "render/picture_buffer.h"
#include "render/split_loop.h"
#include "shade/light_shared.h"
#include "split/local_queues.h"
#include "surface/patch_stream.h"
#include "tessera/progress.h"
#include "tessera/renderer.h"

namespace tessera {

// The stations' buffers on one device, kept from frame to frame.
struct Stations {
    explicit Stations(const RendererSettings& settings);

    DeviceSession session;
    Scene scene;  // without control points: `stream` has them
    PatchStream stream;
    SplitQueues queues;
    LocalQueues local;
    Film film;
    PictureBuffer picture;
    DeviceBuffer lights;
    DeviceBuffer chunksSeen;  // uint a chunk: whether the bucket shows any of it
    MemoryPlan lastPlan;      // whose buffers are held
};

// One frame.
class FrameJob {
public:
    FrameJob(Stations& stations, const Camera& camera, const RenderOptions& options, const MemoryPlan& plan, const Progress& progress);
    ~FrameJob();
    FrameJob(const FrameJob&) = delete;
    FrameJob& operator=(const FrameJob&) = delete;

    // Leaves the picture in the renderer's PictureBuffer.
    [[nodiscard]] Statistics run();

private:
    using Clock = std::chrono::steady_clock;

    void reserve();
    void beginFrame();
    void drawBucket(int bucket);
    [[nodiscard]] bool feedsByBoxes() const;
    void drawResident(frame_params& frame, const FilmLayout& layout);
    void splitChunks(frame_params& frame);
    void shadeChunks(frame_params& frame, const FilmLayout& layout);
    // Of the bucket's progress, this run is `share` behind `before`.
    void split(const frame_params& frame, const PatchSet& patches, double before, double share, const std::function<void()>& meanwhile,
               const std::function<void()>& finish);
    void takeBucket(const FilmLayout& layout);
    void tell(std::string_view stage, double fractionOfBucket) const;
    [[nodiscard]] std::vector<std::uint32_t> chunksSeen(const frame_params& frame);
    [[nodiscard]] split_limits limits(const frame_params& frame) const;
    [[nodiscard]] Statistics statistics(double frameMs);
    void addCounts(Statistics& statistics);
    void addResources(Statistics& statistics) const;

    Stations& stations_;
    const Camera& camera_;
    const RenderOptions& options_;
    const MemoryPlan& plan_;
    const Progress& progress_;
    std::vector<placed_object> placed_;
    std::vector<placed_object> dicing_;
    std::vector<eye_light> lights_;
    SplitReport report_;
    split_state counts_{};  // of the frame, once a bucket is taken
    bool ended_ = false;    // all that was enqueued is done
    int bucketsDone_ = 0;
};

}  // namespace tessera
