// Chunks on the device: in any order, with and without prefetching, they are placed to the bits of the scene placed as a whole.
#include "chunk_scenes.h"

#include "surface/patch_stream.h"

#include "tessera/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <span>
#include <thread>
#include <utility>

namespace tessera::chunks {
namespace {

// A placed patch as kernels find it: its net and its records' curves, to the bit.
struct EyePatch {
    std::vector<std::uint32_t> net;
    std::vector<std::uint32_t> records;
    std::uint32_t object = 0;  // index into Scene::objects
    std::uint32_t index = 0;
    std::uint32_t flags = 0;

    [[nodiscard]] bool operator==(const EyePatch&) const = default;
};

constexpr std::uint32_t eyeFloats[4] = {BEZIER_FLOATS, GREGORY_FLOATS, RATIONAL_FLOATS, PN_FLOATS};

std::vector<std::uint32_t> some(const std::vector<std::uint32_t>& all, std::size_t first, std::size_t count) {
    return {all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(first + count)};
}

// What the device holds of a set, copied there in the order of the main queue's commands: nothing waits until it is read.
class Snapshot {
public:
    Snapshot(PlaceRig& rig, const PatchSet& set, const DeviceBuffer& points)
        : set_(set),
          points_(kept(rig, points, set.eyeBytes())),
          placed_(kept(rig, set.placed, set.patches * sizeof(placed_patch))),
          objects_(kept(rig, set.objects, set.objects.bytes() / sizeof(placed_object) * sizeof(placed_object))) {}

    [[nodiscard]] std::vector<EyePatch> read(PlaceRig& rig) const {
        const auto points = rig.read<std::uint32_t>(points_, set_.eyeBytes() / sizeof(float));
        const auto placed = rig.read<placed_patch>(placed_, set_.patches);
        const auto objects = rig.read<placed_object>(objects_, set_.objects.bytes() / sizeof(placed_object));
        const std::array<std::uint32_t, 4> ends{set_.bezierPatches, set_.gregoryEnd, set_.rationalEnd, set_.patches};
        const std::size_t firstCurve = points.size() - std::size_t{set_.recordCount} * RECORD_FLOATS;
        std::vector<EyePatch> patches;
        std::size_t net = 0, kind = 0;
        for (std::uint32_t k = 0; k < set_.patches; ++k) {
            while (k >= ends[kind]) ++kind;
            const std::uint32_t behind = k + 1 < set_.patches ? placed[k + 1].first_record : set_.recordCount;
            patches.push_back({some(points, net, eyeFloats[kind]),
                               some(points, firstCurve + placed[k].first_record * std::size_t{RECORD_FLOATS},
                                    (behind - placed[k].first_record) * std::size_t{RECORD_FLOATS}),
                               objects.at(placed[k].object).id, placed[k].index_in_mesh, placed[k].flags});
            net += eyeFloats[kind];
        }
        return patches;
    }

private:
    static DeviceBuffer kept(PlaceRig& rig, const DeviceBuffer& from, std::uint64_t bytes) {
        DeviceBuffer to = rig.session.memory.allocate(Purpose::scene, "a copy", bytes);
        if (bytes > 0) rig.session.timeline.copy(from.cl(), to.cl(), bytes);
        return to;
    }

    PatchSet set_;
    DeviceBuffer points_;
    DeviceBuffer placed_;
    DeviceBuffer objects_;
};

class PatchStreamTest : public ::testing::Test {
protected:
    [[nodiscard]] std::vector<EyePatch> resident(const std::vector<placed_object>& objects) {
        frame_params frame = frameFor(camera_, smallPicture());
        const PatchSet set = rig_.place(scene_, objects, frame);
        return Snapshot(rig_, set, set.eyePoints).read(rig_);
    }
    [[nodiscard]] std::vector<placed_object> objectsFrom(const Camera& camera) const { return placeObjects(scene_, eyeFromWorld(camera)); }

    // What use() gives for chunks in an order; before each, `ahead` (when given) is asked to be prefetched after the one before it.
    void expectChunks(PatchStream& stream, const std::vector<std::uint32_t>& order, const std::vector<std::uint32_t>& ahead,
                      const std::vector<EyePatch>& expected) {
        frame_params frame = frameFor(camera_, smallPicture());
        std::vector<std::pair<std::uint32_t, Snapshot>> seen;
        for (std::size_t k = 0; k < order.size(); ++k) {
            const PatchSet& set = stream.use(order[k], frame);
            EXPECT_EQ(frame.patches, set.patches);
            EXPECT_EQ(frame.first_patch, set.first);
            seen.emplace_back(set.first, Snapshot(rig_, set, set.eyePoints));
            if (k < ahead.size()) stream.prefetch(ahead[k]);
        }
        for (const auto& [first, snapshot] : seen) {
            const std::vector<EyePatch> patches = snapshot.read(rig_);
            ASSERT_LE(first + patches.size(), expected.size());
            ASSERT_TRUE(std::equal(patches.begin(), patches.end(), expected.begin() + first)) << "chunk from patch " << first;
        }
    }

    PlaceRig rig_;
    Scene scene_ = sceneOfEveryKind(11);
    PatchSource source_{scene_};
    Camera camera_ = reference::cameraAt({3, 4, 12}, {0, 0, 0}, 45);
    Camera other_ = reference::cameraAt({-8, 1, 2}, {0, 0, 0}, 30);
};

std::vector<std::uint32_t> forward(std::uint32_t chunks, int times) {
    std::vector<std::uint32_t> order;
    for (int time = 0; time < times; ++time)
        for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) order.push_back(chunk);
    return order;
}

std::vector<std::uint32_t> nextOf(const std::vector<std::uint32_t>& order) { return {order.begin() + 1, order.end()}; }

TEST_F(PatchStreamTest, ChunksOfAnySizeArePlacedToTheBitsOfTheWhole) {
    const std::vector<placed_object> objects = objectsFrom(camera_);
    const std::vector<EyePatch> expected = resident(objects);
    PatchStream stream(rig_.session);
    stream.setSource(source_);
    for (const std::uint32_t each : {7U, 64U, 301U, 600U, 5000U}) {
        stream.reserve(each, false);
        stream.beginFrame(objects, {});
        const std::vector<std::uint32_t> order = forward(stream.chunks(), 1);
        ASSERT_EQ(order.size(), (source_.patches() + each - 1) / each);
        ASSERT_NO_FATAL_FAILURE(expectChunks(stream, order, {}, expected)) << each << " patches a chunk";
    }
}

// As a frame of three buckets asks for them: forward and again; backward; and with hints that come true or not.
TEST_F(PatchStreamTest, AnyOrderAndAnyHintsGiveTheSameChunks) {
    const std::vector<placed_object> objects = objectsFrom(camera_);
    const std::vector<EyePatch> expected = resident(objects);
    PatchStream stream(rig_.session);
    stream.setSource(source_);
    Random random(12);
    for (const std::uint32_t each : {50U, 400U, 600U}) {
        stream.reserve(each, false);
        std::vector<std::uint32_t> order = forward(stream.chunks(), 3), anyhow;
        for (int k = 0; k < 30; ++k) anyhow.push_back(static_cast<std::uint32_t>(random.between(0, stream.chunks())));
        for (int frame = 0; frame < 2; ++frame) {
            stream.beginFrame(objects, {});
            ASSERT_NO_FATAL_FAILURE(expectChunks(stream, order, nextOf(order), expected));
            ASSERT_NO_FATAL_FAILURE(expectChunks(stream, order, {}, expected));
            std::reverse(order.begin(), order.end());
            ASSERT_NO_FATAL_FAILURE(expectChunks(stream, order, nextOf(order), expected));
            ASSERT_NO_FATAL_FAILURE(expectChunks(stream, anyhow, nextOf(anyhow), expected));
            ASSERT_NO_FATAL_FAILURE(expectChunks(stream, anyhow, order, expected));
        }
    }
}

TEST_F(PatchStreamTest, FramesSeeTheirOwnObjects) {
    const std::vector<placed_object> first = objectsFrom(camera_), second = objectsFrom(other_);
    const std::vector<EyePatch> expectedFirst = resident(first), expectedSecond = resident(second);
    for (const std::uint32_t each : {5000U, 600U, 90U}) {
        PatchStream stream(rig_.session);
        stream.setSource(source_);
        stream.reserve(each, false);
        const std::vector<std::uint32_t> order = forward(stream.chunks(), 1);
        for (int time = 0; time < 2; ++time) {
            stream.beginFrame(first, {});
            ASSERT_NO_FATAL_FAILURE(expectChunks(stream, order, nextOf(order), expectedFirst));
            stream.beginFrame(second, {});
            ASSERT_NO_FATAL_FAILURE(expectChunks(stream, order, nextOf(order), expectedSecond));
        }
    }
}

TEST_F(PatchStreamTest, AResidentSceneIsUploadedOnceAndPlacedOnceAFrame) {
    const std::vector<placed_object> objects = objectsFrom(camera_);
    PatchStream stream(rig_.session);
    stream.setSource(source_);
    frame_params frame = frameFor(camera_, smallPicture());
    for (int time = 0; time < 3; ++time) {
        stream.reserve(source_.patches(), false);
        rig_.session.timeline.restart(true);
        stream.beginFrame(objects, {});
        for (int use = 0; use < 3; ++use) {
            const PatchSet& set = stream.use(0, frame);
            EXPECT_FALSE(set.streamed);
            EXPECT_EQ(set.patches, source_.patches());
        }
        rig_.session.timeline.finish();
        const std::uint64_t objectBytes = objects.size() * sizeof(placed_object);
        EXPECT_EQ(stream.uploadedBytes(), time == 0 ? source_.sizeOf(0, source_.patches()).inputBytes(false) : objectBytes);
        EXPECT_EQ(stream.waits(), 0U);
        const std::vector<TraceEvent> trace = rig_.session.timeline.trace();
        EXPECT_EQ(std::count_if(trace.begin(), trace.end(), [](const TraceEvent& event) { return event.name == "place_patches"; }), 1);
        EXPECT_EQ(std::count_if(trace.begin(), trace.end(), [](const TraceEvent& event) { return event.name == "upload"; }),
                  time == 0 ? 4 : 1);
    }
}

TEST_F(PatchStreamTest, TheDicingCameraHasPointsOfItsOwn) {
    const std::vector<placed_object> objects = objectsFrom(camera_), dicing = objectsFrom(other_);
    const std::vector<EyePatch> expected = resident(objects), expectedDicing = resident(dicing);
    PatchStream stream(rig_.session);
    stream.setSource(source_);
    frame_params frame = frameFor(camera_, smallPicture());
    for (const bool apart : {true, false, true}) {
        for (const std::uint32_t each : {200U, 5000U}) {
            stream.reserve(each, apart);
            stream.beginFrame(objects, apart ? std::span<const placed_object>(dicing) : std::span<const placed_object>());
            for (std::uint32_t chunk = 0; chunk < stream.chunks(); ++chunk) {
                const PatchSet& set = stream.use(chunk, frame);
                ASSERT_EQ(set.dicingPoints.cl()() == set.eyePoints.cl()(), !apart);
                const std::vector<EyePatch> eye = Snapshot(rig_, set, set.eyePoints).read(rig_);
                const std::vector<EyePatch> diced = Snapshot(rig_, set, set.dicingPoints).read(rig_);
                ASSERT_TRUE(std::equal(eye.begin(), eye.end(), expected.begin() + set.first));
                ASSERT_TRUE(std::equal(diced.begin(), diced.end(), (apart ? expectedDicing : expected).begin() + set.first));
            }
        }
    }
}

TEST_F(PatchStreamTest, ItTakesExactlyTheBytesThatItSays) {
    const std::uint64_t before = rig_.session.memory.bytes();
    PatchStream stream(rig_.session);
    stream.setSource(source_);
    for (const std::uint32_t each : {5000U, 1U, 33U, source_.patches() - 1, source_.patches(), 600U}) {
        for (const bool apart : {false, true, false}) {
            stream.reserve(each, apart);
            ASSERT_EQ(rig_.session.memory.bytes() - before, PatchStream::bytes(source_, each, apart)) << each << " patches a chunk";
            const ChunkSize size = source_.largest(each);
            EXPECT_LE(size.largestBuffer(), size.inputBytes(apart) + size.placedBytes(apart));
        }
    }
    stream.release();
    EXPECT_EQ(rig_.session.memory.bytes(), before);
}

TEST_F(PatchStreamTest, WithoutRoomItHoldsNothingAndMayTryAgain) {
    const std::vector<placed_object> objects = objectsFrom(camera_);
    const std::vector<EyePatch> expected = resident(objects);
    PatchStream stream(rig_.session);
    stream.setSource(source_);
    const std::uint64_t before = rig_.session.memory.bytes(), all = rig_.session.memory.budget();
    rig_.session.memory.setBudget(before + PatchStream::bytes(source_, 100, false));
    EXPECT_THROW(stream.reserve(400, false), Error);
    EXPECT_EQ(rig_.session.memory.bytes(), before);
    stream.reserve(100, false);
    rig_.session.memory.setBudget(all);
    stream.beginFrame(objects, {});
    const std::vector<std::uint32_t> order = forward(stream.chunks(), 1);
    expectChunks(stream, order, nextOf(order), expected);
}

// A prefetch that nobody comes for must not read what is gone; sanitizers tell.
TEST_F(PatchStreamTest, UploadsUnderWayEndBeforeTheirMemoryGoes) {
    const std::vector<placed_object> objects = objectsFrom(camera_);
    frame_params frame = frameFor(camera_, smallPicture());
    for (int time = 0; time < 20; ++time) {
        PatchStream stream(rig_.session);
        stream.setSource(source_);
        stream.reserve(500, false);
        stream.beginFrame(objects, {});
        EXPECT_GT(stream.use(0, frame).patches, 0U);
        stream.prefetch(1);
        if (time % 2 == 0) stream.setSource(source_);
    }
}

// Keeps what the main queue is given from here on from starting.
class Gate {
public:
    explicit Gate(DeviceSession& session) : event_(session.device.context) {
        const std::vector<cl::Event> before{event_};
        session.device.queue.enqueueBarrierWithWaitList(&before);
    }
    ~Gate() { open(); }
    Gate(const Gate&) = delete;
    Gate& operator=(const Gate&) = delete;
    void open() {
        if (!std::exchange(isOpen_, true)) clSetUserEventStatus(event_(), CL_COMPLETE);
    }

private:
    cl::UserEvent event_;
    bool isOpen_ = false;
};

// While the device does nothing at all, two chunks can be made ready behind the one that it is to draw. Were the host to wait, it would
// wait for ever.
TEST_F(PatchStreamTest, TheHostWaitsForNothingThatTheDeviceHasYetToDraw) {
    const std::vector<placed_object> objects = objectsFrom(camera_);
    PatchStream stream(rig_.session);
    stream.setSource(source_);
    stream.reserve(200, false);
    frame_params frame = frameFor(camera_, smallPicture());
    for (int time = 0; time < 2; ++time) {
        rig_.session.timeline.finish();
        Gate gate(rig_.session);
        stream.beginFrame(objects, {});
        EXPECT_EQ(stream.use(0, frame).first, 0U);
        stream.prefetch(1);
        EXPECT_EQ(stream.use(1, frame).first, 200U);
        EXPECT_EQ(stream.waits(), 0U);
        gate.open();
        rig_.session.timeline.finish();
        stream.prefetch(2);
        EXPECT_EQ(stream.waits(), 0U);
    }
}

// The device starts only after the host has come to need memory whose upload is still to be done.
TEST_F(PatchStreamTest, MemoryThatIsStillBeingUploadedIsNotWritten) {
    const std::vector<placed_object> objects = objectsFrom(camera_);
    const std::vector<EyePatch> expected = resident(objects);
    PatchStream stream(rig_.session);
    stream.setSource(source_);
    stream.reserve(60, false);
    rig_.session.timeline.finish();
    Gate gate(rig_.session);
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        gate.open();
    });
    stream.beginFrame(objects, {});
    const std::vector<std::uint32_t> order = forward(stream.chunks(), 1);
    expectChunks(stream, order, nextOf(order), expected);
    later.join();
}

TEST_F(PatchStreamTest, ASceneWithoutPatchesIsOneChunkOfNone) {
    PatchStream stream(rig_.session);
    stream.setSource(PatchSource());
    stream.reserve(1000, false);
    stream.beginFrame({}, {});
    frame_params frame = frameFor(camera_, smallPicture());
    frame.patches = 5;
    EXPECT_EQ(stream.chunks(), 1U);
    EXPECT_EQ(stream.use(0, frame).patches, 0U);
    EXPECT_EQ(frame.patches, 0U);
}

}  // namespace
}  // namespace tessera::chunks
