#include "surface/patch_stream.h"

#include <algorithm>
#include <memory>

namespace tessera {
namespace {

std::uint32_t chunksOf(std::uint32_t patches, std::uint32_t patchesEach) {
    return static_cast<std::uint32_t>(std::max<std::uint64_t>(1, (std::uint64_t{patches} + patchesEach - 1) / patchesEach));
}

// What a frame needs of those of `placed` whose indices are given.
void pick(std::span<const placed_object> placed, const std::vector<std::uint32_t>& indices, std::vector<placed_object>& picked) {
    picked.clear();
    for (const std::uint32_t index : indices) picked.push_back(placed[index]);
}

// Whether the host may write again what an upload read. A failed one counts as ended.
bool ended(const cl::Event& upload) { return upload() == nullptr || upload.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>() <= CL_COMPLETE; }

}  // namespace

PatchStream::PatchStream(DeviceSession& session) : session_(session) {}

PatchStream::~PatchStream() { endUploads(); }

void PatchStream::setSource(PatchSource source) {
    release();
    source_ = std::move(source);
}

const PatchSource& PatchStream::source() const { return source_; }

std::uint64_t PatchStream::bytes(const PatchSource& source, std::uint32_t patchesEach, bool dicingApart) {
    const std::uint64_t sets = chunksOf(source.patches(), patchesEach) > 1 ? 2 : 1;
    const ChunkSize size = source.largest(patchesEach);
    return sets * size.inputBytes(dicingApart) + size.placedBytes(dicingApart);
}

// Where it fails the device is gone, and its reading of our memory with it.
void PatchStream::endUploads() const noexcept { clFinish(session_.device.transfers()); }

void PatchStream::release() {
    endUploads();
    // Made anew, for to assign an event may throw.
    for (Inputs& inputs : inputs_) {
        std::destroy_at(&inputs);
        std::construct_at(&inputs);
    }
    current_ = 0;
    patchesEach_ = 0;
    chunks_ = 0;
    placedChunk_ = noChunk;
}

void PatchStream::reserve(std::uint32_t patchesEach, bool dicingApart) {
    const std::uint32_t each = std::clamp<std::uint32_t>(patchesEach, 1, std::max<std::uint32_t>(1, source_.patches()));
    if (chunks_ > 0 && each == patchesEach_ && dicingApart == dicingApart_) return;
    if (chunks_ == 0 || each != patchesEach_) release();
    const std::uint32_t chunks = chunksOf(source_.patches(), each);
    dicingApart_ = dicingApart;
    try {
        allocate(source_.largest(each), chunks > 1 ? 2 : 1);
    } catch (...) {
        release();
        throw;
    }
    patchesEach_ = each;
    chunks_ = chunks;
}

// Buffers that are there already stay: those that a dicing camera of its own needs may come or go.
void PatchStream::allocate(const ChunkSize& size, std::size_t sets) {
    const auto fit = [&](DeviceBuffer& buffer, const char* name, std::uint64_t bytes, cl_mem_flags flags) {
        session_.memory.ensure(buffer, Purpose::scene, name, bytes, flags);
    };
    const std::uint64_t eyeBytes = size.eyeFloats * sizeof(float), objectBytes = size.objects * sizeof(placed_object);
    PatchSet& placed = inputs_[0].patches;
    for (Inputs& inputs : inputs_) {
        inputs.patches.dicingPoints = DeviceBuffer();
        if (!dicingApart_) inputs.patches.dicingObjects = DeviceBuffer();
        inputs.objectsOf = 0;
    }
    placedChunk_ = noChunk;
    fit(placed.eyePoints, "the patches in eye space", eyeBytes, CL_MEM_READ_WRITE);
    if (dicingApart_) fit(placed.dicingPoints, "the patches in the dicing camera's space", eyeBytes, CL_MEM_READ_WRITE);
    if (!dicingApart_) placed.dicingPoints = placed.eyePoints;
    fit(placed.boxes, "the patches' boxes", size.patches * sizeof(patch_box), CL_MEM_READ_WRITE);
    fit(placed.feed, "the patches to be fed", size.patches * sizeof(std::uint32_t), CL_MEM_READ_WRITE);
    for (std::size_t k = 0; k < sets; ++k) {
        PatchSet& set = inputs_[k].patches;
        fit(set.points, "the scene's control points", size.floats * sizeof(float), CL_MEM_READ_ONLY);
        fit(set.placed, "the scene's patches", size.patches * sizeof(placed_patch), CL_MEM_READ_ONLY);
        fit(set.records, "the scene's edge records", size.records * sizeof(edge_info), CL_MEM_READ_ONLY);
        fit(set.objects, "the objects", objectBytes, CL_MEM_READ_ONLY);
        if (dicingApart_) fit(set.dicingObjects, "the objects as the dicing camera sees them", objectBytes, CL_MEM_READ_ONLY);
        set.eyePoints = placed.eyePoints;
        set.dicingPoints = placed.dicingPoints;
        set.boxes = placed.boxes;
        set.feed = placed.feed;
    }
}

void PatchStream::beginFrame(std::span<const placed_object> placed, std::span<const placed_object> dicing) {
    placed_ = placed;
    dicing_ = dicing;
    ++frame_;
    placedChunk_ = noChunk;
    uploadedBytes_ = 0;
    waits_ = 0;
    Inputs& last = inputs_[current_];
    if (last.holds == noChunk) return;
    last.read = session_.timeline.mark();
    // Resident: its control points won't be uploaded again.
    if (chunks_ == 1 && ended(last.uploaded)) {
        last.chunk.floats = {};
        last.chunk.placed = {};
        last.chunk.records = {};
    }
}

void PatchStream::replaceMesh(std::size_t index, const Mesh& mesh) {
    PatchSource source = source_.withMesh(index, mesh);
    Inputs& resident = inputs_[0];
    if (chunks_ == 1 && resident.holds != noChunk) {
        endUploads();
        const PatchSource::MeshFloats floats = source.meshFloats(index);
        if (!floats.floats.empty()) {
            session_.timeline.writeAt(resident.patches.points.cl(), floats.first * sizeof(float), floats.floats.data(),
                                      floats.floats.size_bytes());
        }
        // Which sides are points stands with the patches.
        if (!std::ranges::equal(source.meshFlags(index), source_.meshFlags(index))) resident.holds = noChunk;
    } else {
        for (Inputs& inputs : inputs_) inputs.holds = noChunk;
    }
    source_ = std::move(source);
    placedChunk_ = noChunk;
}

std::uint32_t PatchStream::endOf(std::uint32_t chunk) const {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(source_.patches(), std::uint64_t{firstOf(chunk)} + patchesEach_));
}

bool PatchStream::mayShow(std::uint32_t chunk, const frame_params& frame) const {
    return source_.mayShow(firstOf(chunk), endOf(chunk), frame, placed_);
}

// Those that hold the chunk, else those that are not in use.
std::size_t PatchStream::inputsFor(std::uint32_t chunk) const {
    if (chunks_ == 1) return 0;
    for (std::size_t k = 0; k < inputs_.size(); ++k)
        if (inputs_[k].holds == chunk) return k;
    return inputs_[current_].holds == noChunk ? current_ : 1 - current_;
}

void PatchStream::awaitStaging(Inputs& inputs) {
    if (ended(inputs.uploaded)) return;
    ++waits_;
    inputs.uploaded.wait();
}

template <typename T>
void PatchStream::send(Inputs& inputs, const DeviceBuffer& buffer, const std::vector<T>& values) {
    const std::size_t bytes = values.size() * sizeof(T);
    if (bytes == 0) return;
    inputs.uploaded = session_.timeline.upload(buffer.cl(), values.data(), bytes, inputs.read);
    inputs.toAwait = true;
    uploadedBytes_ += bytes;
}

void PatchStream::gather(Inputs& inputs, std::uint32_t chunk) {
    inputs.holds = noChunk;
    source_.gather(firstOf(chunk), endOf(chunk), inputs.chunk);
    PatchSet& set = inputs.patches;
    setCounts(set, inputs.chunk);
    set.streamed = chunks_ > 1;
    send(inputs, set.points, inputs.chunk.floats);
    send(inputs, set.placed, inputs.chunk.placed);
    send(inputs, set.records, inputs.chunk.records);
    inputs.holds = chunk;
}

void PatchStream::sendObjects(Inputs& inputs) {
    pick(placed_, inputs.chunk.objects, inputs.objects);
    send(inputs, inputs.patches.objects, inputs.objects);
    if (!dicing_.empty()) {
        pick(dicing_, inputs.chunk.objects, inputs.dicingObjects);
        send(inputs, inputs.patches.dicingObjects, inputs.dicingObjects);
    }
    inputs.objectsOf = frame_;
}

// Has the chunk and the frame's objects uploaded.
void PatchStream::provide(Inputs& inputs, std::uint32_t chunk) {
    const bool here = inputs.holds == chunk;
    if (here && inputs.objectsOf == frame_) return;
    awaitStaging(inputs);
    try {
        if (!here) gather(inputs, chunk);
        sendObjects(inputs);
    } catch (...) {
        // What has been started may still read what the next upload will write.
        inputs.holds = noChunk;
        release();
        throw;
    }
}

void PatchStream::place(const Inputs& inputs, const frame_params& frame, Placing placing) {
    const PatchSet& set = inputs.patches;
    if (!dicing_.empty() && placing == Placing::toSplit) enqueuePlace(session_, frame, set, set.dicingObjects.cl(), set.dicingPoints.cl());
    enqueuePlace(session_, frame, set, set.objects.cl(), set.eyePoints.cl(), placing == Placing::toSplit && frame.feed_boxes != 0);
}

const PatchSet& PatchStream::use(std::uint32_t chunk, frame_params& frame, Placing placing) {
    const std::size_t chosen = inputsFor(chunk);
    if (chosen != current_ && inputs_[current_].holds != noChunk) inputs_[current_].read = session_.timeline.mark();
    Inputs& inputs = inputs_[chosen];
    provide(inputs, chunk);
    current_ = chosen;
    const PatchSet& set = inputs.patches;
    setPatches(frame, set);
    if (inputs.toAwait) {
        session_.timeline.await(inputs.uploaded);
        inputs.toAwait = false;
    }
    const bool lacks = placing == Placing::toSplit && placedFor_ == Placing::toShade;
    if (placedChunk_ != chunk || lacks) {
        place(inputs, frame, placing);
        placedFor_ = placing;
    }
    placedChunk_ = chunk;
    return set;
}

void PatchStream::prefetch(std::uint32_t chunk) {
    if (chunks_ == 1 || chunk >= chunks_) return;
    provide(inputs_[inputsFor(chunk)], chunk);
}

}  // namespace tessera
