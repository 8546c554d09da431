// Mesh files read with Assimp: what of them becomes meshes, objects, colours, lights and cameras. Damage: mesh_damage_test.cpp.
#include "formats/mesh_file.h"
#include "mesh_file_samples.h"
#include "output_folder.h"
#include "triangle_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace tessera {
namespace {

constexpr double kFloat = 1e-6;

class MeshFile : public test::OutputFolder {
protected:
    [[nodiscard]] std::filesystem::path write(const std::string& fileName, const std::string& text) const {
        std::filesystem::path path = folder_ / fileName;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << text;
        return path;
    }

    // What reading says of the file.
    static std::string complaint(const std::filesystem::path& path) {
        try {
            static_cast<void>(readMeshFile(path, false));
            return {};
        } catch (const Error& error) {
            return error.what();
        }
    }
};

Scene parse(const std::string& text, const std::string& fileName, bool flat = false, std::vector<std::string>* warnings = nullptr) {
    Scene scene = parseMeshFile(bytesOf(text), fileName, flat, warnings);
    scene.validate();
    return scene;
}

Scene parseGltf(const std::string& nodes, const std::string& roots = "0", const std::string& more = "") {
    return parse(gltfText(nodes, roots, more), "file.gltf", false);
}

// A mesh's point in the world.
glm::dvec3 placed(const Scene& scene, std::size_t object, std::size_t point) {
    const Object& placing = scene.objects[object];
    return {matrix(placing.transform) * glm::dvec4(scene.findMesh(placing.mesh)->points[point], 1.0)};
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b) {
    EXPECT_LT(glm::length(a - b), 1e-5) << "(" << a.x << ", " << a.y << ", " << a.z << ") is not (" << b.x << ", " << b.y << ", " << b.z
                                        << ")";
}

TEST(MeshFileNames, EndingsTellWhatIsReadHere) {
    for (const std::string name : {"a.obj", "dir/b.PLY", "c.gltf", "d.glb", "e.stl", "f.off", "x.y.fbx"})
        EXPECT_TRUE(isMeshFile(name)) << name;
    for (const std::string name : {"a.mscene", "obj", "dir.obj/file", "", ".obj", "a.", "a.png"}) EXPECT_FALSE(isMeshFile(name)) << name;
}

TEST_F(MeshFile, ObjWithMaterialsBecomesObjectsWithColours) {
    static_cast<void>(write("colors.mtl", mtlText()));
    std::vector<std::string> warnings;
    const Scene scene = readMeshFile(write("file.obj", objText()), false, &warnings);
    ASSERT_EQ(scene.objects.size(), 2U);
    EXPECT_EQ(scene.name, (folder_ / "file.obj").string());
    const Mesh* plate = scene.findMesh(scene.objects[0].mesh);
    const Mesh* wing = scene.findMesh(scene.objects[1].mesh);
    EXPECT_EQ(plate->kind, PatchKind::pn);
    EXPECT_EQ(plate->patchCount(), 2U);
    EXPECT_EQ(wing->patchCount(), 1U);
    expectNear(glm::dvec3(scene.objects[0].color), {0.8, 0.1, 0.05});
    expectNear(glm::dvec3(scene.objects[1].color), {0.0, 0.5, 0.25});
    EXPECT_TRUE(warnings.empty()) << warnings.front();
}

TEST_F(MeshFile, FilesInOtherFoldersAreNotRead) {
    static_cast<void>(write("colors.mtl", mtlText()));
    static_cast<void>(write("models/below/colors.mtl", mtlText()));
    std::string outside = objText();
    outside.replace(outside.find("colors.mtl"), 10, "../colors.mtl");
    std::vector<std::string> warnings;
    const Scene scene = readMeshFile(write("models/file.obj", outside), false, &warnings);
    const glm::vec3 unknown = scene.objects[0].color;  // Assimp's grey
    EXPECT_EQ(unknown.x, unknown.y);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("../colors.mtl"), std::string::npos) << warnings[0];

    std::string absolute = objText();
    absolute.replace(absolute.find("colors.mtl"), 10, (folder_ / "colors.mtl").string());
    EXPECT_EQ(readMeshFile(write("models/file.obj", absolute), false).objects[0].color, unknown);

    std::filesystem::create_symlink(folder_ / "colors.mtl", folder_ / "models" / "colors.mtl");
    EXPECT_EQ(readMeshFile(write("models/file.obj", objText()), false).objects[0].color, unknown);

    std::string below = objText();
    below.replace(below.find("colors.mtl"), 10, "below/colors.mtl");
    expectNear(glm::dvec3(readMeshFile(write("models/file.obj", below), false).objects[0].color), {0.8, 0.1, 0.05});
}

TEST_F(MeshFile, FilesThatCannotBeReadAreErrorsThatNameThem) {
    const std::filesystem::path large = write("large.ply", "ply\n");
    std::filesystem::resize_file(large, (std::uintmax_t{1} << 31U) + 1);
    const std::vector<std::pair<std::filesystem::path, std::string>> files{
        {folder_ / "none.obj", "cannot be found"},
        {folder_, "is a folder"},
        {write("empty.ply", ""), "is empty"},
        {write("noise.stl", "\nnot\na\nmesh\n"), "cannot be read as a mesh"},
        {large, "2147483649 bytes"},
        {"/dev/null", "no ordinary file"},
    };
    for (const auto& [path, part] : files) {
        const std::string message = complaint(path);
        EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0U) << message;
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

TEST(MeshFileFormats, ClosedSolidsStayClosed) {
    for (const std::string name : {"file.ply", "file.off"}) {
        for (const bool flat : {false, true}) {
            const Scene scene = parse(meshFileSamples()[name], name, flat);
            ASSERT_EQ(scene.meshes.size(), 1U) << name;
            EXPECT_EQ(scene.meshes[0].patchCount(), 4U) << name;
            EXPECT_TRUE(isClosed(scene.meshes[0])) << name;
            EXPECT_NEAR(signedVolume(scene.meshes[0]), 1.0, kFloat) << name;
        }
    }
    EXPECT_EQ(parse(stlText(), "file.stl").placedPatchCount(), 1U);
}

TEST(MeshFileFormats, ColoursAndNormalsAreTheFiles) {
    const Scene scene = parseGltf(R"({"name":"n","mesh":0})");
    ASSERT_EQ(scene.objects.size(), 1U);
    EXPECT_EQ(scene.objects[0].name, "n");
    EXPECT_EQ(scene.meshes[0].name, "leaf");
    expectNear(glm::dvec3(scene.objects[0].color), {0.25, 0.5, 0.75});
    expectNear(glm::dvec3(scene.meshes[0].points[10]), {0.6, 0.0, 0.8});
    expectNear(glm::dvec3(parse(gltfText(R"({"mesh":0})"), "file.gltf", true).meshes[0].points[10]), {0.0, 0.0, 1.0});
}

TEST(MeshFileNodes, RigidNodesBecomeTransformsOfOneMesh) {
    const Scene scene = parseGltf(R"({"name":"root","translation":[1,2,3],"children":[1,2]},
        {"name":"a","mesh":0},{"name":"b","mesh":0,"rotation":[0,0,0.70710678,0.70710678],"translation":[0,0,1]})");
    ASSERT_EQ(scene.meshes.size(), 1U);
    ASSERT_EQ(scene.objects.size(), 2U);
    EXPECT_EQ(scene.objects[0].mesh, scene.objects[1].mesh);
    expectNear(glm::dvec3(scene.meshes[0].points[3]), {1.0, 0.0, 0.0});
    expectNear(placed(scene, 0, 3), {2.0, 2.0, 3.0});
    expectNear(placed(scene, 1, 3), {1.0, 3.0, 4.0});
}

TEST(MeshFileNodes, OtherNodesAreWorkedIntoPointsAndNormals) {
    // Twice as long in x, so normals lean less that way: (0.6 / 2, 0, 0.8).
    const Scene scene = parseGltf(R"({"mesh":0,"scale":[2,1,1],"translation":[0,0,5]})");
    EXPECT_EQ(scene.objects[0].transform.translation, glm::vec3(0.0F));
    expectNear(placed(scene, 0, 3), {2.0, 0.0, 5.0});
    expectNear(glm::dvec3(scene.meshes[0].points[10]), glm::normalize(glm::dvec3(0.3, 0.0, 0.8)));
    // Nodes that scale alike share the copy.
    const Scene many =
        parseGltf(R"({"mesh":0,"scale":[2,1,1]},{"mesh":0,"scale":[2,1,1]},{"mesh":0,"scale":[3,1,1]},{"mesh":0})", "0,1,2,3");
    EXPECT_EQ(many.objects.size(), 4U);
    EXPECT_EQ(many.meshes.size(), 3U);
}

TEST(MeshFileNodes, MirrorsKeepTheOutsideOut) {
    const Scene scene = parseGltf(R"({"mesh":0,"scale":[-1,1,1]})");
    const std::vector<glm::vec3>& p = scene.meshes[0].points;
    // Still seen from +z, with the normals mirrored.
    EXPECT_GT(glm::cross(p[3] - p[0], p[9] - p[0]).z, 0.0F);
    expectNear(glm::dvec3(p[10]), {-0.6, 0.0, 0.8});
}

TEST(MeshFileNodes, NamesAreUsedOnce) {
    const Scene scene = parseGltf(R"({"name":"n","mesh":0},{"name":"n","mesh":0},{"name":"n","mesh":0,"scale":[2,2,2]})", "0,1,2");
    std::set<std::string> objects, meshes;
    for (const Object& object : scene.objects) objects.insert(object.name);
    for (const Mesh& mesh : scene.meshes) meshes.insert(mesh.name);
    EXPECT_EQ(objects.size(), 3U);
    EXPECT_EQ(meshes.size(), 2U);
}

TEST(MeshFileNodes, DeepNestingIsNoTrouble) {
    std::string nodes = R"({"mesh":0})";
    for (int i = 0; i < 300; ++i) nodes += R"(,{"translation":[1,0,0],"children":[)" + std::to_string(i) + "]}";
    const Scene scene = parseGltf(nodes, "300");
    expectNear(placed(scene, 0, 0), {300.0, 0.0, 0.0});
}

TEST(MeshFileCameras, ViewsAreTheNodes) {
    const Scene scene =
        parseGltf(R"({"mesh":0},{"name":"eye","camera":0,"translation":[0,1,5],"rotation":[0,0.70710678,0,0.70710678]})", "0,1",
                  R"("cameras":[{"type":"perspective","perspective":{"yfov":1.0,"aspectRatio":1.5,"znear":0.25,"zfar":70}}],)");
    ASSERT_EQ(scene.cameras.size(), 1U);
    const Camera& camera = scene.cameras[0];
    EXPECT_EQ(camera.name, "eye");
    EXPECT_NEAR(camera.fovy, glm::degrees(1.0), 1e-3);
    EXPECT_FLOAT_EQ(camera.near, 0.25F);
    EXPECT_FLOAT_EQ(camera.far, 70.0F);
    // A quarter turn about y: what looked along -z looks along -x.
    const glm::dmat4 place = matrix(camera.transform);
    expectNear(glm::dvec3(place[3]), {0.0, 1.0, 5.0});
    expectNear(-glm::dvec3(place[2]), {-1.0, 0.0, 0.0});
    expectNear(glm::dvec3(place[1]), {0.0, 1.0, 0.0});
}

TEST(MeshFileLights, KindsPlacesAndStrengthsAreRead) {
    const std::string light = R"("extensions":{"KHR_lights_punctual":{"light":)";
    std::vector<std::string> warnings;
    const Scene scene =
        parse(gltfText(R"({"mesh":0},{"name":"sun","rotation":[-0.70710678,0,0,0.70710678],)" + light +
                           R"(0}}},{"name":"bulb","translation":[1,2,3],)" + light + R"(1}}},{"name":"lamp",)" + light + "2}}}",
                       "0,1,2,3",
                       R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[
                       {"type":"directional","color":[1,0.5,0],"intensity":3},{"type":"point","color":[1,1,1],"intensity":40},
                       {"type":"spot","spot":{}}]}},)"),
              "file.gltf", false, &warnings);
    ASSERT_EQ(scene.lights.size(), 3U);
    EXPECT_EQ(scene.lights[0].kind, LightKind::directional);
    EXPECT_EQ(scene.lights[0].name, "sun");
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 3.0F);
    expectNear(glm::dvec3(scene.lights[0].color), {1.0, 0.5, 0.0});
    expectNear(-glm::dvec3(matrix(scene.lights[0].transform)[2]), {0.0, -1.0, 0.0});
    EXPECT_EQ(scene.lights[1].kind, LightKind::point);
    EXPECT_FLOAT_EQ(scene.lights[1].intensity, 40.0F);
    expectNear(glm::dvec3(scene.lights[1].transform.translation), {1.0, 2.0, 3.0});
    EXPECT_EQ(scene.lights[2].kind, LightKind::point);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("'lamp' is a spot"), std::string::npos) << warnings[0];
}

TEST(MeshFileRepairs, TellOfNormalsThatCannotBeUsed) {
    std::vector<std::string> warnings;
    static_cast<void>(parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nvn 0 0 1\nf 1//1 2//2 3//2\n", "file.obj", false, &warnings));
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("computed by angle: 1"), std::string::npos) << warnings[0];
}

TEST(MeshFileRepairs, AreTold) {
    std::vector<std::string> warnings;
    const Scene scene =
        parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 1 1 0\nf 1 2 3\nf 1 2 3\nf 1 4 2\nf 3 5 2\n", "file.obj", false, &warnings);
    EXPECT_EQ(scene.placedPatchCount(), 2U);
    ASSERT_EQ(warnings.size(), 1U);
    for (const std::string part :
         {"file.obj: mesh ", "left out as duplicates: 1", "left out for two corners in one place: 1", "neighbours: 1"}) {
        EXPECT_NE(warnings[0].find(part), std::string::npos) << warnings[0];
    }
}

}  // namespace
}  // namespace tessera
