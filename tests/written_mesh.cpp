// Small readers of the formats, and what they find held against the mesh as the host made it.
#include "written_mesh.h"

#include "mesh/pattern.h"

#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <assimp/Importer.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace tessera::test {
namespace {

// Values one after the other from bytes.
class Reader {
public:
    explicit Reader(std::string bytes, std::size_t at = 0) : bytes_(std::move(bytes)), at_(at) {}

    template <typename T>
    T get() {
        T value{};
        EXPECT_LE(at_ + sizeof(T), bytes_.size());
        if (at_ + sizeof(T) <= bytes_.size()) std::memcpy(&value, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return value;
    }
    std::string line() {
        const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
        std::string text = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        return text;
    }
    [[nodiscard]] bool atEnd() const { return at_ >= bytes_.size(); }
    [[nodiscard]] std::size_t at() const { return at_; }

private:
    std::string bytes_;
    std::size_t at_;
};

struct PlyHeader {
    std::size_t vertices = 0, faces = 0;
    bool vertexAttributes = false, faceAttributes = false;
};

PlyHeader readPlyHeader(Reader& in) {
    PlyHeader header;
    std::string word;
    EXPECT_EQ(in.line(), "ply");
    EXPECT_EQ(in.line(), "format binary_little_endian 1.0");
    for (std::string text = in.line(); text != "end_header" && !in.atEnd(); text = in.line()) {
        std::istringstream(text.starts_with("element vertex ") ? text.substr(15) : "") >> header.vertices;
        std::istringstream(text.starts_with("element face ") ? text.substr(13) : "") >> header.faces;
        if (text == "property float nx") header.vertexAttributes = true;
        if (text == "property list uchar float normals") header.faceAttributes = true;
    }
    return header;
}

template <std::size_t Count>
std::array<float, Count> getFloats(Reader& in) {
    return in.get<std::array<float, Count>>();
}

Face facesAmong(const std::vector<Corner>& vertices, const std::vector<std::size_t>& numbers) {
    Face face;
    for (const std::size_t number : numbers) {
        EXPECT_LT(number, vertices.size());
        face.corners.push_back(number < vertices.size() ? vertices[number] : Corner{});
    }
    return face;
}

Corner cornerOf(const MeshVertex& v, bool attributes) {
    Corner corner;
    std::copy_n(v.position, 3, corner.position.begin());
    if (!attributes) return corner;
    std::copy_n(v.normal, 3, corner.normal.begin());
    corner.uv = {v.u, v.v};
    return corner;
}

// The elements of an accessor, each `Count` values, checked against its view and buffer.
template <typename T, std::size_t Count>
std::vector<std::array<T, Count>> elementsOf(const nlohmann::json& json, const std::string& binary, std::size_t accessorIndex,
                                             const std::string& type) {
    const nlohmann::json& accessor = json["accessors"].at(accessorIndex);
    const nlohmann::json& view = json["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
    EXPECT_EQ(accessor["type"], type);
    EXPECT_EQ(accessor["componentType"], (std::is_same_v<T, float> ? 5126 : 5125));
    const std::size_t count = accessor["count"], offset = accessor["byteOffset"], stride = view.value("byteStride", sizeof(T) * Count);
    const std::size_t viewAt = view["byteOffset"], viewBytes = view["byteLength"];
    EXPECT_GT(count, 0U);
    EXPECT_EQ(viewAt % 4, 0U);
    EXPECT_EQ(offset % 4, 0U);
    EXPECT_EQ(stride % 4, 0U);
    EXPECT_LE(viewAt + viewBytes, binary.size());
    EXPECT_LE(offset + (count - 1) * stride + sizeof(T) * Count, viewBytes);
    std::vector<std::array<T, Count>> elements(count);
    for (std::size_t k = 0; k < count; ++k)
        std::memcpy(elements[k].data(), binary.data() + viewAt + offset + k * stride, sizeof(T) * Count);
    return elements;
}

void checkBounds(const nlohmann::json& accessor, const std::vector<std::array<float, 3>>& positions) {
    for (std::size_t c = 0; c < 3; ++c) {
        const auto less = [c](const auto& a, const auto& b) { return a[c] < b[c]; };
        const auto [least, most] = std::minmax_element(positions.begin(), positions.end(), less);
        EXPECT_EQ(accessor["min"].at(c).get<float>(), (*least)[c]);
        EXPECT_EQ(accessor["max"].at(c).get<float>(), (*most)[c]);
    }
}

void readGlbMesh(const nlohmann::json& json, const std::string& binary, std::size_t mesh, std::uint32_t object, WrittenMesh& out) {
    const nlohmann::json& primitives = json["meshes"].at(mesh)["primitives"];
    ASSERT_EQ(primitives.size(), 1U);
    const nlohmann::json& attributes = primitives.at(0)["attributes"];
    const auto positions = elementsOf<float, 3>(json, binary, attributes["POSITION"], "VEC3");
    checkBounds(json["accessors"].at(attributes["POSITION"].get<std::size_t>()), positions);
    std::vector<std::array<float, 1>> patches(positions.size());
    std::vector<Corner> vertices(positions.size());
    for (std::size_t k = 0; k < positions.size(); ++k) vertices[k].position = positions[k];
    if (attributes.contains("NORMAL")) {
        const auto normals = elementsOf<float, 3>(json, binary, attributes["NORMAL"], "VEC3");
        const auto uv = elementsOf<float, 2>(json, binary, attributes["TEXCOORD_0"], "VEC2");
        patches = elementsOf<float, 1>(json, binary, attributes["_PATCH_ID"], "SCALAR");
        ASSERT_TRUE(normals.size() == positions.size() && uv.size() == positions.size() && patches.size() == positions.size());
        for (std::size_t k = 0; k < positions.size(); ++k) {
            vertices[k].normal = normals[k];
            vertices[k].uv = uv[k];
        }
    }
    const auto indices = elementsOf<std::uint32_t, 1>(json, binary, primitives.at(0)["indices"], "SCALAR");
    ASSERT_EQ(indices.size() % 3, 0U);
    for (std::size_t k = 0; k < indices.size(); k += 3) {
        Face face = facesAmong(vertices, {indices[k][0], indices[k + 1][0], indices[k + 2][0]});
        face.object = object;
        face.patch = static_cast<std::uint32_t>(patches.at(indices[k][0])[0]);
        out.faces.push_back(face);
    }
    out.vertices += vertices.size();
}

using PositionPair = std::pair<std::array<float, 3>, std::array<float, 3>>;

std::map<PositionPair, int> edgeUses(const std::vector<Face>& faces) {
    std::map<PositionPair, int> uses;
    for (const Face& face : faces) {
        for (std::size_t c = 0; c < face.corners.size(); ++c)
            ++uses[{face.corners[c].position, face.corners[(c + 1) % face.corners.size()].position}];
    }
    return uses;
}

}  // namespace

std::vector<Face> facesOf(const HostMesh& mesh, bool quads, bool attributes, bool object) {
    std::vector<Face> faces;
    for (std::size_t patch = 0; patch < mesh.patches().size(); ++patch) {
        for (std::uint32_t k = 0; k < patternUnits(mesh.patterns[patch]); ++k) {
            const HostMesh::Unit unit = mesh.unit(patch, k);
            const std::size_t alone = quads ? firstCellTriangle(mesh.patterns[patch], k) : unit.indices.size() / 3;
            for (std::size_t t = 0; 3 * t < unit.indices.size(); t += t < alone ? 1 : 2) {
                Face face;
                if (object) face.object = mesh.patches()[patch].object;
                if (attributes) face.patch = mesh.patches()[patch].patch;
                for (std::size_t c = 0; c < (t < alone ? 3U : 4U); ++c)
                    face.corners.push_back(cornerOf(unit.vertices[unit.indices[3 * t + (c < 3 ? c : 5)]], attributes));
                faces.push_back(face);
            }
        }
    }
    return faces;
}

std::string bytesOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

WrittenMesh readPly(const std::filesystem::path& file) {
    Reader in(bytesOf(file));
    const PlyHeader header = readPlyHeader(in);
    std::vector<Corner> vertices(header.vertices);
    std::vector<std::array<std::uint32_t, 2>> ids(header.vertices);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        vertices[k].position = getFloats<3>(in);
        if (!header.vertexAttributes) continue;
        vertices[k].normal = getFloats<3>(in);
        vertices[k].uv = getFloats<2>(in);
        ids[k] = in.get<std::array<std::uint32_t, 2>>();
    }
    WrittenMesh mesh{vertices.size(), {}};
    for (std::size_t k = 0; k < header.faces && !in.atEnd(); ++k) {
        std::vector<std::size_t> numbers(in.get<std::uint8_t>());
        for (std::size_t& number : numbers) number = in.get<std::uint32_t>();
        Face face = facesAmong(vertices, numbers);
        if (header.vertexAttributes) {
            face.object = ids.at(numbers[0])[0];
            face.patch = ids.at(numbers[0])[1];
        }
        if (header.faceAttributes) {
            EXPECT_EQ(in.get<std::uint8_t>(), 2 * numbers.size());
            for (Corner& corner : face.corners) corner.uv = getFloats<2>(in);
            EXPECT_EQ(in.get<std::uint8_t>(), 3 * numbers.size());
            for (Corner& corner : face.corners) corner.normal = getFloats<3>(in);
            face.object = in.get<std::uint32_t>();
            face.patch = in.get<std::uint32_t>();
        }
        mesh.faces.push_back(face);
    }
    EXPECT_TRUE(in.atEnd());
    EXPECT_EQ(mesh.faces.size(), header.faces);
    return mesh;
}

WrittenMesh readObj(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<std::array<float, 3>> positions, normals;
    std::vector<std::array<float, 2>> uv;
    WrittenMesh mesh;
    std::uint32_t objects = 0, patch = 0;
    for (std::string text; std::getline(in, text);) {
        std::istringstream line(text);
        std::string word;
        line >> word;
        if (word == "v" || word == "vn") {
            std::array<float, 3>& v = (word == "v" ? positions : normals).emplace_back();
            line >> v[0] >> v[1] >> v[2];
        } else if (word == "vt") {
            std::array<float, 2>& v = uv.emplace_back();
            line >> v[0] >> v[1];
        } else if (word == "o") {
            ++objects;
        } else if (word == "g") {
            patch = static_cast<std::uint32_t>(std::stoul(text.substr(text.find('_') + 1)));
        } else if (word == "f") {
            Face face{{}, objects - 1, patch};
            for (std::string names; line >> names;) {
                std::size_t v = 0, t = 0, n = 0;
                char slash = 0;
                std::istringstream(names) >> v >> slash >> t >> slash >> n;
                EXPECT_TRUE(v >= 1 && v <= positions.size() && t <= uv.size() && n <= normals.size()) << text;
                face.corners.push_back({positions.at(v - 1), n > 0 ? normals.at(n - 1) : std::array<float, 3>{},
                                        t > 0 ? uv.at(t - 1) : std::array<float, 2>{}});
            }
            mesh.faces.push_back(face);
        }
        EXPECT_FALSE(line.bad()) << text;
    }
    mesh.vertices = positions.size();
    return mesh;
}

WrittenMesh readStl(const std::filesystem::path& file) {
    Reader in(bytesOf(file));
    for (int k = 0; k < 20; ++k) EXPECT_NE(in.get<std::uint32_t>(), 0x696C6F73U);  // "soli"
    const auto count = in.get<std::uint32_t>();
    WrittenMesh mesh{std::size_t{3} * count, {}};
    for (std::uint32_t k = 0; k < count && !in.atEnd(); ++k) {
        const auto normal = getFloats<3>(in);
        Face face;
        for (int c = 0; c < 3; ++c) face.corners.push_back({getFloats<3>(in), normal, {}});
        EXPECT_EQ(in.get<std::uint16_t>(), 0U);
        mesh.faces.push_back(face);
    }
    EXPECT_TRUE(in.atEnd());
    EXPECT_EQ(mesh.faces.size(), count);
    return mesh;
}

WrittenMesh readGlb(const std::filesystem::path& file) {
    const std::string bytes = bytesOf(file);
    Reader in(bytes);
    EXPECT_EQ(in.get<std::uint32_t>(), 0x46546C67U);
    EXPECT_EQ(in.get<std::uint32_t>(), 2U);
    EXPECT_EQ(in.get<std::uint32_t>(), bytes.size());
    const auto jsonBytes = in.get<std::uint32_t>();
    EXPECT_EQ(jsonBytes % 4, 0U);
    EXPECT_EQ(in.get<std::uint32_t>(), 0x4E4F534AU);
    const nlohmann::json json = nlohmann::json::parse(bytes.substr(20, jsonBytes));
    std::string binary;
    if (20U + jsonBytes < bytes.size()) {
        Reader chunk(bytes, 20U + jsonBytes);
        const auto binaryBytes = chunk.get<std::uint32_t>();
        EXPECT_EQ(binaryBytes % 4, 0U);
        EXPECT_EQ(chunk.get<std::uint32_t>(), 0x004E4942U);
        EXPECT_EQ(chunk.at() + binaryBytes, bytes.size());
        EXPECT_EQ(json["buffers"].at(0)["byteLength"], binaryBytes);
        binary = bytes.substr(chunk.at());
    }
    EXPECT_EQ(json["asset"]["version"], "2.0");
    WrittenMesh mesh;
    std::uint32_t object = 0;
    for (const nlohmann::json& node : json.value("nodes", nlohmann::json::array())) {
        if (node.contains("mesh")) readGlbMesh(json, binary, node["mesh"], object, mesh);
        ++object;
    }
    EXPECT_EQ(json["scenes"].at(0).value("nodes", nlohmann::json::array()).size(), object);
    return mesh;
}

WrittenMesh readWithAssimp(const std::filesystem::path& file) {
    Assimp::Importer importer;
    const aiScene* const scene = importer.ReadFile(file.string(), 0);
    EXPECT_NE(scene, nullptr) << importer.GetErrorString();
    WrittenMesh mesh;
    for (unsigned m = 0; scene != nullptr && m < scene->mNumMeshes; ++m) {
        const aiMesh& part = *scene->mMeshes[m];
        mesh.vertices += part.mNumVertices;
        for (unsigned f = 0; f < part.mNumFaces; ++f) {
            Face face;
            for (unsigned c = 0; c < part.mFaces[f].mNumIndices; ++c) {
                const unsigned k = part.mFaces[f].mIndices[c];
                Corner corner;
                corner.position = {part.mVertices[k].x, part.mVertices[k].y, part.mVertices[k].z};
                if (part.HasNormals()) corner.normal = {part.mNormals[k].x, part.mNormals[k].y, part.mNormals[k].z};
                if (part.HasTextureCoords(0)) corner.uv = {part.mTextureCoords[0][k].x, part.mTextureCoords[0][k].y};
                face.corners.push_back(corner);
            }
            mesh.faces.push_back(face);
        }
    }
    return mesh;
}

std::size_t openEdges(const std::vector<Face>& faces) {
    const std::map<PositionPair, int> uses = edgeUses(faces);
    return static_cast<std::size_t>(std::count_if(uses.begin(), uses.end(), [&](const auto& use) {
        const auto back = uses.find({use.first.second, use.first.first});
        return use.second + (back == uses.end() ? 0 : back->second) != 2;
    }));
}

std::size_t openOrTurnedEdges(const std::vector<Face>& faces) {
    const std::map<PositionPair, int> uses = edgeUses(faces);
    return static_cast<std::size_t>(std::count_if(uses.begin(), uses.end(), [&](const auto& use) {
        const auto back = uses.find({use.first.second, use.first.first});
        return use.second != 1 || back == uses.end() || back->second != 1;
    }));
}

}  // namespace tessera::test
