// `tessera tessellate`: what each option does to the mesh file, and that the file is there complete or not at all.
#include "program_fixture.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tessera::test {

namespace {

using nlohmann::json;

class ProgramTessellates : public Program {
protected:
    [[nodiscard]] static std::vector<std::string> command(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "tessellate");
        return arguments;
    }

    [[nodiscard]] Outcome tessellate(const std::vector<std::string>& arguments) const { return run(command(arguments)); }

    // The statistics of a run that succeeds.
    [[nodiscard]] json stats(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"--stats", "-"});
        const Outcome outcome = tessellate(arguments);
        expectSuccess(outcome);
        return json::accept(outcome.out) ? json::parse(outcome.out) : json::object();
    }

    [[nodiscard]] std::uintmax_t folderBytes() const {
        std::uintmax_t bytes = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
            std::error_code gone;
            const std::uintmax_t size = entry.file_size(gone);
            if (!gone) bytes += size;
        }
        return bytes;
    }
};

TEST_F(ProgramTessellates, HelpTellsEveryOption) {
    const Outcome outcome = tessellate({"--help"});
    expectSuccess(outcome);
    for (const std::string option :
         {"--output",    "--weld",     "--no-weld", "--quads", "--positions-only", "--tolerance", "--pixel-error",
          "--camera",    "--look-at",  "--fov",     "--size",  "--no-cull",        "--memory",    "--device",
          "--cache-dir", "--no-cache", "--stats",   "--quiet", "--weld-tolerance", "--flat",      "--help",
          ".ply",        ".obj",       ".glb",      ".stl",    "--orientation"}) {
        EXPECT_NE(outcome.out.find(option), std::string::npos) << option;
    }
    EXPECT_NE(run({"--help"}).out.find("tessellate"), std::string::npos);
}

TEST_F(ProgramTessellates, EachFormatByTheFilesEnding) {
    const std::map<std::string, std::string> beginnings{{"k.ply", "ply\n"}, {"k.glb", "glTF"}, {"k.obj", ""}, {"k.STL", ""}};
    for (const auto& [name, beginning] : beginnings) {
        const json about = stats({"sphere", "-o", name, "--tolerance", "0.01"});
        const std::string bytes = file(name);
        EXPECT_TRUE(bytes.starts_with(beginning)) << name;
        EXPECT_EQ(about.at("file_bytes"), bytes.size()) << name;
        EXPECT_EQ(about.at("file_triangles"), about.at("triangles")) << name;
        // A header of 84 bytes and 50 a triangle.
        if (name == "k.STL") {
            EXPECT_EQ(bytes.size(), 84 + 50 * about.at("triangles").get<std::size_t>());
        }
    }
    EXPECT_EQ(folder_.fileNames(), (std::set<std::string>{"k.STL", "k.glb", "k.obj", "k.ply"}));
}

// Vertices and directed edges of an OBJ file.
struct ObjMesh {
    std::size_t vertices = 0;
    std::size_t faces = 0;
    std::map<std::pair<std::size_t, std::size_t>, int> edges;  // how often each is there
};

ObjMesh readObj(const std::string& text) {
    ObjMesh mesh;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "v") ++mesh.vertices;
        if (word != "f") continue;
        std::vector<std::size_t> corners;
        while (words >> word) corners.push_back(std::stoul(word));
        ++mesh.faces;
        for (std::size_t i = 0; i < corners.size(); ++i) ++mesh.edges[{corners[i], corners[(i + 1) % corners.size()]}];
    }
    return mesh;
}

TEST_F(ProgramTessellates, AWeldedSphereIsClosedAndOneThatIsNotHasItsSeams) {
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--quads"}, {"--positions-only"}}) {
        std::vector<std::string> arguments{"sphere", "-o", "k.obj", "--tolerance", "0.01"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const json about = stats(arguments);
        const ObjMesh mesh = readObj(file("k.obj"));
        EXPECT_EQ(about.at("file_vertices"), mesh.vertices);
        for (const auto& [edge, times] : mesh.edges) {
            ASSERT_EQ(times, 1) << edge.first << " to " << edge.second;
            ASSERT_TRUE(mesh.edges.contains({edge.second, edge.first})) << edge.first << " to " << edge.second;
        }
        EXPECT_EQ(mesh.vertices + mesh.faces, mesh.edges.size() / 2 + 2);
    }
    const json seams = stats({"sphere", "-o", "seams.obj", "--tolerance", "0.01", "--no-weld"});
    EXPECT_EQ(seams.at("file_vertices"), seams.at("distinct_vertices"));
    EXPECT_GT(readObj(file("seams.obj")).vertices, readObj(file("k.obj")).vertices);
}

TEST_F(ProgramTessellates, QuadsAndPositionsOnlyChangeTheFile) {
    const json all = stats({"teapot", "-o", "k.ply", "--tolerance", "0.01"});
    const json quads = stats({"teapot", "-o", "quads.ply", "--tolerance", "0.01", "--quads"});
    const json positions = stats({"teapot", "-o", "positions.ply", "--tolerance", "0.01", "--positions-only"});
    EXPECT_EQ(all.at("file_quads"), 0);
    EXPECT_GT(quads.at("file_quads"), 0);
    EXPECT_EQ(quads.at("triangles"), all.at("triangles"));
    EXPECT_LT(file("positions.ply").size(), file("k.ply").size());
    EXPECT_EQ(positions.at("vertex_bytes"), 12 * positions.at("vertices").get<std::uint64_t>());
}

TEST_F(ProgramTessellates, ASmallerToleranceMakesMoreTriangles) {
    const json coarse = stats({"teapot", "-o", "k.ply", "--tolerance", "0.01"});
    const json fine = stats({"teapot", "-o", "k.ply", "--tolerance", "0.001"});
    EXPECT_GT(fine.at("triangles"), 2 * coarse.at("triangles").get<std::uint64_t>());
    EXPECT_EQ(coarse.at("tolerance"), 0.01);
    EXPECT_TRUE(coarse.at("pixel_error").is_null() && coarse.at("camera").is_null() && coarse.at("width").is_null());
}

TEST_F(ProgramTessellates, PixelErrorFollowsThePictureAndTheCamera) {
    const json small = stats({"teapot", "-o", "k.ply", "--pixel-error", "0.5", "--size", "160x90"});
    const json large = stats({"teapot", "-o", "k.ply", "--pixel-error", "0.5", "--size", "1600x900"});
    EXPECT_GT(large.at("triangles"), small.at("triangles"));
    EXPECT_EQ(large.at("camera"), "camera");
    EXPECT_EQ(large.at("pixel_error"), 0.5);
    EXPECT_EQ(large.at("width"), 1600);
    EXPECT_EQ(large.at("height"), 900);
    EXPECT_TRUE(large.at("tolerance").is_null());
    const std::vector<std::string> away{"teapot", "-o", "k.ply", "--pixel-error", "1", "--look-at", "0,20,0,0,40,0"};
    const Outcome culled = tessellate(away);
    expectSuccess(culled);
    EXPECT_NE(culled.err.find("--no-cull"), std::string::npos) << culled.err;
    std::vector<std::string> kept = away;
    kept.emplace_back("--no-cull");
    const json all = stats(kept);
    EXPECT_EQ(all.at("camera"), "look-at");
    EXPECT_EQ(all.at("patches_culled"), 0);
    EXPECT_GT(all.at("triangles"), 0);
    EXPECT_EQ(stats(away).at("patches_culled"), all.at("patches"));
}

TEST_F(ProgramTessellates, PatchesWithoutAreaAreNotCalledOutOfView) {
    Scene scene;
    Mesh mesh;
    mesh.name = "point";
    mesh.points.assign(16, glm::vec3(1.0F));
    scene.meshes.push_back(mesh);
    Object object;
    object.name = object.mesh = mesh.name;
    scene.objects.push_back(object);
    write("point.mscene", scene);
    const Outcome outcome = tessellate({"point.mscene", "-o", "k.ply", "--tolerance", "0.1"});
    expectSuccess(outcome);
    EXPECT_EQ(outcome.err.find("view"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("no patch has an area"), std::string::npos) << outcome.err;
}

TEST_F(ProgramTessellates, StatsHoldEveryPromisedField) {
    expectSuccess(tessellate({"teapot", "-o", "k.ply", "--pixel-error", "1", "--stats", "stats.json", "--memory", "100"}));
    const json about = json::parse(file("stats.json"));
    for (const std::string field : {"version", "scene", "camera", "device"}) EXPECT_TRUE(about.at(field).is_string()) << field;
    for (const std::string field : {"width",
                                    "height",
                                    "pixel_error",
                                    "patches",
                                    "patches_culled",
                                    "units",
                                    "vertices",
                                    "triangles",
                                    "vertex_bytes",
                                    "index_bytes",
                                    "pieces",
                                    "chunks",
                                    "file_vertices",
                                    "distinct_vertices",
                                    "file_quads",
                                    "file_triangles",
                                    "file_bytes",
                                    "place_ms",
                                    "factors_ms",
                                    "offsets_ms",
                                    "vertex_ms",
                                    "index_ms",
                                    "tessellate_ms",
                                    "write_ms",
                                    "total_ms",
                                    "build_ms",
                                    "device_bytes_peak",
                                    "device_bytes_budget"}) {
        EXPECT_TRUE(about.at(field).is_number()) << field;
    }
    EXPECT_EQ(about.at("patches"), 32);
    EXPECT_EQ(about.at("device_bytes_budget"), 100U << 20);
    EXPECT_LE(about.at("device_bytes_peak"), about.at("device_bytes_budget"));
    EXPECT_LE(about.at("write_ms"), about.at("total_ms"));
    EXPECT_FALSE(about.at("kernel_ms").empty());
}

TEST_F(ProgramTessellates, TellsToleranceAndSummaryUnlessQuietAndReplacesAnOlderFile) {
    writeFile(folder_.path() / "k.ply", "old");
    const Outcome told = tessellate({"teapot", "-o", "k.ply"});
    expectSuccess(told);
    EXPECT_EQ(told.out, "");
    EXPECT_EQ(told.errorLines(), 2U) << told.err;
    EXPECT_NE(told.err.find("a thousandth of the scene's size; choose one by --tolerance"), std::string::npos) << told.err;
    EXPECT_NE(told.err.find("tessera: 32 patches, "), std::string::npos) << told.err;
    EXPECT_NE(told.err.find(" vertices (welded), "), std::string::npos) << told.err;
    EXPECT_NE(told.err.find(", wrote k.ply"), std::string::npos) << told.err;
    const std::string first = file("k.ply");
    EXPECT_TRUE(first.starts_with("ply\n"));
    const Outcome quiet = tessellate({"teapot", "-o", "k.ply", "--quiet"});
    expectSuccess(quiet);
    EXPECT_EQ(quiet.out + quiet.err, "");
    EXPECT_EQ(file("k.ply"), first);
    EXPECT_EQ(folder_.fileNames(), std::set<std::string>{"k.ply"});
}

TEST_F(ProgramTessellates, TightMemoryMakesMorePiecesOfTheSameFile) {
    for (const std::string ending : {"ply", "glb"}) {
        const json large = stats({"teapot", "-o", "large." + ending, "--tolerance", "3e-5", "--memory", "512"});
        const json tight = stats({"teapot", "-o", "tight." + ending, "--tolerance", "3e-5", "--memory", "16"});
        EXPECT_GT(tight.at("pieces"), large.at("pieces"));
        EXPECT_LE(tight.at("device_bytes_peak"), 16U << 20);
        EXPECT_TRUE(file("tight." + ending) == file("large." + ending)) << ending;
    }
}

TEST_F(ProgramTessellates, ASceneWithoutPatchesGivesAnEmptyMeshAndANote) {
    Scene scene = builtinScene("teapot");
    scene.objects.clear();
    write("bare.mscene", scene);
    const Outcome outcome = tessellate({"bare.mscene", "-o", "k.ply"});
    expectSuccess(outcome);
    EXPECT_NE(outcome.err.find("no patches"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("0 triangles"), std::string::npos) << outcome.err;
}

TEST_F(ProgramTessellates, AFailureLeavesTheOldFileAlone) {
    writeFile(folder_.path() / "k.ply", "old");
    expectOneLineError(tessellate({"teapot", "-o", "k.ply", "--pixel-error", "1", "--camera", "none such"}), 1);
    expectOneLineError(tessellate({"teapot", "-o", "k.ply", "--tolerance", "1e-30"}), 1);
    EXPECT_EQ(file("k.ply"), "old");
    EXPECT_EQ(folder_.fileNames().size(), 1U);
}

TEST_F(ProgramTessellates, AFullDiskLeavesNothing) {
    // Kernels first, whose compiler may write larger files than the limit allows.
    expectSuccess(tessellate({"teapot", "-o", "k.ply", "--tolerance", "3e-5", "--quiet"}));
    ASSERT_GT(file("k.ply").size(), 33U << 20);
    std::filesystem::remove(folder_.path() / "k.ply");
    // What would pass the limit on a file's size fails, as on a disk without space. In blocks of 512 or 1024 bytes, as the shell has it.
    const std::string script = R"(trap '' XFSZ; ulimit -f 32768; exec "$0" tessellate teapot -o "$1" --tolerance 3e-5)";
    for (const std::string name : {"k.ply", "k.obj", "k.stl", "k.glb"}) {
        RunningProgram limited("/bin/sh", {"-c", script, TESSERA_PROGRAM_PATH, name}, folder_.path(),
                               {{"TESSERA_CACHE", TESSERA_TEST_CACHE}});
        const Outcome outcome = limited.wait();
        expectOneLineError(outcome, 1);
        EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
        EXPECT_TRUE(folder_.fileNames().empty()) << name;
    }
}

TEST_F(ProgramTessellates, InterruptEndsItWithoutFiles) {
    writeFile(folder_.path() / "k.obj", "old");
    // Seconds of writing, if it were let.
    RunningProgram program = start(command({"teapot", "-o", "k.obj", "--tolerance", "1.5e-5", "--memory", "16"}));
    // Within the writing, where the file's part grows under a name; else a little later, and the outcome is the same.
    const auto late = std::chrono::steady_clock::now() + std::chrono::seconds(3);
    while (folderBytes() < (1U << 20) && std::chrono::steady_clock::now() < late) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    program.send(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.signal, SIGINT) << outcome.err;
    EXPECT_EQ(folder_.fileNames(), std::set<std::string>{"k.obj"});
    EXPECT_EQ(file("k.obj"), "old");
}

class ProgramTessellateRefuses : public ProgramTessellates, public testing::WithParamInterface<BadInput> {
protected:
    void SetUp() override {
        std::filesystem::create_directory(folder_.path() / "folder.ply");
        writeFile(folder_.path() / "notes.txt", "no scene\n");
        writeFile(folder_.path() / "notes.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    }
};

TEST_P(ProgramTessellateRefuses, WithOneLineAndNoFile) {
    const std::set<std::string> before = folder_.fileNames();
    const Outcome outcome = tessellate(GetParam().arguments);
    expectRefused(outcome, GetParam());
    EXPECT_EQ(folder_.fileNames(), before);
}

BadInput badOption(const std::string& name, const std::string& option, const std::string& value, const std::string& says,
                   int exitCode = 2) {
    return {name, exitCode, {"teapot", "-o", "k.ply", option, value}, says};
}

BadInput badOutput(const std::string& name, const std::string& output, const std::string& says, int exitCode = 1) {
    return {name, exitCode, {"teapot", "-o", output}, says};
}

INSTANTIATE_TEST_SUITE_P(
    Options, ProgramTessellateRefuses,
    testing::Values(
        badOption("noTolerance", "--tolerance", "0", "above 0"), badOption("negativeTolerance", "--tolerance", "-0.1", "above 0"),
        badOption("orientation", "--orientation", "inward", "--orientation: 'inward' is none of"),
        BadInput{"ontoScene", 2, {"notes.obj", "-o", "./notes.obj"}, "--output names the scene's own file"},
        BadInput{"statsOntoScene", 2, {"notes.obj", "-o", "k.ply", "--stats", "notes.obj"}, "--stats names the scene's own file"},
        badOption("nanTolerance", "--tolerance", "nan", "no finite number"),
        badOption("endlessTolerance", "--tolerance", "inf", "no finite number"),
        badOption("underflow", "--tolerance", "1e-400", "no finite number"), badOption("wordyTolerance", "--tolerance", "1mm", "no number"),
        badOption("tinyTolerance", "--tolerance", "1e-30", "tolerance", 1), badOption("noError", "--pixel-error", "0", "above 0"),
        badOption("nanError", "--pixel-error", "nan", "no finite number"), badOption("tinyError", "--pixel-error", "1e-30", "error", 1),
        BadInput{"twoMeasures", 2, {"teapot", "-o", "k.ply", "--tolerance", "1", "--pixel-error", "1"}, "give one of them"},
        badOption("cameraAlone", "--camera", "camera", "--camera does nothing without --pixel-error"),
        badOption("lookAlone", "--look-at", "0,0,5,0,0,0", "--look-at does nothing without --pixel-error"),
        badOption("sizeAlone", "--size", "64x64", "--size does nothing without --pixel-error"),
        BadInput{
            "cullAlone", 2, {"teapot", "-o", "k.ply", "--tolerance", "1", "--no-cull"}, "--no-cull does nothing without --pixel-error"},
        BadInput{"camera", 1, {"teapot", "-o", "k.ply", "--pixel-error", "1", "--camera", "none such"}, "it has 'camera'"},
        BadInput{"size", 2, {"teapot", "-o", "k.ply", "--pixel-error", "1", "--size", "0x9"}, "1 to 65536"},
        BadInput{"weldBoth", 2, {"teapot", "-o", "k.ply", "--weld", "--no-weld"}, "--weld"},
        BadInput{"quadsOfStl", 1, {"teapot", "-o", "k.stl", "--quads"}, "quads"},
        BadInput{"quadsOfGlb", 1, {"teapot", "-o", "k.glb", "--quads"}, "quads"}, badOption("noMemory", "--memory", "0", "1 to 16777216"),
        badOption("device", "--device", "77", "77", 1), badOption("stats", "--stats", "/none/such/s.json", "/none/such", 1),
        badOption("sameFile", "--stats", "./k.ply", "same file"), badOption("unknown", "--frobnicate", "1", "--frobnicate"),
        BadInput{"flatOfBuiltIn", 2, {"teapot", "-o", "k.ply", "--flat"}, "--flat is for triangle meshes"},
        BadInput{"noScene", 2, {"-o", "k.ply"}, "SCENE"}, BadInput{"noOutput", 2, {"teapot"}, "--output"},
        BadInput{"sceneFormat", 1, {"notes.txt", "-o", "k.ply"}, "notes.txt"},
        BadInput{"absentScene", 1, {"none such", "-o", "k.ply"}, "none such"}, badOutput("toStdout", "-", "standard output", 2),
        badOutput("ending", "k.xyz", ".ply"), badOutput("noEnding", "k", ".ply"), badOutput("nowhere", "none/such/k.ply", "none/such"),
        badOutput("ontoFolder", "folder.ply", "folder.ply"), badOutput("underFile", "notes.txt/k.ply", "notes.txt"),
        badOutput("longName", std::string(300, 'k') + ".ply", "shorter name")),
    [](const testing::TestParamInfo<BadInput>& bad) { return bad.param.name; });

}  // namespace

}  // namespace tessera::test
