// The .mscene reader and writer: what is written comes back, what is odd is a warning, what is no scene file an Error.
#include "formats/mscene.h"
#include "mscene_samples.h"
#include "tessera/error.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {
namespace {

namespace fs = std::filesystem;

void expectEqual(const Transform& a, const Transform& b) {
    EXPECT_EQ(a.translation, b.translation);
    EXPECT_EQ(a.rotation, b.rotation);
}

void expectEqual(const Object& a, const Object& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.mesh, b.mesh);
    EXPECT_EQ(a.color, b.color);
    EXPECT_EQ(a.material.kind, b.material.kind);
    EXPECT_EQ(a.material.specular, b.material.specular);
    EXPECT_EQ(a.material.roughness, b.material.roughness);
    expectEqual(a.transform, b.transform);
}

void expectEqual(const Light& a, const Light& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.color, b.color);
    EXPECT_EQ(a.intensity, b.intensity);
    expectEqual(a.transform, b.transform);
}

void expectEqual(const Camera& a, const Camera& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.near, b.near);
    EXPECT_EQ(a.far, b.far);
    EXPECT_EQ(a.fovy, b.fovy);
    expectEqual(a.transform, b.transform);
}

void expectEqual(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    ASSERT_EQ(a.objects.size(), b.objects.size());
    ASSERT_EQ(a.lights.size(), b.lights.size());
    ASSERT_EQ(a.cameras.size(), b.cameras.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i) {
        EXPECT_EQ(a.meshes[i].name, b.meshes[i].name);
        EXPECT_EQ(a.meshes[i].kind, b.meshes[i].kind);
        EXPECT_EQ(a.meshes[i].points, b.meshes[i].points);
        EXPECT_EQ(a.meshes[i].weights, b.meshes[i].weights);
    }
    for (std::size_t i = 0; i < a.objects.size(); ++i) expectEqual(a.objects[i], b.objects[i]);
    for (std::size_t i = 0; i < a.lights.size(); ++i) expectEqual(a.lights[i], b.lights[i]);
    for (std::size_t i = 0; i < a.cameras.size(); ++i) expectEqual(a.cameras[i], b.cameras[i]);
}

TEST(Mscene, WhatIsWrittenComesBack) {
    for (const Scene& scene : {richScene(), plainScene(), Scene{}, builtinScene("teapot")}) {
        const Scene read = parseMscene(serializeMscene(scene), "file");
        EXPECT_EQ(read.name, "file");
        expectEqual(read, scene);
    }
}

// plainScene() as the writer gave it when meshes had no weights yet.
constexpr std::string_view beforeWeights =
    "104c4004110d1f117d2711b12f11ed27510401020000110532310584011f706c6174650000f0abaaaa3e00000fabaa2a3fc0803f0000f0abaaaa3ef0"
    "abaaaa3e0fabaaaa3effabaa2a3fabaaaa3e00c0803f0fabaaaa3ef0abaa2a3ff0abaaaa3e0fabaa2a3fffabaa2a3fabaa2a3f00c0803f0fabaa2a3f"
    "c0803ff0abaaaa3e0c803fcfabaa2a3f803fc0803f0c803f51040103184001110922410802111c020773756e11040211080200010c803f0000cc803f"
    "803f0c803f4104051111124110021125321124020000016111040211080200010c803f00001f706c617465c83f803e083e51040202cf0ad7233c7a44"
    "0c34421105324104021f66726f6e74110402110802883f3f0c40400c803f0000";

Bytes bytesOf(std::string_view hexadecimal) {
    Bytes bytes;
    for (std::size_t i = 0; i < hexadecimal.size(); i += 2) {
        bytes.push_back(static_cast<std::byte>(std::stoi(std::string(hexadecimal.substr(i, 2)), nullptr, 16)));
    }
    return bytes;
}

TEST(Mscene, FilesFromBeforeTheFormatGrewAreReadAsTheyWere) {
    std::vector<std::string> warnings;
    expectEqual(parseMscene(bytesOf(beforeWeights), "file", &warnings), plainScene());
    EXPECT_TRUE(warnings.empty());
}

TEST(Mscene, EdgeRecordsAreNotKept) {
    Scene scene = plainScene();
    const Bytes bytes = serializeMscene(scene);
    scene.meshes[0].edges.emplace_back();
    EXPECT_EQ(serializeMscene(scene), bytes);
}

TEST(Mscene, ManyPatchesInManySegmentsComeBack) {
    Scene scene = richScene();
    for (int i = 0; i < 20; ++i) {
        Mesh mesh = scene.meshes[0];
        mesh.name = "copy " + std::to_string(i);
        for (int k = 0; k < 7 - i % 3; ++k) mesh.points.insert(mesh.points.end(), mesh.points.begin(), mesh.points.end());
        scene.meshes.push_back(mesh);
    }
    expectEqual(parseMscene(serializeMscene(scene), "file"), scene);
}

TEST(Mscene, AnOrdinaryMatteObjectTakesNoMaterialInTheFile) {
    Scene scene = plainScene();
    const std::size_t plain = serializeMscene(scene).size();
    scene.objects[0].material.kind = MaterialKind::plastic;
    EXPECT_GT(serializeMscene(scene).size(), plain + 8);  // pointer, kind and two numbers
}

TEST(Mscene, OdditiesAreWarningsAndAValidScene) {
    std::vector<std::string> warnings;
    Scene scene = plainScene();
    scene.cameras.push_back(scene.cameras[0]);
    scene.meshes.push_back({"bare", PatchKind::gregory, {}});
    EXPECT_EQ(complaint(serializeMscene(scene), &warnings), "");
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_TRUE(contains(warnings[0], "file: mesh 'bare' has no patches")) << warnings[0];
    EXPECT_TRUE(contains(warnings[1], "file: camera 'front' is there twice")) << warnings[1];

    warnings.clear();
    EXPECT_EQ(complaint(serializeMscene(Scene{}), &warnings), "");
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_TRUE(contains(warnings[0], "no objects")) << warnings[0];

    warnings.clear();
    scene = plainScene();
    scene.cameras.clear();
    EXPECT_EQ(complaint(serializeMscene(scene), &warnings), "");
    EXPECT_TRUE(warnings.empty());

    Bytes longer = serializeMscene(plainScene());
    longer.insert(longer.end(), 3, std::byte{0x55});
    EXPECT_EQ(complaint(longer, &warnings), "");
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_TRUE(contains(warnings[0], "3 bytes after")) << warnings[0];
}

TEST(Mscene, ManyOdditiesGiveABoundedListOfWarnings) {
    Scene scene = plainScene();
    for (int i = 0; i < 1000; ++i) scene.meshes.push_back({"bare " + std::to_string(i), PatchKind::bezier, {}});
    std::vector<std::string> warnings;
    EXPECT_EQ(complaint(serializeMscene(scene), &warnings), "");
    EXPECT_EQ(warnings.size(), 51U);
    EXPECT_TRUE(contains(warnings.back(), "not listed"));
}

class MsceneFile : public testing::Test {
protected:
    void SetUp() override {
        std::random_device random;
        folder_ = fs::temp_directory_path() / ("tessera-mscene-" + std::to_string(random()));
        fs::create_directory(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] fs::path at(const std::string& name) const { return folder_ / name; }

    [[nodiscard]] static std::string readComplaint(const fs::path& path) {
        try {
            static_cast<void>(readMscene(path));
            return {};
        } catch (const Error& error) {
            return error.what();
        }
    }

private:
    fs::path folder_;
};

TEST_F(MsceneFile, IsWrittenWholeAndReadBack) {
    writeMscene(richScene(), at("a.mscene"));
    writeMscene(plainScene(), at("a.mscene"));
    expectEqual(readMscene(at("a.mscene")), plainScene());
    EXPECT_EQ(std::distance(fs::directory_iterator(at("")), fs::directory_iterator{}), 1);
    EXPECT_THROW(writeMscene(plainScene(), at("no folder/a.mscene")), Error);
}

TEST_F(MsceneFile, ThatCannotBeReadIsAnErrorThatBeginsWithItsPath) {
    std::ofstream(at("empty.mscene")).close();
    std::ofstream(at("text.mscene")) << "o teapot\nv 0 0 0\n";
    writeMscene(richScene(), at("half.mscene"));
    fs::resize_file(at("half.mscene"), fs::file_size(at("half.mscene")) / 2);
    std::ofstream(at("huge.mscene")).close();
    fs::resize_file(at("huge.mscene"), std::uintmax_t{3} << 30U);  // sparse
    const auto expect = [&](const fs::path& path, const std::string& said) {
        const std::string message = readComplaint(path);
        EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0U) << message;
        EXPECT_TRUE(contains(message, said)) << message;
    };
    expect(at("missing.mscene"), "cannot be found");
    expect(at("empty.mscene"), "is empty");
    expect(at("text.mscene"), "damaged");
    expect(at("half.mscene"), "Premature EOF");
    expect(at("huge.mscene"), "3221225472 bytes");
    expect(at("").parent_path(), "is a folder");
    expect("/dev/zero", "no ordinary file");
}

struct SharedScene {
    const char* file;
    std::size_t objects;
    std::size_t bezier;
    std::size_t gregory;
    LightKind light;
};

TEST(SharedScenes, HoldWhatMicropolisPutThere) {
    const fs::path folder = TESSERA_SHARED_SCENES;
    if (!fs::is_directory(folder)) GTEST_SKIP() << "no folder " << folder << " with Micropolis' scenes";
    const std::vector<SharedScene> expected{
        {"teapot.mscene", 1, 32, 0, LightKind::directional},      {"teapot_greg.mscene", 1, 0, 32, LightKind::directional},
        {"eye_split.mscene", 1, 0, 1, LightKind::point},          {"hair.mscene", 1, 10000, 0, LightKind::directional},
        {"killeroo.mscene", 1, 11532, 0, LightKind::directional}, {"columns.mscene", 1, 0, 13242, LightKind::point},
    };
    for (const SharedScene& one : expected) {
        std::vector<std::string> warnings;
        const Scene scene = readMscene(folder / one.file, &warnings);
        EXPECT_TRUE(warnings.empty()) << one.file << ": " << warnings.front();
        std::size_t bezier = 0;
        std::size_t gregory = 0;
        for (const Mesh& mesh : scene.meshes) (mesh.kind == PatchKind::bezier ? bezier : gregory) += mesh.patchCount();
        EXPECT_EQ(bezier, one.bezier) << one.file;
        EXPECT_EQ(gregory, one.gregory) << one.file;
        EXPECT_EQ(scene.placedPatchCount(), bezier + gregory) << one.file;
        EXPECT_EQ(scene.objects.size(), one.objects) << one.file;
        ASSERT_EQ(scene.lights.size(), 1U) << one.file;
        EXPECT_EQ(scene.lights[0].kind, one.light) << one.file;
        EXPECT_EQ(scene.lights[0].intensity, 1.0F) << one.file;
        ASSERT_EQ(scene.cameras.size(), 1U) << one.file;
        EXPECT_NE(scene.findCamera("Camera"), nullptr) << one.file;
        for (const Object& object : scene.objects) EXPECT_EQ(object.material.kind, MaterialKind::matte) << one.file;
        expectEqual(parseMscene(serializeMscene(scene), "again"), scene);
    }
}

TEST(SharedScenes, TeapotIsTheBuiltInOne) {
    const fs::path file = fs::path(TESSERA_SHARED_SCENES) / "teapot.mscene";
    if (!fs::is_regular_file(file)) GTEST_SKIP() << "no file " << file;
    EXPECT_EQ(readMscene(file).meshes[0].points, builtinScene("teapot").meshes[0].points);
}

}  // namespace
}  // namespace tessera
