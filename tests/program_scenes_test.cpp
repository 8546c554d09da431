// What the program does with scenes of each format and kind of patch, what it tells of their edges, and how its modes look at them.
#include "mscene_samples.h"
#include "program_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace tessera::test {

namespace {

using nlohmann::json;

class ProgramScenes : public Program {
protected:
    [[nodiscard]] json info(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "info");
        arguments.emplace_back("--json");
        const Outcome outcome = run(arguments);
        expectSuccess(outcome);
        return json::parse(outcome.out);
    }

    [[nodiscard]] json stats(const std::string& scene, const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"render", scene, "-o", "k.png", "--size", "96x54", "--pixel-samples", "1", "--stats", "-"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        expectSuccess(outcome);
        return json::parse(outcome.out);
    }
};

// Two unit plates side by side, `gap` apart at their common edge.
Scene plates(float gap) {
    Scene scene = plainScene();
    Mesh& mesh = scene.meshes.front();
    for (std::size_t i = 0; i < 16; ++i) mesh.points.emplace_back(mesh.points[i].x + 1.0F + gap, mesh.points[i].y, 0.0F);
    return scene;
}

TEST_F(ProgramScenes, InfoCountsEdgesThatMeetAndThoseThatDoNot) {
    write("plates.mscene", plates(2e-6F));
    const json edges = info({"plates.mscene"}).at("edges");
    EXPECT_EQ(edges.at("edges"), 8);
    EXPECT_EQ(edges.at("matched"), 2);
    EXPECT_EQ(edges.at("boundary"), 6);
    EXPECT_EQ(edges.at("degenerate"), 0);
    EXPECT_EQ(edges.at("collapsed"), 0);
    EXPECT_EQ(edges.at("records"), 0);
    EXPECT_EQ(edges.at("shared_by_three_or_more"), 0);
    EXPECT_GT(edges.at("snapped_points"), 0);
    EXPECT_GT(edges.at("largest_gap"), 1e-6);
    EXPECT_LT(edges.at("largest_gap"), 3e-6);
    EXPECT_NEAR(edges.at("tolerance").get<double>(), 1e-5 * std::sqrt(5.0), 1e-9);
}

TEST_F(ProgramScenes, WeldToleranceSaysHowFarApartEdgesMayBe) {
    write("plates.mscene", plates(2e-6F));
    const json exact = info({"plates.mscene", "--weld-tolerance", "0"}).at("edges");
    EXPECT_EQ(exact.at("boundary"), 8);
    EXPECT_EQ(exact.at("largest_gap"), 0.0);
    EXPECT_EQ(exact.at("tolerance"), 0.0);
    write("apart.mscene", plates(0.01F));
    EXPECT_EQ(info({"apart.mscene"}).at("edges").at("matched"), 0);
    EXPECT_EQ(info({"apart.mscene", "--weld-tolerance", "0.02"}).at("edges").at("matched"), 2);
}

TEST_F(ProgramScenes, InfoTellsOfEdgesInWords) {
    write("plates.mscene", plates(2e-6F));
    const std::string text = run({"info", "plates.mscene"}).out;
    for (const std::string part : {"edges   8: 2 matched", "6 boundary", "0 more are degenerate", "0 of them collapsed",
                                   "moved, largest gap", "units", "0 edge records"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
    EXPECT_EQ(text.find("nearest miss"), std::string::npos) << text;
    // A crack of fifty tolerances.
    write("crack.mscene", plates(1e-3F));
    EXPECT_NE(run({"info", "crack.mscene"}).out.find("nearest miss"), std::string::npos);
    EXPECT_TRUE(info({"crack.mscene"}).at("edges").at("nearest_miss").is_number());
    EXPECT_TRUE(info({"plates.mscene"}).at("edges").at("nearest_miss").is_null());
}

TEST_F(ProgramScenes, InfoCountsEveryKindOfPatch) {
    write("rich.mscene", richScene());
    const json kinds = info({"rich.mscene"}).at("patch_types");
    EXPECT_EQ(kinds, json({{"bezier", 1}, {"gregory", 2}, {"rational", 2}, {"pn", 1}}));
    const std::string text = run({"info", "rich.mscene"}).out;
    for (const std::string part : {"2 rational", "1 pn", "of type rational", "of type pn"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
}

constexpr const char* tetrahedron = "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

// Its edges run through the faces of its box: rounded, they bulge out of it.
TEST_F(ProgramScenes, TriangleMeshesAreCurvedUnlessFlatIsAskedFor) {
    writeFile(folder_.path() / "tetrahedron.obj", tetrahedron);
    const json curved = info({"tetrahedron.obj"});
    EXPECT_EQ(curved.at("patch_types"), json({{"pn", 4}}));
    EXPECT_EQ(curved.at("edges").at("boundary"), 0);
    EXPECT_EQ(curved.at("edges").at("matched"), 12);
    EXPECT_GT(curved.at("bounds").at("upper").at(2), 1.1);
    const json flat = info({"tetrahedron.obj", "--flat"});
    EXPECT_EQ(flat.at("patch_types"), json({{"pn", 4}}));
    EXPECT_EQ(flat.at("edges").at("boundary"), 0);
    EXPECT_EQ(flat.at("bounds").at("upper").at(2), 1.0);
    const json curvedPicture = stats("tetrahedron.obj", {"--mode", "watertight", "--look-at", "0,0,6,0,0,0"});
    const json flatPicture = stats("tetrahedron.obj", {"--mode", "watertight", "--look-at", "0,0,6,0,0,0", "--flat"});
    EXPECT_GT(curvedPicture.at("pixels_covered"), flatPicture.at("pixels_covered"));
    EXPECT_GT(flatPicture.at("pixels_covered"), 100);
}

TEST_F(ProgramScenes, FormatsAreToldByTheirEndingsInAnyCase) {
    write("PLATE.MSCENE", plainScene());
    EXPECT_EQ(info({"PLATE.MSCENE"}).at("patches"), 1);
    writeFile(folder_.path() / "T.OBJ", tetrahedron);
    EXPECT_EQ(info({"T.OBJ"}).at("patches"), 4);
}

TEST_F(ProgramScenes, StatsTellTheModeAndItsRates) {
    const json watertight = stats("teapot", {"--mode", "watertight", "--shading-rate", "0.7", "--grid-size", "8"});
    EXPECT_EQ(watertight.at("mode"), "watertight");
    EXPECT_EQ(watertight.at("shading_rate").dump(), "0.7");
    EXPECT_EQ(watertight.at("grid_size"), 8);
    const json classical = stats("teapot", {"--mode", "classical"});
    EXPECT_EQ(classical.at("mode"), "classical");
    EXPECT_EQ(classical.at("shading_rate"), 0);
    EXPECT_EQ(classical.at("grid_size"), 0);
}

TEST_F(ProgramScenes, ALargerShadingRateMakesFewerMicropolygons) {
    const json fine = stats("teapot", {"--mode", "watertight", "--shading-rate", "0.25"});
    const json coarse = stats("teapot", {"--mode", "watertight", "--shading-rate", "16"});
    EXPECT_GT(fine.at("micropolygons"), 8 * coarse.at("micropolygons").get<int>());
}

// Seen through a near camera, dicing for a far one makes few micropolygons; dicing for the camera itself changes nothing.
TEST_F(ProgramScenes, TheDicingCameraSetsTheRates) {
    Scene scene = builtinScene("teapot");
    Camera far = scene.cameras.front();
    far.name = "far";
    far.transform.translation *= 4.0F;
    scene.cameras.push_back(far);
    write("two.mscene", scene);
    const json plain = stats("two.mscene", {"--mode", "watertight"});
    const json own = stats("two.mscene", {"--mode", "watertight", "--dicing-camera", scene.cameras.front().name});
    const json frozen = stats("two.mscene", {"--mode", "watertight", "--dicing-camera", "far"});
    EXPECT_EQ(own.at("micropolygons"), plain.at("micropolygons"));
    EXPECT_EQ(own.at("pixels_covered"), plain.at("pixels_covered"));
    EXPECT_LT(2 * frozen.at("micropolygons").get<int>(), plain.at("micropolygons"));
    EXPECT_EQ(frozen.at("camera"), scene.cameras.front().name);
}

}  // namespace

}  // namespace tessera::test
