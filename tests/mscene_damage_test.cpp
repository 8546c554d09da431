// Damaged .mscene files: every damage is a one-line Error that names file and item, or leaves a valid scene.
#include "formats/mscene.h"
#include "mscene_samples.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace tessera {
namespace {

struct Damage {
    const char* name;
    std::function<void(Scene&)> apply;
    std::vector<std::string> said;
};

TEST(MsceneDamage, DamagedScenesAreErrorsThatNameFileAndItem) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::vector<Damage> damages{
        {"nan", [=](Scene& s) { s.meshes[1].points[25].x = nan; }, {"mesh 'greg'", "patch 1", "point 5"}},
        {"infinity", [=](Scene& s) { s.meshes[0].points[3].z = infinity; }, {"mesh 'plate'", "patch 0", "point 3"}},
        {"list size", [](Scene& s) { s.meshes[0].points.pop_back(); }, {"mesh 'plate'", "45 numbers", "48"}},
        {"one kind for another", [](Scene& s) { s.meshes[0].kind = PatchKind::gregory; }, {"mesh 'plate'", "48 numbers", "60"}},
        {"no weight", [](Scene& s) { s.meshes[2].weights[20] = 0.0F; }, {"mesh 'ratio'", "patch 1", "point 4", "weight"}},
        {"weight below 0", [](Scene& s) { s.meshes[2].weights[15] = -1.0F; }, {"mesh 'ratio'", "patch 0", "point 15", "weight"}},
        {"nan weight", [=](Scene& s) { s.meshes[2].weights[31] = nan; }, {"mesh 'ratio'", "patch 1", "point 15", "weight"}},
        {"infinite weight", [=](Scene& s) { s.meshes[2].weights[0] = infinity; }, {"mesh 'ratio'", "patch 0", "point 0", "weight"}},
        {"weights too few", [](Scene& s) { s.meshes[2].weights.pop_back(); }, {"mesh 'ratio'", "31 weights", "32 control points"}},
        {"weights left out", [](Scene& s) { s.meshes[2].weights.clear(); }, {"mesh 'ratio'", "0 weights"}},
        {"weights of others", [](Scene& s) { s.meshes[0].weights.assign(16, 1.0F); }, {"mesh 'plate'", "weights", "bezier"}},
        {"weights of pn", [](Scene& s) { s.meshes[3].weights.assign(16, 1.0F); }, {"mesh 'tri'", "weights", "pn"}},
        {"nan normal", [=](Scene& s) { s.meshes[3].points[12].y = nan; }, {"mesh 'tri'", "patch 0", "point 12"}},
        {"half a triangle", [](Scene& s) { s.meshes[3].points.resize(10); }, {"mesh 'tri'", "30 numbers", "48"}},
        {"unknown mesh", [](Scene& s) { s.objects[0].mesh = "nowhere"; }, {"object 'a'", "'nowhere'"}},
        {"twin mesh", [](Scene& s) { s.meshes[1].name = "plate"; }, {"mesh 'plate'", "twice"}},
        {"object's name", [](Scene& s) { s.objects[1].name = "b\xFF"; }, {"object number 1", "UTF-8"}},
        {"mesh's name", [](Scene& s) { s.meshes[1].name = "\xC0\x80"; }, {"mesh number 1", "UTF-8"}},
        {"mesh name asked for", [](Scene& s) { s.objects[0].mesh = "\xED\xA0\x80"; }, {"object 'a'", "UTF-8"}},
        {"zero byte in a name", [](Scene& s) { s.cameras[0].name = std::string("a\0b", 3); }, {"camera number 0", "UTF-8"}},
        {"zero rotation", [](Scene& s) { s.objects[1].transform.rotation = glm::quat(0, 0, 0, 0); }, {"object 'b'", "zero length"}},
        {"light's rotation", [=](Scene& s) { s.lights[0].transform.rotation.y = nan; }, {"light 'sun'", "rotation"}},
        {"light's intensity", [=](Scene& s) { s.lights[0].intensity = infinity; }, {"light 'sun'", "intensity"}},
        {"camera's near", [](Scene& s) { s.cameras[0].near = -1.0F; }, {"camera 'front'", "near", "-1"}},
        {"camera's angle", [=](Scene& s) { s.cameras[0].fovy = nan; }, {"camera 'front'", "field of view"}},
        {"roughness", [](Scene& s) { s.objects[0].material.roughness = -0.5F; }, {"object 'a'", "roughness -0.5"}},
    };
    for (const Damage& damage : damages) {
        Scene scene = richScene();
        damage.apply(scene);
        const std::string message = complaint(serializeMscene(scene));
        EXPECT_EQ(message.rfind("file: ", 0), 0U) << damage.name << ": " << message;
        EXPECT_FALSE(contains(message, "\n")) << damage.name;
        for (const std::string& part : damage.said) EXPECT_TRUE(contains(message, part)) << damage.name << ": " << message;
    }
}

TEST(MsceneDamage, EveryTruncationIsAnErrorInOneLine) {
    for (const Scene& scene : {richScene(), plainScene()}) {
        const Bytes whole = serializeMscene(scene);
        for (std::size_t length = 0; length < whole.size(); ++length) {
            const std::string message = complaint(std::span(whole).first(length));
            EXPECT_EQ(message.rfind("file: ", 0), 0U) << length << " of " << whole.size();
            EXPECT_FALSE(contains(message, "\n")) << message;
        }
    }
}

// Calls `damage` on a fresh copy of a scene's bytes again and again: an Error or a scene, nothing else, may come of it.
void damageOften(const std::function<void(Bytes&, std::mt19937&)>& damage) {
    int refused = 0;
    constexpr int kRuns = 4000;
    const std::vector<Bytes> originals{serializeMscene(richScene()), serializeMscene(plainScene())};
    for (unsigned seed = 0; seed < kRuns; ++seed) {
        std::mt19937 random(seed);
        Bytes bytes = originals[seed % originals.size()];
        damage(bytes, random);
        std::vector<std::string> warnings;
        const std::string message = complaint(bytes, &warnings);
        refused += message.empty() ? 0 : 1;
        EXPECT_FALSE(contains(message, "\n")) << "seed " << seed << ": " << message;
        EXPECT_LE(warnings.size(), 51U) << "seed " << seed;
    }
    EXPECT_GT(refused, kRuns / 20);
}

std::size_t below(std::mt19937& random, std::size_t limit) { return random() % limit; }

TEST(MsceneDamage, FlippedBytesGiveAnErrorOrAScene) {
    damageOften([](Bytes& bytes, std::mt19937& random) {
        for (std::size_t n = 1 + below(random, 4); n > 0; --n) bytes[below(random, bytes.size())] ^= std::byte(1 + below(random, 255));
    });
}

TEST(MsceneDamage, MovedBytesGiveAnErrorOrAScene) {
    damageOften([](Bytes& bytes, std::mt19937& random) {
        const auto at = [&] { return bytes.begin() + static_cast<std::ptrdiff_t>(below(random, bytes.size())); };
        if (random() % 2 == 0) {
            bytes.insert(at(), std::byte(random() & 255U));
        } else {
            bytes.erase(at());
        }
    });
}

TEST(MsceneDamage, RandomBytesAreErrors) {
    for (unsigned seed = 0; seed < 2000; ++seed) {
        std::mt19937 random(seed);
        Bytes bytes(1 + below(random, 500));
        for (std::byte& one : bytes) one = std::byte(random() & 255U);
        EXPECT_NE(complaint(bytes), "") << "seed " << seed;
    }
}

TEST(MsceneDamage, PackedZerosAreRefusedNotUnpacked) {
    // A run of 256 zero words takes two bytes: 58 KB would become 60 MB.
    Bytes bomb;
    for (int i = 0; i < 29000; ++i) {
        bomb.push_back(std::byte{0x00});
        bomb.push_back(std::byte{0xFF});
    }
    const std::string message = complaint(bomb);
    EXPECT_TRUE(contains(message, "unpacks to 59392000 bytes")) << message;
}

TEST(MsceneDamage, SegmentsLargerThanTheFileAreRefused) {
    // One segment that claims 0x3fffffff words.
    const Bytes claim{std::byte{0xF0}, std::byte{0xFF}, std::byte{0xFF}, std::byte{0xFF}, std::byte{0x3F}};
    EXPECT_NE(complaint(claim), "");
}

// Calls `change` with every position in the bytes of richScene(), each time on a fresh copy, and gathers all that is said.
std::string saidOfAll(std::size_t width, const std::function<void(Bytes&, std::size_t)>& change) {
    const Bytes whole = serializeMscene(richScene());
    std::string said;
    for (std::size_t at = 0; at + width <= whole.size(); ++at) {
        Bytes bytes = whole;
        change(bytes, at);
        std::vector<std::string> warnings;
        said += complaint(bytes, &warnings) + "\n";
        for (const std::string& warning : warnings) said += warning + "\n";
    }
    return said;
}

TEST(MsceneDamage, KindsThatDoNotExistAreErrors) {
    const std::string said = saidOfAll(1, [](Bytes& bytes, std::size_t at) { bytes[at] = std::byte{9}; });
    for (const std::string part : {"mesh 'greg': unknown type 9", "light 'sun': unknown type 9", "object 'a': unknown material 9"}) {
        EXPECT_TRUE(contains(said, "file: " + part)) << part;
    }
}

TEST(MsceneDamage, WhatIsLeftOutIsTakenAsUsualAndTold) {
    // Two bytes of a pointer are what makes it one: without them it is null.
    const std::string said = saidOfAll(2, [](Bytes& bytes, std::size_t at) { bytes[at] = bytes[at + 1] = std::byte{0}; });
    for (const std::string part : {"object 'a' has no colour: white is taken", "light 'sun' has no colour", "object 'b' has no rotation",
                                   "camera 'front' has no place"}) {
        EXPECT_TRUE(contains(said, "file: " + part)) << part;
    }
}

TEST(MsceneDamage, ListsOfEmptyItemsAreRefused) {
    // A segment of six words: the root with four lists, of which the lights are 100000 structs of no size at all.
    const std::array<std::uint64_t, 7> words{std::uint64_t{6} << 32U,    std::uint64_t{4} << 48U, 0, (std::uint64_t{7} << 32U) | 9U, 0, 0,
                                             std::uint64_t{100000} << 2U};
    Bytes packed;
    for (const std::uint64_t word : words) {
        unsigned tag = 0;
        Bytes present;
        for (unsigned i = 0; i < 8; ++i) {
            const std::byte one{static_cast<std::uint8_t>(word >> (8U * i))};
            if (one == std::byte{0}) continue;
            tag |= 1U << i;
            present.push_back(one);
        }
        packed.push_back(std::byte{static_cast<std::uint8_t>(tag)});
        packed.insert(packed.end(), present.begin(), present.end());
        if (tag == 0) packed.push_back(std::byte{0});
    }
    const std::string message = complaint(packed);
    EXPECT_TRUE(contains(message, "100000 items in the list of kind light")) << message;
}

}  // namespace
}  // namespace tessera
