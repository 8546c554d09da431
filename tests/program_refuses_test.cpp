// What the program `tessera` does with bad input: one line that says what is wrong, and no file.
#include "program_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace tessera::test {

namespace {

class ProgramRefuses : public Program, public testing::WithParamInterface<BadInput> {
protected:
    void SetUp() override {
        const Scene sound = builtinScene("teapot");
        write("sound.mscene", sound);
        const std::string bytes = file("sound.mscene");
        writeFile(folder_.path() / "truncated.mscene", bytes.substr(0, bytes.size() / 2));
        writeFile(folder_.path() / "empty.mscene", "");
        writeFile(folder_.path() / "notes.txt", "no scene\n");
        writeFile(folder_.path() / "zeros.mscene", std::string(60000, '\0'));
        std::mt19937 generator(7);
        std::string noise(5000, '\0');
        std::generate(noise.begin(), noise.end(), [&generator] { return static_cast<char>(generator() & 0xFFU); });
        writeFile(folder_.path() / "random.mscene", noise);
        std::filesystem::create_directory(folder_.path() / "folder.png");
        writeDamaged("nan.mscene", [](Scene& scene) { scene.meshes[0].points[5].y = std::numeric_limits<float>::quiet_NaN(); });
        writeDamaged("infinite.mscene", [](Scene& scene) { scene.meshes[0].points[5].y = std::numeric_limits<float>::infinity(); });
        writeDamaged("lists.mscene", [](Scene& scene) { scene.meshes[0].points.pop_back(); });
        writeDamaged("weightless.mscene", [](Scene& scene) {
            scene.meshes[0].kind = PatchKind::rational;
            scene.meshes[0].weights.assign(scene.meshes[0].points.size(), 1.0F);
            scene.meshes[0].weights[16 + 3] = 0.0F;
        });
        writeDamaged("meshless.mscene", [](Scene& scene) { scene.objects[0].mesh = "none such"; });
    }

    template <typename Damage>
    void writeDamaged(const std::string& name, Damage damage) const {
        Scene scene = builtinScene("teapot");
        damage(scene);
        write(name, scene);
    }
};

TEST_P(ProgramRefuses, WithOneLineAndNoFile) {
    const std::set<std::string> before = folder_.fileNames();
    const Outcome outcome = run(GetParam().arguments);
    expectRefused(outcome, GetParam());
    EXPECT_EQ(folder_.fileNames(), before);
}

BadInput badScene(const std::string& name) {
    return {name, 1, {"render", name + ".mscene", "-o", "k.png", "--size", "32x18"}, name + ".mscene"};
}

BadInput badOption(const std::string& name, const std::string& option, const std::string& value, const std::string& says,
                   int exitCode = 2) {
    return {name, exitCode, {"render", "teapot", "-o", "k.png", option, value}, says};
}

BadInput badInMode(const std::string& name, const std::string& mode, const std::string& option, const std::string& value,
                   const std::string& says, int exitCode = 2) {
    return {name, exitCode, {"render", "teapot", "-o", "k.png", option, value, "--mode", mode}, says};
}

INSTANTIATE_TEST_SUITE_P(Scenes, ProgramRefuses,
                         testing::Values(badScene("truncated"), badScene("empty"), badScene("zeros"), badScene("random"), badScene("nan"),
                                         badScene("infinite"), badScene("lists"), badScene("meshless"), badScene("absent"),
                                         BadInput{"weightless", 1, {"info", "weightless.mscene"}, "mesh 'teapot', patch 1, point 3"},
                                         BadInput{
                                             "format", 1, {"render", "notes.txt", "-o", "k.png"}, "triangle mesh (OBJ, PLY, glTF, ...)"},
                                         BadInput{"folder", 1, {"render", "folder.png", "-o", "k.png"}, "folder.png"},
                                         BadInput{"infoOfRandom", 1, {"info", "random.mscene"}, "random.mscene"},
                                         BadInput{"infoOfNothing", 1, {"info", "none such", "--json"}, "a built-in scene (teapot"}),
                         [](const auto& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Options, ProgramRefuses,
    testing::Values(
        badOption("noSize", "--size", "0x0", "1 to 65536"), badOption("hugeSize", "--size", "1000000x1000000", "1 to 65536"),
        badOption("endlessSize", "--size", "99999999999999999999x1", "1 to 65536"), badOption("halfSize", "--size", "640", "WIDTHxHEIGHT"),
        badOption("wordySize", "--size", "640x480px", "WIDTHxHEIGHT"), badOption("negativeSize", "--size", "-1x5", "WIDTHxHEIGHT"),
        badOption("largestPicture", "--size", "65536x65536", "", 1), badOption("device", "--device", "77", "77", 1),
        badOption("negativeDevice", "--device", "-2", "--device"), badOption("camera", "--camera", "none such", "camera", 1),
        badOption("aov", "--aov", "Z,depth", "object.id"), badOption("method", "--method", "fast", "local"),
        badOption("mode", "--mode", "modern", "classical"), badOption("noSamples", "--pixel-samples", "0", "1 to 16"),
        badOption("largeBatch", "--batch", "1048577", "0 to 1048576"), badOption("negativeBatch", "--batch", "-1", "--batch"),
        badOption("diceRate", "--dice-rate", "33", "1 to 32"), badOption("depth", "--max-depth", "25", "0 to 24"),
        badOption("nanBound", "--split-bound", "nan", "--split-bound"),
        badInMode("noBound", "classical", "--split-bound", "0", "split bound is 0"),
        badInMode("noRate", "watertight", "--shading-rate", "0", "shading rate is 0"),
        badInMode("oddGrid", "watertight", "--grid-size", "12", "power of two"), badOption("largeGrid", "--grid-size", "33", "1 to 32"),
        badInMode("dicingCamera", "watertight", "--dicing-camera", "none such",
                  "--dicing-camera: teapot has no camera 'none such': it has '", 1),
        badInMode("boundOfClassical", "watertight", "--split-bound", "4", "--split-bound belongs to classical mode"),
        badInMode("rateOfClassical", "watertight", "--dice-rate", "8", "--dice-rate belongs to classical mode"),
        badInMode("depthOfClassical", "watertight", "--max-depth", "9", "--max-depth belongs to classical mode"),
        badInMode("rateOfWatertight", "classical", "--shading-rate", "1", "--shading-rate belongs to watertight mode"),
        badInMode("gridOfWatertight", "classical", "--grid-size", "16", "--grid-size belongs to watertight mode"),
        badInMode("cameraOfWatertight", "classical", "--dicing-camera", "camera", "--dicing-camera belongs to watertight mode"),
        badOption("noMemory", "--memory", "0", "1 to 16777216"), badOption("halfMemory", "--memory", "0.5", "no whole number"),
        badOption("smallBucket", "--bucket", "7x64", "8 to 65536"), badOption("oneSidedBucket", "--bucket", "64", "WIDTHxHEIGHT"),
        BadInput{"occlusionOfWatertight",
                 2,
                 {"render", "teapot", "-o", "k.png", "--mode", "classical", "--no-occlusion"},
                 "--no-occlusion belongs to watertight mode"},
        BadInput{"planOptionAlone", 2, {"info", "teapot", "--size", "640x480"}, "--plan"},
        BadInput{"planBatch", 2, {"info", "teapot", "--plan", "--batch", "1048577"}, "0 to 1048576"},
        BadInput{"planMode", 2, {"info", "teapot", "--plan", "--dice-rate", "8"}, "--dice-rate belongs to classical mode"},
        BadInput{"planDevice", 1, {"info", "teapot", "--plan", "--device", "77"}, "77"},
        BadInput{"planCamera", 1, {"info", "teapot", "--plan", "--dicing-camera", "none such"}, "none such"},
        BadInput{"planMemory", 1, {"info", "teapot", "--plan", "--memory", "1", "--batch", "40000"}, "would do"},
        badOption("tolerance", "--weld-tolerance", "0.2", "0 to 0.1"),
        badOption("negativeTolerance", "--weld-tolerance", "-1e-5", "0 to 0.1"),
        badOption("nanTolerance", "--weld-tolerance", "nan", "--weld-tolerance"),
        BadInput{"toleranceOfInfo", 2, {"info", "teapot", "--weld-tolerance", "1"}, "0 to 0.1"},
        BadInput{"flatOfBuiltIn", 2, {"render", "teapot", "-o", "k.png", "--flat"}, "--flat is for triangle meshes"},
        BadInput{"flatOfMscene", 2, {"info", "sound.mscene", "--flat"}, "--flat is for triangle meshes"},
        badOption("flatView", "--fov", "180", "180"), badOption("shortLook", "--look-at", "1,2,3", "6"),
        badOption("blindLook", "--look-at", "1,1,1,1,1,1", "--look-at"), badOption("emptyCrop", "--crop", "0.5,0.5,0,1", "rop"),
        badOption("outerCrop", "--crop", "0,2,0,1", "rop"), badOption("background", "--background", "1,0", "3 to 4"),
        badOption("noFrames", "--frames", "0", "--frames"), badOption("stats", "--stats", "/none/such/s.json", "/none/such", 1),
        badOption("trace", "--trace", "/none/such/t.json", "/none/such", 1), badOption("sameFile", "--stats", "./k.png", "same file"),
        badOption("unknown", "--frobnicate", "1", "--frobnicate"),
        BadInput{"nowhere", 1, {"render", "teapot", "-o", "/none/such/k.png"}, "/none/such"},
        BadInput{"ontoFolder", 1, {"render", "teapot", "-o", "folder.png"}, "folder.png"},
        BadInput{"pictureFormat", 1, {"render", "teapot", "-o", "k.gif"}, ".exr"},
        BadInput{"noOutput", 2, {"render", "teapot"}, "--output"},
        BadInput{"toStdout", 2, {"render", "teapot", "-o", "-"}, "standard output"},
        BadInput{"noScene", 2, {"render", "-o", "k.png"}, "SCENE"}, BadInput{"noCommand", 2, {}, "command"},
        BadInput{"command", 2, {"frobnicate"}, "frobnicate"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace

}  // namespace tessera::test
