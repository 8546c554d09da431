// Scenes whose patches are on the device chunk by chunk: hidden, marked, shaded and filtered so, they give the picture of a frame whose
// patches are all there, to the bit.
#include "closed_models.h"
#include "frames.h"
#include "picture_scenes.h"

#include "film/film.h"
#include "film/picture_shared.h"
#include "render/frame_setup.h"
#include "render/plan_memory.h"
#include "render/split_loop.h"
#include "shade/shade.h"
#include "surface/patch_set.h"
#include "tessera/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tessera::test {
namespace {

constexpr std::uint32_t allPatches = 0xffffffffU;

// Adds every kind of patch, and edge records.
void addSolid(Scene& scene) {
    Scene solid = placedAnyhow(mixedSolid(10, 2, {PatchKind::bezier, PatchKind::gregory, PatchKind::rational, PatchKind::pn}), 11);
    weld(solid);
    for (Mesh& mesh : solid.meshes) mesh.name = "solid " + mesh.name;
    for (Object& object : solid.objects) {
        object.mesh = "solid " + object.mesh;
        object.transform.translation = {0.4F, 0.3F, 1.5F};
        object.color = {0.7F, 0.5F, 0.4F};
    }
    scene.meshes.insert(scene.meshes.end(), solid.meshes.begin(), solid.meshes.end());
    scene.objects.insert(scene.objects.end(), solid.objects.begin(), solid.objects.end());
}

// Several objects of all kinds that the mode draws, the last of them behind the camera.
Scene sceneFor(DiceMode mode) {
    Scene scene = mixedScene();
    if (mode == DiceMode::watertight) addSolid(scene);
    Object behind = scene.objects.front();
    behind.transform.translation = {0.0F, 0.0F, 100.0F};
    scene.objects.push_back(behind);
    return scene;
}

struct Case {
    int lanes;
    DiceMode mode;
};

RenderOptions optionsFor(DiceMode mode, int pixelSamples, Aov aovs) {
    RenderOptions options = pictureOptions(101, 67, pixelSamples);
    options.mode = mode;
    options.aovs = aovs;
    options.method = SplitMethod::cpu;
    options.batch = 200;
    options.background = {0.1F, 0.2F, 0.3F, 0.5F};
    return options;
}

std::filesystem::path cacheFolder() {
    return std::getenv("TESSERA_CACHE") == nullptr ? std::filesystem::path(TESSERA_TEST_CACHE) : defaultCacheFolder();
}

// The stations of a frame without the renderer: patches in chunks, the film, and a picture.
class Rig {
public:
    Rig(const Scene& scene, int lanes) : session_(-1, kernelSources(), cacheFolder(), lanes), queues_(session_), film_(session_) {
        const glm::dmat4 view = eyeFromWorld(scene.cameras.front());
        camera_ = scene.cameras.front();
        objects_ = placeObjects(scene, view);
        lights_ = placeLights(scene, view, false);
        whole_ = uploadPatches(scene, session_.memory, session_.timeline);
        whole_.objects = uploaded(objects_);
        placed_ = downloaded<placed_patch>(whole_.placed, whole_.patches);
        lightBuffer_ = uploaded(lights_);
    }

    // Sets the frame up and hides and resolves all of the scene, in chunks of n patches.
    void hide(const RenderOptions& options, std::uint32_t n) {
        const FilmLayout layout = layOutFilm(options);
        film_.prepare(layout, {contains(options.aovs, Aov::normal), false});
        samples_ = layout.samples;
        tiles_ = static_cast<std::size_t>(layout.tiles);
        frame_ = setUpFrame(camera_, options, layout, false);
        setPatches(frame_, whole_);
        frame_.occlusion = 0;
        frame_.lights = static_cast<uint>(lights_.size());
        layOut(options.aovs, static_cast<std::uint32_t>(layout.width * layout.height));
        enqueuePlace(session_, frame_, whole_, whole_.objects.cl(), whole_.eyePoints.cl());
        eyePoints_ = downloaded<float>(whole_.eyePoints, whole_.eyeBytes() / sizeof(float));
        queues_.setMode(options.mode);
        const QueueRoom room = queueRoom(options, options.batch, session_.device.info);
        queues_.reserve(room.limits, room.stack);
        queues_.restart();
        for (std::uint32_t first = 0; first < whole_.patches; first += std::min(n, whole_.patches - first)) {
            frame_params frame;
            const PatchSet chunk = use(first, n, frame);
            static_cast<void>(
                runCpu({session_, queues_, film_, frame, chunk, options, {options.batch, options.batch, options.batch}, {}, {}, {}}));
        }
    }

    // The chunks of n patches that are seen.
    std::vector<std::uint32_t> seen(std::uint32_t n) {
        const std::uint32_t chunks = (whole_.patches - 1) / n + 1;
        const DeviceBuffer flags = uploaded(std::vector<std::uint32_t>(chunks, 7));
        enqueueMarkChunks(session_, frame_, film_, n, chunks, flags.cl());
        return downloaded<std::uint32_t>(flags, chunks);
    }
    // The same from the film on the host.
    std::vector<std::uint32_t> seenOnHost(std::uint32_t n) {
        std::vector<std::uint32_t> flags((whole_.patches - 1) / n + 1);
        const std::vector<std::uint64_t> keys = film();
        std::vector<std::uint32_t> references(keys.size());
        session_.timeline.read(film_.referencePatch(), references.data(), references.size() * 4);
        for (std::size_t k = 0; k < keys.size(); ++k)
            if (keys[k] != ~std::uint64_t{0}) flags.at(references[k] / n) = 1;
        return flags;
    }

    // Shades at once, of a film that is resolved, as if the split stage had left `state`.
    std::vector<float> shade(const split_state& state) {
        queues_.writeState(state);
        const DeviceBuffer picture = emptyPicture();
        enqueueShade(session_, frame_, planes_, {whole_, lightBuffer_.cl(), queues_}, film_, picture.cl());
        return downloaded<float>(picture, floats_);
    }
    [[nodiscard]] split_state drawn() const {
        split_state state{};
        state.next_input = frame_.patches;
        state.feed_count = frame_.patches;
        return state;
    }

    // Shades in chunks of n patches, those that are seen, the last one first.
    std::vector<float> shadeChunks(std::uint32_t n) {
        queues_.writeState({});
        const std::vector<std::uint32_t> flags = seen(n);
        const DeviceBuffer picture = emptyPicture();
        for (std::size_t k = flags.size(); k-- > 0;) {
            if (flags[k] == 0) continue;
            frame_params frame;
            const PatchSet chunk = use(static_cast<std::uint32_t>(k) * n, n, frame);
            enqueueShadeChunk(session_, frame, planes_, {chunk, lightBuffer_.cl(), queues_}, film_, picture.cl());
            session_.timeline.finish();
        }
        enqueueFilter(session_, frame_, planes_, queues_, film_, picture.cl());
        return downloaded<float>(picture, floats_);
    }

    std::vector<std::uint64_t> film() {
        std::vector<std::uint64_t> keys(samples_);
        session_.timeline.read(film_.samples(), keys.data(), keys.size() * sizeof(std::uint64_t));
        return keys;
    }
    bool filmIsEmpty() {
        const std::vector<std::uint64_t> keys = film();
        std::vector<unsigned char> touched(tiles_);
        session_.timeline.read(film_.touched(), touched.data(), touched.size());
        return std::all_of(keys.begin(), keys.end(), [](std::uint64_t key) { return key == ~std::uint64_t{0}; }) &&
               std::all_of(touched.begin(), touched.end(), [](unsigned char tile) { return tile == 0; });
    }
    std::uint64_t pixelsCovered() { return queues_.readState().pixels_covered; }
    [[nodiscard]] const PatchSet& patches() const { return whole_; }

private:
    template <typename T>
    DeviceBuffer uploaded(const std::vector<T>& values) {
        DeviceBuffer buffer = session_.memory.allocate(Purpose::scene, "a test's values", values.size() * sizeof(T));
        if (!values.empty()) session_.timeline.write(buffer.cl(), values.data(), values.size() * sizeof(T));
        return buffer;
    }
    template <typename T>
    std::vector<T> downloaded(const DeviceBuffer& buffer, std::size_t count) {
        std::vector<T> values(count);
        session_.timeline.read(buffer.cl(), values.data(), count * sizeof(T));
        return values;
    }
    // What no kernel writes is seen as such.
    DeviceBuffer emptyPicture() { return uploaded(std::vector<float>(floats_, -12345.0F)); }

    // As PictureLayout of the renderer.
    void layOut(Aov aovs, std::uint32_t pixels) {
        planes_ = {NO_PLANE, NO_PLANE, NO_PLANE, NO_PLANE, NO_PLANE};
        floats_ = 4 * pixels;
        const auto add = [&](Aov aov, uint& place, std::uint32_t channels) {
            if (!contains(aovs, aov)) return;
            place = floats_;
            floats_ += channels * pixels;
        };
        add(Aov::z, planes_.z, 1);
        add(Aov::normal, planes_.normal, 3);
        add(Aov::object, planes_.object, 1);
        add(Aov::patch, planes_.patch_id, 1);
        add(Aov::uv, planes_.uv, 2);
    }

    // A chunk as a stream leaves it on the device, and its frame: indices are its own, and objects stand in another order than in the
    // scene.
    PatchSet use(std::uint32_t first, std::uint32_t n, frame_params& frame) {
        const std::uint32_t end = first + std::min(n, whole_.patches - first);
        const auto within = [&](std::uint32_t index) { return std::clamp(index, first, end) - first; };
        PatchSet chunk = whole_;
        chunk.first = first;
        chunk.patches = end - first;
        chunk.bezierPatches = within(whole_.bezierPatches);
        chunk.gregoryEnd = within(whole_.gregoryEnd);
        chunk.rationalEnd = within(whole_.rationalEnd);
        chunk.streamed = true;
        std::vector<placed_patch> placed(placed_.begin() + first, placed_.begin() + end);
        for (placed_patch& patch : placed) patch.object = static_cast<uint>(objects_.size()) - 1 - patch.object;
        chunk.placed = uploaded(placed);
        chunk.objects = uploaded(std::vector<placed_object>(objects_.rbegin(), objects_.rend()));
        // Its nets, and all records' curves behind them.
        std::vector<float> points(eyePoints_.begin() + netOf(first), eyePoints_.begin() + netOf(end));
        points.insert(points.end(), eyePoints_.begin() + netOf(whole_.patches), eyePoints_.end());
        chunk.eyePoints = uploaded(points);
        frame = frame_;
        frame.first_patch = first;
        frame.streamed = 1;
        frame.patches = chunk.patches;
        frame.bezier_patches = chunk.bezierPatches;
        frame.gregory_end = chunk.gregoryEnd;
        frame.rational_end = chunk.rationalEnd;
        return chunk;
    }
    // Where a patch's net begins among the eye points.
    [[nodiscard]] std::ptrdiff_t netOf(std::uint32_t patch) const {
        PatchSet before = whole_;
        before.bezierPatches = std::min(patch, whole_.bezierPatches);
        before.gregoryEnd = std::min(patch, whole_.gregoryEnd);
        before.rationalEnd = std::min(patch, whole_.rationalEnd);
        before.patches = patch;
        before.recordCount = 0;
        return static_cast<std::ptrdiff_t>(before.eyeBytes() / sizeof(float));
    }

    DeviceSession session_;
    SplitQueues queues_;
    Film film_;
    Camera camera_;
    PatchSet whole_;
    DeviceBuffer lightBuffer_;
    std::vector<placed_object> objects_;
    std::vector<eye_light> lights_;
    std::vector<placed_patch> placed_;
    std::vector<float> eyePoints_;
    frame_params frame_{};
    picture_planes planes_{};
    std::uint32_t floats_ = 0;
    std::size_t samples_ = 0;
    std::size_t tiles_ = 0;
};

// All planes behind each other, as they stand in the picture's buffer.
std::vector<float> valuesOf(const Frame& frame) {
    std::vector<float> values;
    for (const Plane& plane : frame.planes) values.insert(values.end(), plane.values.begin(), plane.values.end());
    return values;
}

// How many floats differ to the bit.
std::size_t differences(const std::vector<float>& a, const std::vector<float>& b) {
    if (a.size() != b.size()) return std::max(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t k = 0; k < a.size(); ++k) count += std::bit_cast<std::uint32_t>(a[k]) == std::bit_cast<std::uint32_t>(b[k]) ? 0U : 1U;
    return count;
}

class ShadeChunk : public ::testing::TestWithParam<Case> {
protected:
    ShadeChunk() : scene_(sceneFor(GetParam().mode)), rig_(scene_, GetParam().lanes), renderer_(settings()) { renderer_.setScene(scene_); }

    static RendererSettings settings() {
        RendererSettings settings = testSettings();
        settings.lanes = GetParam().lanes;
        return settings;
    }
    [[nodiscard]] RenderOptions options(int pixelSamples, Aov aovs = allPlanes) const {
        return optionsFor(GetParam().mode, pixelSamples, aovs);
    }

    Scene scene_;
    Rig rig_;
    Renderer renderer_;
};

TEST_P(ShadeChunk, AnyChunksGiveThePictureOfTheWhole) {
    for (const int pixelSamples : {1, 3, 4}) {
        const Frame frame = renderer_.render(scene_.cameras.front(), options(pixelSamples));
        const std::vector<float> whole = valuesOf(frame);
        for (const std::uint32_t n : {1U, 7U, allPatches}) {
            SCOPED_TRACE(std::to_string(pixelSamples) + " samples, chunks of " + std::to_string(n));
            rig_.hide(options(pixelSamples), n);
            EXPECT_EQ(differences(rig_.shadeChunks(n), whole), 0U);
            EXPECT_EQ(rig_.pixelsCovered(), frame.statistics.pixelsCovered);
            EXPECT_TRUE(rig_.filmIsEmpty());
        }
    }
}

TEST_P(ShadeChunk, ABoundedFrameWhoseLastBatchIsNotResolvedGivesTheSamePicture) {
    RenderOptions bounded = options(4);
    bounded.method = SplitMethod::bounded;
    const std::vector<float> whole = valuesOf(renderer_.render(scene_.cameras.front(), bounded));
    rig_.hide(options(4), 7);
    EXPECT_EQ(differences(rig_.shadeChunks(7), whole), 0U);
}

TEST_P(ShadeChunk, PlanesThatAreNotWantedTakeNothing) {
    const std::vector<float> whole = valuesOf(renderer_.render(scene_.cameras.front(), options(4, Aov::none)));
    rig_.hide(options(4, Aov::none), 7);
    EXPECT_EQ(differences(rig_.shadeChunks(7), whole), 0U);
}

TEST_P(ShadeChunk, MarksTheChunksThatAreSeenAndNoOthers) {
    rig_.hide(options(3), 7);
    for (const std::uint32_t n : {1U, 7U, allPatches}) EXPECT_EQ(rig_.seen(n), rig_.seenOnHost(n)) << "chunks of " << n;
    // All kinds are seen, but not all patches.
    const std::vector<std::uint32_t> flags = rig_.seen(1);
    const PatchSet& patches = rig_.patches();
    const auto any = [&](std::uint32_t first, std::uint32_t end) {
        return first == end || std::any_of(flags.begin() + first, flags.begin() + end, [](std::uint32_t flag) { return flag != 0; });
    };
    EXPECT_TRUE(any(0, patches.bezierPatches));
    EXPECT_TRUE(any(patches.bezierPatches, patches.gregoryEnd));
    EXPECT_TRUE(any(patches.gregoryEnd, patches.rationalEnd));
    EXPECT_TRUE(any(patches.rationalEnd, patches.patches));
    EXPECT_GT(std::count(flags.begin(), flags.end(), 0U), 0);
}

TEST_P(ShadeChunk, AFrameNotDrawnToItsEndIsNotShaded) {
    const std::vector<float> whole = valuesOf(renderer_.render(scene_.cameras.front(), options(3)));
    rig_.hide(options(3), allPatches);
    const std::vector<std::uint64_t> film = rig_.film();
    split_state left = rig_.drawn();
    left.stack_count = 1;
    split_state unfed = rig_.drawn();
    unfed.feed_count += 1;
    split_state unhidden = rig_.drawn();
    unhidden.ready_count = 3;
    unhidden.hidden = 2;
    for (const split_state& state : {left, unfed, unhidden}) {
        const std::vector<float> picture = rig_.shade(state);
        EXPECT_TRUE(std::all_of(picture.begin(), picture.end(), [](float value) { return value == -12345.0F; }));
        EXPECT_EQ(rig_.film(), film);
    }
    EXPECT_EQ(differences(rig_.shade(rig_.drawn()), whole), 0U);
    EXPECT_TRUE(rig_.filmIsEmpty());
}

std::string caseName(const ::testing::TestParamInfo<Case>& info) {
    return std::string(name(info.param.mode)) + std::to_string(info.param.lanes);
}

INSTANTIATE_TEST_SUITE_P(Lanes, ShadeChunk,
                         ::testing::Values(Case{16, DiceMode::watertight}, Case{1, DiceMode::watertight}, Case{8, DiceMode::watertight},
                                           Case{16, DiceMode::classical}, Case{1, DiceMode::classical}),
                         caseName);

}  // namespace
}  // namespace tessera::test
