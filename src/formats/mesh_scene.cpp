// Assimp's scene made Tessera's: meshes, nodes, colours.
#include "formats/mesh_scene.h"

#include "formats/cage_faces.h"
#include "formats/gltf_subdivision.h"
#include "formats/mesh_cage.h"
#include "formats/mesh_lights.h"
#include "scene/text.h"
#include "tessera/error.h"
#include "tessera/triangles.h"

#include <assimp/material.h>
#include <assimp/mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tessera {

namespace {

// Cutting a face into triangles takes time by the square of its corners.
constexpr unsigned kMostCorners = 4096;
// In meshes that are there again and again because nodes scale them: some 6 GiB of patches.
constexpr std::size_t kMostCopiedTriangles = std::size_t{1} << 25U;

std::string_view text(const aiString& name) { return {name.data, name.length}; }

glm::dmat4 matrixOf(const aiMatrix4x4& m) {
    // What is below the third row makes no sense in a node.
    return {glm::dvec4(m.a1, m.b1, m.c1, 0.0), glm::dvec4(m.a2, m.b2, m.c2, 0.0), glm::dvec4(m.a3, m.b3, m.c3, 0.0),
            glm::dvec4(m.a4, m.b4, m.c4, 1.0)};
}

// Files round their numbers: this much is no scale.
bool isRigid(const glm::dmat4& m) {
    constexpr double kTolerance = 1e-5;
    const glm::dmat3 linear(m);
    const glm::dmat3 product = glm::transpose(linear) * linear;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            if (!(std::abs(product[column][row] - (row == column ? 1.0 : 0.0)) <= kTolerance)) return false;
        }
        if (!(std::abs(m[3][column]) <= 1e9)) return false;
    }
    return glm::determinant(linear) > 0.0;
}

Transform rigidTransform(const glm::dmat4& m) {
    Transform transform;
    transform.translation = glm::vec3(m[3]);
    transform.rotation = glm::quat(glm::normalize(glm::quat_cast(glm::dmat3(m))));
    return transform;
}

// Works `m` into the mesh.
void bake(const glm::dmat4& m, TriangleMesh& mesh) {
    const glm::dmat3 linear(m);
    // Cofactors: the inverse transpose but for a factor, and there even where an axis is scaled to nothing.
    glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]), glm::cross(linear[0], linear[1]));
    const bool mirrored = glm::determinant(linear) < 0.0;
    if (mirrored) cofactors *= -1.0;
    for (glm::vec3& position : mesh.positions) position = glm::vec3(m * glm::dvec4(position, 1.0));
    for (std::array<glm::vec3, 3>& normals : mesh.normals) {
        for (glm::vec3& normal : normals) {
            const glm::dvec3 turned = cofactors * glm::dvec3(normal);
            const double length = glm::length(turned);
            normal = glm::vec3(length > 0.0 ? turned / length : glm::dvec3(0.0));  // NaN ends up as 0 too: none
        }
        if (mirrored) std::swap(normals[1], normals[2]);
    }
    if (!mirrored) return;
    for (std::array<std::uint32_t, 3>& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

TriangleMesh triangleMesh(const aiMesh& source) {
    TriangleMesh mesh;
    mesh.positions.reserve(source.mNumVertices);
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
        mesh.positions.emplace_back(source.mVertices[i].x, source.mVertices[i].y, source.mVertices[i].z);
    }
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
        const aiFace& face = source.mFaces[i];
        if (face.mNumIndices != 3) continue;
        mesh.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
        if (source.mNormals == nullptr) continue;
        std::array<glm::vec3, 3>& normals = mesh.normals.emplace_back();
        for (unsigned k = 0; k < 3; ++k) {
            const aiVector3D& normal = source.mNormals[face.mIndices[k]];
            normals[k] = {normal.x, normal.y, normal.z};
        }
    }
    return mesh;
}

// White where the file says nothing; Assimp's own default is none of the file's.
glm::vec3 colorOf(const aiScene& source, const aiMesh& mesh) {
    constexpr glm::vec3 kWhite(1.0F);
    if (mesh.mMaterialIndex >= source.mNumMaterials) return kWhite;
    const aiMaterial& material = *source.mMaterials[mesh.mMaterialIndex];
    aiString name;
    aiColor3D diffuse;
    if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && text(name) == AI_DEFAULT_MATERIAL_NAME) return kWhite;
    if (material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) != aiReturn_SUCCESS) return kWhite;
    const glm::vec3 color(diffuse.r, diffuse.g, diffuse.b);
    if (!std::isfinite(color.x) || !std::isfinite(color.y) || !std::isfinite(color.z)) return kWhite;
    return glm::max(color, glm::vec3(0.0F));
}

// "4 triangles left out as duplicates, ...", empty where nothing is worth telling.
// That a file without normals has them computed is no news.
std::string describe(const TriangleRepairs& repairs, bool hadNormals) {
    std::string said;
    const auto tell = [&](std::size_t count, std::string_view what) {
        if (count > 0) said += (said.empty() ? "" : "; ") + std::string(what) + ": " + std::to_string(count);
    };
    tell(repairs.droppedNotFinite, "triangles left out for corners that are not finite or beyond 1e9");
    tell(repairs.droppedBadIndex, "triangles left out for corners that do not exist");
    tell(repairs.droppedDegenerate, "triangles left out for two corners in one place");
    tell(repairs.droppedDuplicates, "triangles left out as duplicates");
    if (hadNormals) tell(repairs.computedNormals, "corners whose normals were computed by angle");
    tell(repairs.flippedTriangles, "triangles turned to agree with their neighbours");
    tell(repairs.unorientedEdges, "edges along which neighbours cannot agree");
    tell(repairs.nonManifoldEdges, "edges of three or more triangles");
    return said;
}

class SceneMaker {
public:
    SceneMaker(const aiScene& source, const MeshReading& reading, const MeshNotes& notes)
        : source_(source), reading_(reading), notes_(notes) {}

    Scene make() {
        scene_.name = notes_.file();
        if (source_.mRootNode != nullptr) placeNodes(*source_.mRootNode);
        if (scene_.meshes.empty() && scene_.cages.empty()) {
            notes_.fail(firstFailure_.empty() ? "there is no triangle in it; give a file with a mesh that nodes place" : firstFailure_);
        }
        const NodePlace place = [&](const aiString& name) {
            const auto found = places_.find(std::string(text(name)));
            return found == places_.end() ? glm::dmat4(1.0) : found->second;
        };
        addMeshLights(source_, place, notes_, scene_);
        addMeshCameras(source_, place, notes_, scene_);
        return std::move(scene_);
    }

private:
    // What makes a mesh of the scene: one of the file's, and what is worked into it.
    using MeshKey = std::pair<unsigned, std::array<double, 12>>;

    // From the root down, a node before its children. Without recursion: files may nest as deep as they like.
    void placeNodes(const aiNode& root) {
        std::vector<std::pair<const aiNode*, glm::dmat4>> waiting{{&root, glm::dmat4(1.0)}};
        while (!waiting.empty()) {
            const auto [node, parent] = waiting.back();
            waiting.pop_back();
            const glm::dmat4 place = parent * matrixOf(node->mTransformation);
            places_.emplace(std::string(text(node->mName)), place);
            for (unsigned i = 0; i < node->mNumMeshes; ++i) placeMesh(*node, node->mMeshes[i], place);
            for (unsigned i = node->mNumChildren; i-- > 0;) waiting.emplace_back(node->mChildren[i], place);
        }
    }

    void placeMesh(const aiNode& node, unsigned index, const glm::dmat4& place) {
        const bool rigid = isRigid(place);
        const std::optional<std::string> mesh = meshName(index, rigid ? glm::dmat4(1.0) : place);
        if (!mesh.has_value()) return;
        Object object;
        object.mesh = *mesh;
        object.name = objectNames_.make(node.mNumMeshes == 1 && node.mName.length > 0 ? text(node.mName) : object.mesh);
        if (rigid) object.transform = rigidTransform(place);
        object.color = colorOf(source_, *source_.mMeshes[index]);
        scene_.objects.push_back(std::move(object));
    }

    // The scene's mesh for one of the file's, made when it is first asked for; none where it cannot be drawn.
    std::optional<std::string> meshName(unsigned index, const glm::dmat4& baked) {
        MeshKey key{index, {}};
        for (int k = 0; k < 12; ++k) key.second[static_cast<std::size_t>(k)] = baked[k / 3][k % 3];
        // NaN has no order.
        if (std::any_of(key.second.begin(), key.second.end(), [](double value) { return !std::isfinite(value); })) {
            leaveOut(index, "its node's transform is not finite; repair it");
            return std::nullopt;
        }
        const auto [found, isNew] = made_.try_emplace(key);
        if (isNew) found->second = makeMesh(index, baked);
        return found->second;
    }

    // Its name in the file, and what the file says of its cage.
    [[nodiscard]] GltfSubdivision::Primitive primitive(unsigned index) const {
        const std::string_view name = text(source_.mMeshes[index]->mName);
        return reading_.subdivision == nullptr ? GltfSubdivision::Primitive{std::string(name), nullptr} : reading_.subdivision->find(name);
    }

    void countCopies(std::size_t faces, const glm::dmat4& baked) {
        if (baked == glm::dmat4(1.0)) return;
        copiedTriangles_ += faces;
        if (copiedTriangles_ <= kMostCopiedTriangles) return;
        notes_.fail("scaled nodes make copies of more than " + std::to_string(kMostCopiedTriangles) +
                    " triangles; apply the scales, or split the file");
    }

    std::optional<std::string> makeMesh(unsigned index, const glm::dmat4& baked) {
        const GltfSubdivision::Primitive primitive = this->primitive(index);
        const bool isCage = reading_.cages && (reading_.scheme.has_value() || (primitive.cage != nullptr && primitive.cage->tagged));
        return isCage ? makeCage(index, baked, primitive) : makeTriangles(index, baked, primitive.name);
    }

    std::optional<std::string> makeCage(unsigned index, const glm::dmat4& baked, const GltfSubdivision::Primitive& primitive) {
        const aiMesh& source = *source_.mMeshes[index];
        const std::string item = "mesh " + quotedName(primitive.name);
        if (primitive.cage != nullptr && primitive.cage->tagged && primitive.cage->vertices != source.mNumVertices) {
            notes_.fail(item + ": Assimp made " + std::to_string(source.mNumVertices) + " vertices of its " +
                        std::to_string(primitive.cage->vertices) + ", so that their numbers are lost; use OBJ, or another Assimp");
        }
        Cage cage = primitive.cage == nullptr ? cageOf(source, {}, false) : cageOf(source, primitive.cage->tags, primitive.cage->ngons);
        if (cage.faceSizes.empty()) {
            leaveOut(index, "there is no polygon in it; give a mesh with faces");
            return std::nullopt;
        }
        if (!cage.holes.empty() && primitive.cage->highestHole >= cage.faceCount()) {
            notes_.fail(item + ": hole " + std::to_string(primitive.cage->highestHole) + " is none of its " +
                        std::to_string(cage.faceCount()) + " faces; repair it");
        }
        if (reading_.scheme.has_value()) cage.scheme = *reading_.scheme;
        cage.name = meshNames_.make(primitive.name);
        countCopies(cage.faceCount(), baked);
        if (baked != glm::dmat4(1.0)) bakeCage(baked, cage);
        dropUnplacedFaces(cage, notes_);
        scene_.cages.push_back(std::move(cage));
        return scene_.cages.back().name;
    }

    std::optional<std::string> makeTriangles(unsigned index, const glm::dmat4& baked, const std::string& name) {
        const aiMesh& source = *source_.mMeshes[index];
        TriangleMesh triangles = triangleMesh(source);
        if (triangles.triangles.empty()) {
            leaveOut(index, "there is no triangle in it; give a mesh with faces");
            return std::nullopt;
        }
        countCopies(triangles.triangles.size(), baked);
        if (baked != glm::dmat4(1.0)) bake(baked, triangles);
        triangles.name = name;
        TriangleRepairs repairs;
        try {
            Mesh mesh = pnMesh(triangles, reading_.flat, &repairs);
            mesh.name = meshNames_.make(triangles.name);
            if (const std::string said = describe(repairs, !triangles.normals.empty()); !said.empty())
                notes_.warn("mesh " + quotedName(mesh.name) + ": " + said);
            scene_.meshes.push_back(std::move(mesh));
        } catch (const Error& error) {
            leaveOut(error.what());
            return std::nullopt;
        }
        return scene_.meshes.back().name;
    }

    void leaveOut(unsigned index, const std::string& why) { leaveOut("mesh " + quotedName(primitive(index).name) + ": " + why); }

    void leaveOut(const std::string& why) {
        notes_.warn(why + " (left out)");
        if (firstFailure_.empty()) firstFailure_ = why;
    }

    const aiScene& source_;
    MeshReading reading_;
    const MeshNotes& notes_;
    Scene scene_;
    std::map<MeshKey, std::optional<std::string>> made_;
    std::unordered_map<std::string, glm::dmat4> places_;
    UniqueNames meshNames_{"mesh"};
    UniqueNames objectNames_{"object"};
    std::size_t copiedTriangles_ = 0;
    std::string firstFailure_;
};

// Returns the most corners of a face.
unsigned checkFaces(const aiMesh& mesh, const std::string& item, const MeshNotes& notes) {
    if (mesh.mNumVertices > 0 && mesh.mVertices == nullptr) notes.fail(item + ": has no positions; repair or remove it");
    if (mesh.mNumFaces > 0 && mesh.mFaces == nullptr) notes.fail(item + ": has no faces; repair or remove it");
    unsigned most = 0;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        most = std::max(most, face.mNumIndices);
        const auto where = [&] { return item + ", face " + std::to_string(f) + ": "; };
        if (face.mNumIndices > kMostCorners) {
            notes.fail(where() + std::to_string(face.mNumIndices) + " corners are more than the " + std::to_string(kMostCorners) +
                       " of a face; cut it into smaller ones");
        }
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            if (face.mIndices[k] < mesh.mNumVertices) continue;
            notes.fail(where() + "a corner is vertex " + std::to_string(face.mIndices[k]) + " of " + std::to_string(mesh.mNumVertices) +
                       "; repair or remove it");
        }
    }
    return most;
}

}  // namespace

MeshFaces checkMeshScene(const aiScene& source, const MeshNotes& notes) {
    unsigned most = 0;
    for (unsigned m = 0; m < source.mNumMeshes; ++m) {
        most = std::max(most, checkFaces(*source.mMeshes[m], "mesh " + quotedName(text(source.mMeshes[m]->mName)), notes));
    }
    std::vector<const aiNode*> waiting;
    if (source.mRootNode != nullptr) waiting.push_back(source.mRootNode);
    while (!waiting.empty()) {
        const aiNode& node = *waiting.back();
        waiting.pop_back();
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            if (node.mMeshes[i] >= source.mNumMeshes)
                notes.fail("node " + quotedName(text(node.mName)) + " places a mesh that is not there");
        }
        waiting.insert(waiting.end(), node.mChildren, node.mChildren + node.mNumChildren);
    }
    return most > 3 ? MeshFaces::polygons : MeshFaces::triangles;
}

Scene makeMeshScene(const aiScene& source, const MeshReading& reading, const MeshNotes& notes) {
    return SceneMaker(source, reading, notes).make();
}

}  // namespace tessera
