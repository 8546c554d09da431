// The samples of a bucket on the device, and what their ids stand for from batch to batch.
#pragma once

#include <cstdint>

#include "core/frame_shared.h"
#include "device/session.h"
#include "film/film_layout.h"
#include "split/queues.h"

namespace tessera {

class Film {
public:
    explicit Film(DeviceSession& session) : session_(session) {}

    // Makes room, beside the samples for `extras`; all samples are background afterwards.
    void prepare(const FilmLayout& layout, FilmExtras extras);

    // Lets go of all buffers.
    void release();

    // Nothing is known of depths any more: before each bucket that culls by them.
    void enqueueForgetDepth(const FilmLayout& layout);

    // What follows dice_hide: takes coarse depths where the frame culls by them (coarse.cl), resolves what is in `ready` where it must be
    // emptied, and books what was hidden (resolve.cl).
    void enqueueAfterHiding(const frame_params& frame, const split_limits& limits, SplitQueues& queues);

    [[nodiscard]] const cl::Buffer& samples() const { return samples_.cl(); }
    [[nodiscard]] const cl::Buffer& touched() const { return touched_.cl(); }
    // Once a sample is shaded by its chunk, its reference's places hold its radiance: r, g, b.
    [[nodiscard]] const cl::Buffer& referencePatch() const { return referencePatch_.cl(); }
    [[nodiscard]] const cl::Buffer& referenceU() const { return referenceU_.cl(); }
    [[nodiscard]] const cl::Buffer& referenceV() const { return referenceV_.cl(); }
    // Keys of tiles, then of blocks of 8 x 8 tiles (coarse.cl); like normals() where they are not kept.
    [[nodiscard]] const cl::Buffer& coarse() const { return coarse_.bytes() > 0 ? coarse_.cl() : referenceU_.cl(); }
    // Three floats a sample; where they are not kept any other buffer, for kernels that then do not touch it.
    [[nodiscard]] const cl::Buffer& normals() const { return normals_.bytes() > 0 ? normals_.cl() : referenceU_.cl(); }

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
    DeviceBuffer coarse_;  // 4 bytes a tile and a block of 8 x 8 tiles
    DeviceBuffer normals_;
    bool clean_ = false;
};

}  // namespace tessera
