// What mesh files refuse, and what is left on the disk where writing fails: nothing new, and older files as they were.
#include "formats/mesh_writer.h"

#include "closed_models.h"
#include "mesh/mesh_shared.h"
#include "output_folder.h"
#include "small_files.h"
#include "tessera/error.h"
#include "written_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace tessera::test {
namespace {

constexpr std::array kNames{"a.ply", "a.obj", "a.stl", "a.glb"};

std::string errorOf(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

HostMesh ball(bool positionsOnly = false) { return {placedAnyhow({cubeSolid(4, 2)}, 5), 12.0, 9, positionsOnly}; }

void stream(const HostMesh& mesh, MeshWriter& writer) {
    writer.begin(mesh.outline());
    mesh.stream(writer, [](std::size_t) { return 5; });
}

// Of a sheet of one patch, as dense as any may be: 4.3e9 vertices, which nobody makes.
class Boundless {
public:
    Boundless() {
        Mesh mesh;
        mesh.name = "sheet";
        for (int k = 0; k < 16; ++k) mesh.points.emplace_back(k % 4, k / 4, 0);
        scene_.meshes.push_back(mesh);
        scene_.objects.push_back({"sheet", {}, "sheet", glm::vec3(1.0F), {}});
        patterns_[0].form = MESH_RING;
        for (std::uint32_t& side : patterns_[0].side) side = MESH_RATE_MOST;
        patterns_[0].cells_u = patterns_[0].cells_v = MESH_RATE_MOST + 2;
        sizes_.patches = 1;
        sizes_.triangles = 2ULL * MESH_RATE_MOST * MESH_RATE_MOST;
    }
    [[nodiscard]] MeshOutline outline() const { return {scene_, true, sizes_, patches_, patterns_}; }

private:
    Scene scene_;
    MeshSizes sizes_;
    std::vector<MeshPatch> patches_{{0, 0}};
    std::vector<mesh_pattern> patterns_{mesh_pattern{}};
};

class MeshFileErrors : public OutputFolder {};

TEST_F(MeshFileErrors, EndingsOfNoFormatAreRefusedWithThoseThatAre) {
    for (const char* name : {"a.gltf", "a", "a.ply.txt", ".ply"}) {
        const std::string message = errorOf([&] { static_cast<void>(makeMeshWriter(file(name), {})); });
        for (const char* part : {name, ".ply", ".obj", ".stl", ".glb"}) EXPECT_TRUE(mentions(message, part)) << message;
    }
    EXPECT_TRUE(files().empty());
}

TEST_F(MeshFileErrors, QuadsAreRefusedWhereTheFormatHasNone) {
    for (const char* name : {"a.stl", "a.GLB"}) {
        const std::string message = errorOf([&] { static_cast<void>(makeMeshWriter(file(name), {.quads = true})); });
        EXPECT_TRUE(mentions(message, name) && mentions(message, "--quads")) << message;
    }
    EXPECT_TRUE(files().empty());
}

TEST_F(MeshFileErrors, PathsThatCannotBeWrittenAreRefusedBeforeAnythingIsMade) {
    EXPECT_TRUE(mentions(errorOf([&] { static_cast<void>(makeMeshWriter(file("no/a.ply"), {})); }), "no such folder"));
    std::filesystem::create_directory(file("b.ply"));
    EXPECT_TRUE(mentions(errorOf([&] { static_cast<void>(makeMeshWriter(file("b.ply"), {})); }), "folder"));
    EXPECT_TRUE(mentions(errorOf([&] { static_cast<void>(makeMeshWriter(file(std::string(300, 'a') + ".ply"), {})); }), "shorter"));
    EXPECT_EQ(files(), std::vector<std::string>{"b.ply"});
}

TEST_F(MeshFileErrors, AnOlderFileIsReplacedOnSuccessAlone) {
    const HostMesh mesh = ball();
    for (const std::string name : kNames) {
        std::ofstream(file(name)) << "old";
        {
            const auto writer = makeMeshWriter(file(name), {});
            stream(mesh, *writer);
            EXPECT_EQ(bytesOf(file(name)), "old");
        }
        EXPECT_EQ(bytesOf(file(name)), "old");
        EXPECT_EQ(files(), std::vector<std::string>{name});
        const auto writer = makeMeshWriter(file(name), {});
        stream(mesh, *writer);
        writer->finish();
        EXPECT_NE(bytesOf(file(name)), "old");
        EXPECT_EQ(files(), std::vector<std::string>{name});
        std::filesystem::remove(file(name));
    }
}

TEST_F(MeshFileErrors, AMeshThatEndsEarlyGivesNoFile) {
    const HostMesh mesh = ball();
    for (const std::string name : kNames) {
        {
            const auto writer = makeMeshWriter(file(name), {});
            EXPECT_TRUE(mentions(errorOf([&] { writer->finish(); }), name));
            writer->begin(mesh.outline());
            EXPECT_TRUE(mentions(errorOf([&] { writer->finish(); }), name));
        }
        EXPECT_TRUE(files().empty());
    }
}

TEST_F(MeshFileErrors, ALimitOnSizesIsToldAndLeavesNothing) {
    const HostMesh mesh = ball();
    for (const std::string name : kNames) {
        std::ofstream(file(name)) << "old";
        std::string message;
        {
            const SmallFiles limit(20000);
            const auto writer = makeMeshWriter(file(name), {});
            // Formats of known size tell it before the first vertex.
            if (name != "a.obj") message = errorOf([&] { writer->begin(mesh.outline()); });
            if (name == "a.obj")
                message = errorOf([&] {
                    stream(mesh, *writer);
                    writer->finish();
                });
        }
        EXPECT_TRUE(mentions(message, name) && mentions(message, "File too large")) << message;
        EXPECT_EQ(bytesOf(file(name)), "old");
        EXPECT_EQ(files(), std::vector<std::string>{name});
        std::filesystem::remove(file(name));
    }
}

TEST_F(MeshFileErrors, WhatAFormatCannotCountIsRefusedBeforeAnythingIsMade) {
    const Boundless sheet;
    for (const char* name : {"a.ply", "a.stl", "a.glb"}) {
        const auto writer = makeMeshWriter(file(name), {.positionsOnly = true});
        const std::string message = errorOf([&] { writer->begin(sheet.outline()); });
        EXPECT_TRUE(mentions(message, name) && mentions(message, "4294967295") && mentions(message, ".obj")) << message;
        EXPECT_TRUE(files().empty());
    }
}

TEST_F(MeshFileErrors, AFileThatNeedsMoreThanPositionsSaysSo) {
    const HostMesh mesh = ball(true);
    for (const std::string name : kNames) {
        const auto writer = makeMeshWriter(file(name), {});
        EXPECT_EQ(writer->positionsSuffice(), name == "a.stl");
        EXPECT_EQ(errorOf([&] { writer->begin(mesh.outline()); }).empty(), name == "a.stl");
        EXPECT_TRUE(makeMeshWriter(file(name), {.positionsOnly = true})->positionsSuffice());
    }
}

}  // namespace
}  // namespace tessera::test
