// The picture: on the device whole and mapped, or a bucket at a time and put together on the host.
#pragma once

#include <span>
#include <vector>

#include "device/session.h"
#include "film/film_layout.h"
#include "film/picture_layout.h"
#include "tessera/renderer.h"

namespace tessera {

class PictureBuffer {
public:
    explicit PictureBuffer(DeviceSession& session) : session_(session) {}
    ~PictureBuffer() { endMapping(); }
    PictureBuffer(const PictureBuffer&) = delete;
    PictureBuffer& operator=(const PictureBuffer&) = delete;

    // Throws Error where the host has no memory for a picture of `window` that is put together of buckets.
    static void requireRoom(const PixelWindow& window, int bucketWidth, int bucketHeight, Aov aovs);
    // Makes room for `window` in buckets of at most `bucketWidth` x `bucketHeight` pixels. What was shown before is no longer valid.
    void prepare(const PixelWindow& window, int bucketWidth, int bucketHeight, Aov aovs);
    void release();

    // Where shade_tiles writes a bucket's planes.
    [[nodiscard]] const cl::Buffer& cl() const { return buffer_.cl(); }
    [[nodiscard]] static picture_planes planesOf(const FilmLayout& bucket, Aov aovs);

    // Ends what fetch() began: before kernels write to cl() again. Nothing waits.
    void unmap();
    // Waits for a bucket and takes it into the picture.
    void fetch(const FilmLayout& bucket);
    // After the last bucket, until the next prepare().
    [[nodiscard]] std::vector<Plane> planes() const;

private:
    void endMapping();
    [[nodiscard]] bool whole() const { return whole_.empty(); }

    DeviceSession& session_;
    PixelWindow window_;
    Aov aovs_ = Aov::none;
    PictureLayout layout_;  // of the whole window
    DeviceBuffer buffer_;
    void* mapped_ = nullptr;
    std::vector<float> whole_;  // empty where the device holds the whole picture
};

}  // namespace tessera
