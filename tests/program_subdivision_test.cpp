// Subdivision surfaces from the command line: which polygons become cages, what is told of them, tables, and options that make no sense.
#include "cage_file_samples.h"
#include "program_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tessera::test {

namespace {

using nlohmann::json;

class ProgramSubdivides : public Program {
protected:
    void SetUp() override {
        writeFile(folder_.path() / "tagged.obj", cageObjText());
        writeFile(folder_.path() / "plain.ply", cagePlyText());
        writeFile(folder_.path() / "extended.gltf", cageGltfText(cageExtension()));
        Scene scene;
        scene.cages.push_back(sampleCage());
        Object object;
        object.name = object.mesh = "box";
        scene.objects.push_back(object);
        write("cage.mscene", scene);
    }

    [[nodiscard]] json jsonOf(const std::vector<std::string>& arguments) const {
        const Outcome outcome = run(arguments);
        expectSuccess(outcome);
        return json::accept(outcome.out) ? json::parse(outcome.out) : json::object();
    }
    [[nodiscard]] json info(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "info");
        arguments.emplace_back("--json");
        return jsonOf(arguments);
    }
    [[nodiscard]] json mesh(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "tessellate");
        arguments.insert(arguments.end(), {"-o", "k.ply", "--stats", "-"});
        return jsonOf(arguments);
    }
};

TEST_F(ProgramSubdivides, InfoTellsOfEachCage) {
    for (const std::string scene : {"tagged.obj", "cage.mscene", "extended.gltf"}) {
        const json about = info({scene});
        ASSERT_EQ(about.at("subdivision").size(), 1U) << scene;
        const json& cage = about.at("subdivision")[0];
        EXPECT_EQ(cage.at("cage"), "box") << scene;
        EXPECT_EQ(cage.at("faces"), 5) << scene;  // one is a hole
        EXPECT_EQ(cage.at("vertices"), 9) << scene;
        // The other touches a face at a vertex of two faces, where OpenSubdiv cannot have one.
        EXPECT_EQ(cage.at("crease_edges"), 1) << scene;
        EXPECT_EQ(cage.at("corner_vertices"), 1) << scene;
        EXPECT_EQ(cage.at("holes"), 1) << scene;
        EXPECT_GT(cage.at("patches"), 10) << scene;
        EXPECT_LT(cage.at("limit_distance"), 1e-5 * 2.0) << scene;
    }
    const Outcome outcome = run({"info", "tagged.obj"});
    expectSuccess(outcome);
    for (const std::string part : {"cage    'box': 5 faces, 9 vertices", "1 crease", "% regular", "of the limit surface"}) {
        EXPECT_NE(outcome.out.find(part), std::string::npos) << outcome.out;
    }
}

TEST_F(ProgramSubdivides, PolygonsBecomeSurfacesWhereTheyAreAskedFor) {
    EXPECT_TRUE(info({"plain.ply"}).at("subdivision").empty());
    EXPECT_TRUE(info({"plain.ply"}).at("patch_types").contains("pn"));
    const json smooth = info({"plain.ply", "--subdivision-scheme", "catmull-clark"});
    EXPECT_EQ(smooth.at("subdivision").size(), 1U);
    EXPECT_TRUE(smooth.at("patch_types").contains("bezier"));
    EXPECT_TRUE(info({"tagged.obj", "--subdivision-scheme", "none"}).at("patch_types").contains("pn"));
    EXPECT_TRUE(info({"tagged.obj", "--flat"}).at("patch_types").contains("pn"));
    EXPECT_EQ(info({"extended.gltf", "--subdivision-scheme", "loop"}).at("subdivision").size(), 2U);
}

TEST_F(ProgramSubdivides, AnglesCreaseAndGregoryIsCoarser) {
    const json creased = info({"plain.ply", "--subdivision-scheme", "catmull-clark", "--crease-angle", "30"});
    EXPECT_GT(creased.at("subdivision")[0].at("creased_by_angle"), 4);
    const json gregory = info({"tagged.obj", "--subdivision-surface", "gregory"});
    EXPECT_GT(gregory.at("subdivision")[0].at("limit_distance"), 1e-5);
    EXPECT_LT(gregory.at("patches"), info({"tagged.obj"}).at("patches"));
}

TEST_F(ProgramSubdivides, BuiltInCagesAreDrawn) {
    for (const std::string scene : {"cube_creases", "character"}) {
        const json stats = jsonOf({"render", scene, "-o", "k.png", "--size", "96x54", "--pixel-samples", "1", "--stats", "-"});
        EXPECT_EQ(stats.at("subdivision").size(), scene == "character" ? 1U : 10U);
        EXPECT_GT(stats.at("pixels_covered"), 96 * 54 / 20);
    }
}

TEST_F(ProgramSubdivides, PatchesAndTablesMakeTheSameSurface) {
    const json patches = mesh({"tagged.obj", "--tolerance", "0.005"});
    EXPECT_EQ(patches.at("method"), "patches");
    EXPECT_EQ(patches.at("subdivision").size(), 1U);
    const json tables = mesh({"tagged.obj", "--tolerance", "0.005", "--method", "tables"});
    EXPECT_EQ(tables.at("method"), "tables");
    EXPECT_EQ(tables.at("tolerance"), 0.005);
    EXPECT_TRUE(tables.at("level").is_null());
    EXPECT_GT(tables.at("triangles"), 20);
    EXPECT_EQ(tables.at("file_triangles"), tables.at("triangles"));
    EXPECT_GT(tables.at("table_bytes"), 0);
}

TEST_F(ProgramSubdivides, TablesTakeLevelsAndOrders) {
    const json coarse = mesh({"cube_creases", "--method", "tables", "--level", "1"});
    const json fine = mesh({"cube_creases", "--method", "tables", "--level", "3", "--summation", "unordered"});
    EXPECT_EQ(fine.at("triangles"), 16 * coarse.at("triangles").get<int>());
    EXPECT_EQ(fine.at("level"), 3);
    EXPECT_EQ(fine.at("summation"), "unordered");
    EXPECT_EQ(coarse.at("summation"), "ordered");
    EXPECT_TRUE(coarse.at("tolerance").is_null());
    EXPECT_GT(mesh({"plain.ply", "--method", "tables", "--subdivision-scheme", "catmull-clark"}).at("tolerance"), 0.0);
}

TEST_F(ProgramSubdivides, HelpTellsEveryOption) {
    for (const std::string command : {"render", "tessellate", "info"}) {
        const Outcome outcome = run({command, "--help"});
        expectSuccess(outcome);
        for (const std::string option : {"--subdivision-scheme", "--subdivision-surface", "--subdivision-tolerance", "--crease-angle"}) {
            EXPECT_NE(outcome.out.find(option), std::string::npos) << command << " " << option;
        }
    }
    const std::string help = run({"tessellate", "--help"}).out;
    for (const std::string option : {"--method", "--level", "--summation"}) EXPECT_NE(help.find(option), std::string::npos) << option;
}

TEST_F(ProgramSubdivides, OptionsThatMakeNoSenseAreRefused) {
    const auto tessellate = [](std::vector<std::string> more) {
        more.insert(more.begin(), {"tessellate", "tagged.obj", "-o", "k.obj"});
        return more;
    };
    const std::vector<BadInput> all{
        {"unknownScheme", 2, {"info", "plain.ply", "--subdivision-scheme", "doo-sabin"}, "unknown scheme 'doo-sabin'"},
        {"unknownSurface", 2, {"info", "tagged.obj", "--subdivision-surface", "round"}, "none of exact and gregory"},
        {"tolerance", 2, {"info", "tagged.obj", "--subdivision-tolerance", "0"}, "out of range: 1e-09 to 0.1"},
        {"angle", 2, {"info", "tagged.obj", "--crease-angle", "181"}, "out of range: 0 to 180"},
        {"flat", 2, {"info", "plain.ply", "--flat", "--subdivision-scheme", "loop"}, "--flat takes triangles as they are"},
        {"flatAngle", 2, {"info", "plain.ply", "--flat", "--crease-angle", "30"}, "--crease-angle is for subdivision surfaces"},
        {"noneAngle", 2, {"info", "tagged.obj", "--subdivision-scheme", "none", "--crease-angle", "30"}, "--crease-angle"},
        {"gregory",
         2,
         {"info", "tagged.obj", "--subdivision-surface", "gregory", "--subdivision-tolerance", "1e-4"},
         "--subdivision-tolerance is for --subdivision-surface exact"},
        {"patches", 2, {"info", "teapot", "--subdivision-scheme", "loop"}, "--subdivision-scheme is for polygons and cages"},
        {"noCage", 2, {"info", "plain.ply", "--crease-angle", "30"}, "give --subdivision-scheme"},
        {"level", 2, tessellate({"--level", "2"}), "--level is for --method tables"},
        {"summation", 2, tessellate({"--summation", "ordered"}), "--summation is for --method tables"},
        {"levelAndTolerance", 2, tessellate({"--method", "tables", "--level", "2", "--tolerance", "1"}), "give one of them"},
        {"levelRange", 2, tessellate({"--method", "tables", "--level", "9"}), "--level"},
        {"orientation", 2, tessellate({"--method", "tables", "--orientation", "given"}), "--orientation is for --method patches"},
        {"noCull", 2, tessellate({"--method", "tables", "--pixel-error", "1", "--no-cull"}), "--no-cull is for --method patches"},
        {"surface", 2, tessellate({"--method", "tables", "--subdivision-surface", "gregory"}), "is for --method patches"},
        {"loop", 2, tessellate({"--method", "tables", "--subdivision-scheme", "loop"}), "catmull-clark alone"},
        {"teapot", 2, {"tessellate", "teapot", "-o", "k.obj", "--method", "tables"}, "--method tables is for subdivision surfaces"},
        {"method", 2, tessellate({"--method", "magic"}), "none of patches and tables"},
    };
    for (const BadInput& bad : all) {
        SCOPED_TRACE(bad.name);
        expectRefused(run(bad.arguments), bad);
    }
    EXPECT_FALSE(folder_.fileNames().contains("k.obj"));
}

TEST_F(ProgramSubdivides, MalformedCagesAreOneLine) {
    writeFile(folder_.path() / "bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\nt crease 0/0/0\n");
    const Outcome outcome = run({"info", "bad.obj"});
    expectOneLineError(outcome, 1);
    EXPECT_NE(outcome.err.find("bad.obj: line 4: vertex number 3"), std::string::npos) << outcome.err;
}

}  // namespace

}  // namespace tessera::test
