// A scene's patches on the host, from which chunks of them are gathered for the device: any run of the placed patches, in the order
// Bezier, Gregory, rational, PN, each kind in the order of the objects.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/frame_shared.h"
#include "surface/patch_shared.h"
#include "tessera/scene.h"

namespace tessera {

// What a chunk takes, in elements of each of its arrays.
struct ChunkSize {
    std::uint64_t patches = 0;
    std::uint64_t floats = 0;     // of points, as uploaded
    std::uint64_t eyeFloats = 0;  // of points in eye space
    std::uint64_t records = 0;
    std::uint64_t objects = 0;

    // Device bytes of a chunk's inputs, of which a stream holds two sets, and of what enqueuePlace() makes of them.
    [[nodiscard]] std::uint64_t inputBytes(bool dicingApart) const;
    [[nodiscard]] std::uint64_t placedBytes(bool dicingApart) const;
    // The largest of its buffers, in bytes.
    [[nodiscard]] std::uint64_t largestBuffer() const;
};

// A chunk as the device takes it. Indices in it are its own: patches count from `first`, objects are those of `objects`.
struct PatchChunk {
    std::uint32_t first = 0;
    std::uint32_t patches = 0;
    std::uint32_t bezierPatches = 0;
    std::uint32_t gregoryEnd = 0;
    std::uint32_t rationalEnd = 0;
    std::vector<float> floats;
    std::vector<placed_patch> placed;
    std::vector<edge_info> records;
    std::vector<std::uint32_t> objects;  // indices into Scene::objects
};

// Copies share what they hold, which is never changed.
class PatchSource {
public:
    // Of no patches.
    PatchSource();
    // Of a validated scene. Throws Error where it has more than 2^31 - 1 placed patches.
    explicit PatchSource(const Scene& scene);

    [[nodiscard]] std::uint32_t patches() const;
    // Index behind the last Gregory patch: classical mode draws no others.
    [[nodiscard]] std::uint32_t gregoryEnd() const;

    // Of patches [first, end), exactly. Costs the objects that are in it.
    [[nodiscard]] ChunkSize sizeOf(std::uint32_t first, std::uint32_t end) const;
    // The largest of each number over the chunks [0, n), [n, 2 n), ... of `patchesEach` = n patches, n > 0. Costs all objects and chunks.
    [[nodiscard]] ChunkSize largest(std::uint32_t patchesEach) const;

    // Fills `chunk`, whose memory is used again. What several objects of the chunk have of one mesh stands in it once. Throws Error
    // where it would have 2^32 floats or more.
    void gather(std::uint32_t first, std::uint32_t end, PatchChunk& chunk) const;

    // The same with another mesh in the place of the scene's mesh `index`, of the same kind and number of patches, both without records.
    [[nodiscard]] PatchSource withMesh(std::size_t index, const Mesh& mesh) const;
    // Where the floats of mesh `index` begin in a chunk of all patches, and as gather() would make them. Empty of a mesh that no object
    // has.
    struct MeshFloats {
        std::uint64_t first = 0;
        std::span<const float> floats;
    };
    [[nodiscard]] MeshFloats meshFloats(std::size_t index) const;
    // SIDE_* of each patch of mesh `index`.
    [[nodiscard]] std::span<const std::uint8_t> meshFlags(std::size_t index) const;

    // Object and patch in its mesh of placed patches [first, end), in order, by take(object, patch).
    void forPatches(std::uint32_t first, std::uint32_t end, const std::function<void(std::uint32_t, std::uint32_t)>& take) const;

    // Whether anything of patches [first, end) may be seen within the frame's bounds (frame_params::cull_left and so on, near_plane) and a
    // pixel around them. Conservative: it tests boxes around runs of patches. `placed`: the frame's objects by index into Scene::objects.
    [[nodiscard]] bool mayShow(std::uint32_t first, std::uint32_t end, const frame_params& frame,
                               std::span<const placed_object> placed) const;

private:
    struct Data;
    std::shared_ptr<const Data> data_;
};

}  // namespace tessera
