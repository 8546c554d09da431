// The samples of a frame on the device: their layout, and what their ids stand for from batch to batch.
#pragma once

#include <cstdint>

#include "core/frame_shared.h"
#include "device/session.h"
#include "split/queues.h"
#include "tessera/options.h"

namespace tessera {

// How the crop window is cut into cells (a sample each) and tiles.
struct FilmLayout {
    int x0 = 0;  // crop window in pixels of the full picture
    int y0 = 0;
    int width = 0;
    int height = 0;
    int pixelSamples = 1;
    int tileCells = 8;  // along a side; a multiple of pixelSamples
    int tilesX = 0;
    int tiles = 0;
    std::uint64_t samples = 0;  // tiles x tileCells^2

    // Of the film's own buffers: samples, references, touched.
    [[nodiscard]] std::uint64_t bytes() const { return samples * (8 + 12) + static_cast<std::uint64_t>(tiles); }
};

// Throws Error when there are 2^30 samples or more, with the bytes that they would need.
[[nodiscard]] FilmLayout layOutFilm(const RenderOptions& options);

class Film {
public:
    explicit Film(DeviceSession& session) : session_(session) {}

    // Makes room; all samples are background afterwards.
    void prepare(const FilmLayout& layout);

    // Lets go of all buffers.
    void release();

    // Resolves the batch that dice_hide has hidden, unless it is the last, and empties `ready` (resolve.cl).
    void enqueueResolve(const frame_params& frame, const split_limits& limits, const SplitQueues& queues);

    [[nodiscard]] const cl::Buffer& samples() const { return samples_.cl(); }
    [[nodiscard]] const cl::Buffer& touched() const { return touched_.cl(); }
    [[nodiscard]] const cl::Buffer& referencePatch() const { return referencePatch_.cl(); }
    [[nodiscard]] const cl::Buffer& referenceU() const { return referenceU_.cl(); }
    [[nodiscard]] const cl::Buffer& referenceV() const { return referenceV_.cl(); }

    // The film may hold samples of a frame that broke off: prepare() must clear it.
    void distrust() { clean_ = false; }
    // The frame ended, shade_tiles has emptied the film.
    void trust() { clean_ = true; }

private:
    DeviceSession& session_;
    DeviceBuffer samples_;  // 8 bytes a sample, film.clh
    DeviceBuffer touched_;  // 1 byte a tile
    DeviceBuffer referencePatch_;
    DeviceBuffer referenceU_;
    DeviceBuffer referenceV_;
    bool clean_ = false;
};

}  // namespace tessera
