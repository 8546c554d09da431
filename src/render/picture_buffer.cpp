#include "render/picture_buffer.h"

#include <string>

#include "tessera/error.h"

#include <unistd.h>

namespace tessera {
namespace {

bool inBuckets(const PixelWindow& window, int bucketWidth, int bucketHeight) {
    return bucketWidth < window.width || bucketHeight < window.height;
}

// The host's memory, of which a picture may take half: the system hands out more than it has, and ends programs that use it.
std::uint64_t hostBytes() {
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGE_SIZE);
    return pages > 0 && size > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size) : ~std::uint64_t{0};
}

}  // namespace

void PictureBuffer::unmap() {
    if (mapped_ != nullptr) session_.timeline.unmap(buffer_.cl(), mapped_);
    mapped_ = nullptr;
}

void PictureBuffer::endMapping() {
    if (mapped_ == nullptr) return;
    try {
        unmap();
    } catch (const cl::Error&) {
        mapped_ = nullptr;  // the device is gone, and the mapping with it
    }
}

void PictureBuffer::requireRoom(const PixelWindow& window, int bucketWidth, int bucketHeight, Aov aovs) {
    if (!inBuckets(window, bucketWidth, bucketHeight)) return;
    const std::uint64_t bytes = layOutPicture(window.width, window.height, aovs).floats * sizeof(float);
    if (bytes <= hostBytes() / 2) return;
    throw Error("a picture of " + std::to_string(window.width) + "x" + std::to_string(window.height) + " would need " + bytesText(bytes) +
                " on the host, more than half of its " + bytesText(hostBytes()) + "; use a smaller --size, --crop or fewer --aov");
}

void PictureBuffer::prepare(const PixelWindow& window, int bucketWidth, int bucketHeight, Aov aovs) {
    endMapping();
    window_ = window;
    aovs_ = aovs;
    layout_ = layOutPicture(window.width, window.height, aovs);
    whole_ = {};
    if (inBuckets(window, bucketWidth, bucketHeight)) whole_.resize(layout_.floats);
    const std::uint64_t bytes = layOutPicture(bucketWidth, bucketHeight, aovs).floats * sizeof(float);
    session_.memory.ensure(buffer_, Purpose::picture, "the picture", bytes, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR);
}

void PictureBuffer::release() {
    endMapping();
    buffer_ = DeviceBuffer();
}

picture_planes PictureBuffer::planesOf(const FilmLayout& bucket, Aov aovs) {
    return layOutPicture(bucket.width, bucket.height, aovs).planes;
}

void PictureBuffer::fetch(const FilmLayout& bucket) {
    if (whole()) {
        unmap();
        mapped_ = session_.timeline.map(buffer_.cl(), layout_.floats * sizeof(float));
        return;
    }
    const picture_planes from = planesOf(bucket, aovs_);
    const auto width = static_cast<std::size_t>(bucket.width), height = static_cast<std::size_t>(bucket.height);
    const auto read = [&](int channels, std::uint64_t source, std::uint64_t target, bool last) {
        const std::size_t pixel = static_cast<std::size_t>(channels) * sizeof(float);
        const auto pitch = static_cast<std::size_t>(window_.width) * pixel;
        float* const plane = whole_.data() + target;
        session_.timeline.readRows(
            buffer_.cl(), source * sizeof(float), width * pixel, height, plane,
            static_cast<std::size_t>(bucket.y0 - window_.y0) * pitch + static_cast<std::size_t>(bucket.x0 - window_.x0) * pixel, pitch,
            last);
    };
    const std::span<const PlaneSpec> specs = planeSpecs();
    std::vector<std::size_t> wanted;
    for (std::size_t k = 0; k < specs.size(); ++k)
        if (layout_.places[k]) wanted.push_back(k);
    read(4, 0, 0, wanted.empty());
    for (const std::size_t k : wanted) read(specs[k].channels, from.*(specs[k].place), *layout_.places[k], k == wanted.back());
}

std::vector<Plane> PictureBuffer::planes() const {
    const float* const values = whole() ? static_cast<const float*>(mapped_) : whole_.data();
    const std::span<const float> all(values, layout_.floats);
    const std::size_t pixels = static_cast<std::size_t>(window_.width) * static_cast<std::size_t>(window_.height);
    std::vector<Plane> planes{{"rgba", 4, all.first(4 * pixels)}};
    const std::span<const PlaneSpec> specs = planeSpecs();
    for (std::size_t k = 0; k < specs.size(); ++k) {
        if (!layout_.places[k]) continue;
        planes.push_back(
            {specs[k].name, specs[k].channels, all.subspan(*layout_.places[k], static_cast<std::size_t>(specs[k].channels) * pixels)});
    }
    return planes;
}

}  // namespace tessera
