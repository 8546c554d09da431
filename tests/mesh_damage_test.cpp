// Damaged mesh files: every damage is a one-line Error that names the file, or leaves a valid scene.
#include "formats/mesh_file.h"
#include "mesh_file_samples.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace tessera {
namespace {

// An Error in one line that begins with the file's name, or a scene; whether it was an error.
bool refusedRightly(const std::string& text, const std::string& fileName, const std::string& about) {
    std::vector<std::string> warnings;
    const std::string message = meshComplaint(text, fileName, &warnings);
    EXPECT_LE(warnings.size(), 51U) << about;
    warnings.push_back(message);
    for (const std::string& line : warnings) {
        EXPECT_EQ(line.find('\n'), std::string::npos) << about << ": " << line;
        EXPECT_TRUE(line.empty() || line.rfind(fileName + ": ", 0) == 0) << about << ": " << line;
    }
    return !message.empty();
}

TEST(MeshDamage, EveryTruncationIsAnErrorOrAScene) {
    for (const auto& [name, text] : meshFileSamples()) {
        int refused = 0;
        const std::size_t step = text.size() / 150 + 1;
        for (std::size_t length = 0; length < text.size(); length += step) {
            refused += refusedRightly(text.substr(0, length), name, name + " cut to " + std::to_string(length)) ? 1 : 0;
        }
        EXPECT_GT(refused, 5) << name;
    }
}

TEST(MeshDamage, ChangedCharactersGiveAnErrorOrAScene) {
    for (const auto& [name, text] : meshFileSamples()) {
        for (unsigned seed = 0; seed < 150; ++seed) {
            std::mt19937 random(seed);
            std::string changed = text;
            for (std::size_t n = 1 + random() % 3; n > 0; --n) changed[random() % changed.size()] = "0123456789-.e \nvf"[random() % 17];
            refusedRightly(changed, name, name + ", seed " + std::to_string(seed));
        }
    }
}

TEST(MeshDamage, NumbersThatAreNoneAreLeftOutOrRefused) {
    for (const std::string number : {"nan", "inf", "-inf", "1e30", "1e39", "-1e9999", "0x10", "1,5"}) {
        std::string text = plyText();
        text.replace(text.find("\n1 0 0\n") + 1, 1, number);
        refusedRightly(text, "file.ply", number);
        // All triangles but one have that corner in this one.
        refusedRightly("v " + number + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "file.obj", number);
    }
    EXPECT_NE(meshComplaint("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "file.obj"), "");
}

TEST(MeshDamage, CornersThatDoNotExistAreErrors) {
    for (const std::string index : {"4", "9", "-1", "2147483647", "4294967295"}) {
        std::string text = plyText();
        text.replace(text.rfind("3 1 2 3"), 7, "3 1 2 " + index);
        EXPECT_NE(meshComplaint(text, "file.ply"), "") << index;
        refusedRightly("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 " + index + "\n", "file.obj", index);
        refusedRightly("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 " + index + "\n", "file.off", index);
    }
}

TEST(MeshDamage, FilesWithoutATriangleAreErrors) {
    EXPECT_NE(meshComplaint("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "file.obj"), "");
    EXPECT_NE(meshComplaint("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\np 3\n", "file.obj"), "");
    EXPECT_NE(meshComplaint("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "file.obj"), "");
    EXPECT_NE(meshComplaint("solid x\nendsolid x\n", "file.stl"), "");
    EXPECT_NE(meshComplaint("", "file.obj"), "");
    EXPECT_NE(meshComplaint(gltfText(R"({"name":"bare"})"), "file.gltf"), "");
}

TEST(MeshDamage, FormatsThatAreNotKnownAreErrors) {
    for (const std::string name : {"file.nothing", "file", "file.mscene"}) EXPECT_TRUE(refusedRightly("what is this", name, name)) << name;
}

TEST(MeshDamage, PlyFilesThatAnnounceMoreThanTheyHoldAreRefused) {
    for (const std::string count : {"200000000", "99999999999999999999999999"}) {
        std::string text = plyText();
        text.replace(text.find("vertex 4"), 8, "vertex " + count);
        const std::string message = meshComplaint(text, "file.ply");
        EXPECT_NE(message.find("announces '" + count + "' of element 'vertex'"), std::string::npos) << message;
    }
}

TEST(MeshDamage, PlyHeadersThatAreNoneAreRefusedByLine) {
    const std::vector<std::pair<std::string, std::string>> damages{
        {"ply\nformat", "play\nformat"},           {"format ascii 1.0", "format ascii"},   {"element vertex 4", "element vertex four"},
        {"element vertex 4", "elements vertex 4"}, {"property float x", "property float"}, {"list uchar int", "list int"},
        {"end_header", "comment end_header"}};
    for (const auto& [right, wrong] : damages) {
        std::string text = plyText();
        text.replace(text.find(right), right.size(), wrong);
        EXPECT_TRUE(refusedRightly(text, "file.ply", wrong)) << wrong;
    }
}

TEST(MeshDamage, FacesWithoutMeasureAreRefused) {
    std::string text;
    std::string face = "f";
    for (int i = 0; i < 5000; ++i) {
        text += "v " + std::to_string(i) + " " + std::to_string(i * i % 97) + " 0\n";
        face += " " + std::to_string(i + 1);
    }
    const std::string message = meshComplaint(text + face + "\n", "file.obj");
    EXPECT_NE(message.find("5000 corners"), std::string::npos) << message;
}

TEST(MeshDamage, TransformsThatAreNotFiniteLeaveTheObjectOut) {
    std::vector<std::string> warnings;
    const std::string nodes = R"({"name":"good","mesh":0},{"name":"far","mesh":0,"translation":[1e38,0,0]},
        {"name":"bad","mesh":0,"scale":[1e30,1e30,1e30],"children":[3]},{"name":"worse","mesh":0,"scale":[1e30,1e30,1e30]},
        {"name":"flat","mesh":0,"scale":[0,0,0]})";
    const std::string text = gltfText(nodes, "0,1,2,4");
    const Scene scene = parseMeshFile(bytesOf(text), "file.gltf", false, &warnings);
    scene.validate();
    ASSERT_EQ(scene.objects.size(), 1U);
    EXPECT_EQ(scene.objects[0].name, "good");
    EXPECT_EQ(warnings.size(), 4U);
}

}  // namespace
}  // namespace tessera
