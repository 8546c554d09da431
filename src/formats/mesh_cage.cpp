// Assimp's meshes as cages: what it splits at seams of normals and texture coordinates is put together again.
#include "formats/mesh_cage.h"

#include "formats/cage_faces.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tessera {

namespace {

// Whether `face` goes on with the n-gon whose latest triangle is `before`: a fan around its first corner.
bool goesOn(const aiFace& before, const aiFace& face) {
    return face.mNumIndices == 3 && before.mNumIndices == 3 && face.mIndices[0] == before.mIndices[0] &&
           face.mIndices[1] == before.mIndices[2];
}

void addFaces(const aiMesh& source, bool ngons, Cage& cage) {
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
        const aiFace& face = source.mFaces[f];
        if (ngons && f > 0 && !cage.faceSizes.empty() && goesOn(source.mFaces[f - 1], face)) {
            ++cage.faceSizes.back();
            cage.faceVertices.push_back(face.mIndices[2]);
            continue;
        }
        if (face.mNumIndices < 3) continue;
        cage.faceSizes.push_back(face.mNumIndices);
        cage.faceVertices.insert(cage.faceVertices.end(), face.mIndices, face.mIndices + face.mNumIndices);
    }
}

// Of the mesh's vertices; 0 and -0 are one place.
std::vector<std::uint32_t> addPoints(const aiMesh& source, Cage& cage) {
    std::vector<std::array<std::uint32_t, 3>> keys;
    keys.reserve(source.mNumVertices);
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value + 0.0F); };
    for (const aiVector3D& p : std::span(source.mVertices, source.mNumVertices)) keys.push_back({bits(p.x), bits(p.y), bits(p.z)});
    std::vector<std::uint32_t> numbers = numberEqual(keys);
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
        if (numbers[i] != cage.points.size()) continue;
        cage.points.emplace_back(source.mVertices[i].x, source.mVertices[i].y, source.mVertices[i].z);
    }
    return numbers;
}

// Requires faces of the mesh's own vertices.
void addTexture(const aiMesh& source, std::span<const std::uint32_t> pointOf, Cage& cage) {
    if (source.mTextureCoords[0] == nullptr) return;
    const std::span coordinates(source.mTextureCoords[0], source.mNumVertices);
    std::vector<std::array<std::uint32_t, 3>> keys;
    keys.reserve(coordinates.size());
    for (const aiVector3D& c : coordinates) {
        keys.push_back({pointOf[keys.size()], std::bit_cast<std::uint32_t>(c.x), std::bit_cast<std::uint32_t>(c.y)});
    }
    const std::vector<std::uint32_t> numbers = numberEqual(keys);
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
        if (numbers[i] == cage.texturePoints.size()) cage.texturePoints.emplace_back(coordinates[i].x, coordinates[i].y);
    }
    for (const std::uint32_t vertex : cage.faceVertices) cage.faceTexturePoints.push_back(numbers[vertex]);
}

}  // namespace

Cage cageOf(const aiMesh& source, Cage tags, bool ngons) {
    Cage cage = std::move(tags);
    if (cage.faceSizes.empty()) addFaces(source, ngons || (source.mPrimitiveTypes & aiPrimitiveType_NGONEncodingFlag) != 0, cage);
    const std::vector<std::uint32_t> pointOf = addPoints(source, cage);
    addTexture(source, pointOf, cage);
    for (std::uint32_t& vertex : cage.faceVertices) vertex = pointOf[vertex];
    for (Crease& crease : cage.creases) crease = {pointOf[crease.a], pointOf[crease.b], crease.sharpness};
    for (Corner& corner : cage.corners) corner.vertex = pointOf[corner.vertex];
    return cage;
}

void bakeCage(const glm::dmat4& m, Cage& cage) {
    for (glm::vec3& point : cage.points) point = glm::vec3(m * glm::dvec4(point, 1.0));
    if (glm::determinant(glm::dmat3(m)) < 0.0) turnFaces(cage);
}

}  // namespace tessera
