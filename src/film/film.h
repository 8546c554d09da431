// The samples of a frame on the device: layout, hiding a batch into them, and turning them into a picture.
#pragma once

#include <cstdint>

#include "device/session.h"
#include "render/frame_shared.h"
#include "shade/light_shared.h"
#include "split/queues.h"
#include "surface/patch_set.h"
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

    // Hides and resolves the ranges that are ready, when the device finds that it is time (film/batch.clh), and empties `ready`.
    void enqueueBatch(const frame_params& frame, const split_limits& limits, const SplitQueues& queues, const PatchSet& patches,
                      bool emulateAtomics);

    // What shade_tiles needs besides the film.
    struct ShadeInputs {
        const PatchSet& patches;
        const cl::Buffer& objects;
        const cl::Buffer& lights;
        const cl::Buffer& picture;
        const SplitQueues& queues;  // whose last batch is still in `ready`
    };
    // Shades and filters into `inputs.picture`; the film is background again afterwards.
    void enqueueShade(const frame_params& frame, const picture_planes& planes, const ShadeInputs& inputs);

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
