// A scene's patches on the device: resident where they fit, else chunk by chunk, the next one's upload under way while one is drawn.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "device/session.h"
#include "surface/patch_set.h"
#include "surface/patch_source.h"

namespace tessera {

// Uploads go on the transfer queue and read memory that the stream keeps; the device, not the host, waits for them and for the commands
// that still read what they overwrite. Throws Error where memory is short and cl::Error where the device fails; both leave the stream
// as after release(), or with the failed chunk not on the device.
// What a chunk is placed for: shading needs no boxes, and not where the dicing camera sees the patches.
enum class Placing { toSplit, toShade };

class PatchStream {
public:
    explicit PatchStream(DeviceSession& session);
    ~PatchStream();
    PatchStream(const PatchStream&) = delete;
    PatchStream& operator=(const PatchStream&) = delete;

    // Takes another scene; nothing is on the device then.
    void setSource(PatchSource source);
    [[nodiscard]] const PatchSource& source() const;

    // The device bytes that reserve() takes: two sets of inputs and one of placed points, one of each where one chunk holds all patches.
    [[nodiscard]] static std::uint64_t bytes(const PatchSource& source, std::uint32_t patchesEach, bool dicingApart);

    // Makes room for chunks of `patchesEach` patches, at least 1. What is resident stays so where the chunks are the same as before.
    void reserve(std::uint32_t patchesEach, bool dicingApart);
    // At least 1: a scene without patches is one chunk of none. 0 before reserve().
    [[nodiscard]] std::uint32_t chunks() const { return chunks_; }
    // Lets go of all buffers.
    void release();

    // Starts a frame: the objects as its cameras see them, by index into Scene::objects; `dicing` empty where there is no other camera,
    // that is where reserve() had no `dicingApart`. Both must stay until the frame's end. Nothing waits.
    void beginFrame(std::span<const placed_object> placed, std::span<const placed_object> dicing);

    // Takes other points of the scene's mesh `index`: of the same kind and number, without records. What is resident stays, but for these.
    void replaceMesh(std::size_t index, const Mesh& mesh);

    // Whether anything of the chunk may be seen within the frame's bounds (frame_params::cull_left and so on, near_plane). Conservative.
    [[nodiscard]] bool mayShow(std::uint32_t chunk, const frame_params& frame) const;

    // The chunk on the device, uploaded and, unless it is resident and placed in this frame already, placed: the commands that follow on
    // the main queue see it. Sets the frame's patch counts; needs its camera and film. Valid until the next call but one.
    [[nodiscard]] const PatchSet& use(std::uint32_t chunk, frame_params& frame, Placing placing = Placing::toSplit);
    // Starts the upload of the chunk that is wanted next, while the one in use is drawn. A hint: use() uploads what is not under way.
    void prefetch(std::uint32_t chunk);

    // Bytes uploaded since beginFrame(), and times the host waited for an upload.
    [[nodiscard]] std::uint64_t uploadedBytes() const { return uploadedBytes_; }
    [[nodiscard]] std::uint64_t waits() const { return waits_; }

private:
    static constexpr std::uint32_t noChunk = std::numeric_limits<std::uint32_t>::max();

    // A chunk's inputs on the device, and what they are uploaded from.
    struct Inputs {
        PatchSet patches;
        PatchChunk chunk;
        std::vector<placed_object> objects;
        std::vector<placed_object> dicingObjects;
        std::uint32_t holds = noChunk;  // which chunk
        std::uint64_t objectsOf = 0;    // the frame whose objects are here; 0: none
        cl::Event uploaded;             // of the last upload
        bool toAwait = false;           // whether the main queue has yet to wait for it
        cl::Event read;                 // of the main queue's last commands that read these
    };

    [[nodiscard]] std::uint32_t firstOf(std::uint32_t chunk) const { return chunk * patchesEach_; }
    [[nodiscard]] std::uint32_t endOf(std::uint32_t chunk) const;
    void endUploads() const noexcept;
    void allocate(const ChunkSize& size, std::size_t sets);
    [[nodiscard]] std::size_t inputsFor(std::uint32_t chunk) const;
    void provide(Inputs& inputs, std::uint32_t chunk);
    void gather(Inputs& inputs, std::uint32_t chunk);
    void sendObjects(Inputs& inputs);
    void awaitStaging(Inputs& inputs);
    template <typename T>
    void send(Inputs& inputs, const DeviceBuffer& buffer, const std::vector<T>& values);
    void place(const Inputs& inputs, const frame_params& frame, Placing placing);

    DeviceSession& session_;
    PatchSource source_;
    std::array<Inputs, 2> inputs_;
    std::size_t current_ = 0;  // of inputs_: what was used last
    std::uint32_t patchesEach_ = 0;
    std::uint32_t chunks_ = 0;
    bool dicingApart_ = false;
    std::span<const placed_object> placed_;
    std::span<const placed_object> dicing_;
    std::uint64_t frame_ = 0;  // counted from 1
    std::uint32_t placedChunk_ = noChunk;
    Placing placedFor_ = Placing::toSplit;
    std::uint64_t uploadedBytes_ = 0;
    std::uint64_t waits_ = 0;
};

}  // namespace tessera
