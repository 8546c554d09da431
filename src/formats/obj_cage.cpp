// Reads OBJ files as cages: faces by object, tags to the objects that they belong to, colours of material files.
#include "formats/obj_cage.h"

#include "formats/cage_faces.h"
#include "formats/obj_file.h"
#include "formats/obj_lines.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace tessera {

namespace {

constexpr glm::vec3 kWhite(1.0F);

std::optional<std::string> readText(MeshFolder& folder, const std::filesystem::path& path) {
    const std::unique_ptr<Assimp::IOStream> stream = folder.open(path.c_str());
    if (stream == nullptr) return std::nullopt;
    std::string text(stream->FileSize(), '\0');
    if (!text.empty()) text.resize(stream->Read(text.data(), 1, text.size()));
    return text;
}

// Diffuse colours by material.
using Colors = std::unordered_map<std::string, glm::vec3>;

void readColors(std::string_view text, Colors& colors) {
    std::string material;
    for (ObjLines lines(text); lines.next();) {
        const auto& words = lines.words();
        if (words[0] == "newmtl") material = lines.rest();
        if (words[0] != "Kd" || words.size() < 4) continue;
        glm::vec3 color;
        for (int k = 0; k < 3; ++k) color[k] = static_cast<float>(objNumber(words[static_cast<std::size_t>(k) + 1]).value_or(1.0));
        if (std::isfinite(color.x) && std::isfinite(color.y) && std::isfinite(color.z)) colors[material] = glm::max(color, glm::vec3(0.0F));
    }
}

Colors readColors(const ObjFile& file, MeshFolder& folder, const MeshNotes& notes) {
    Colors colors;
    for (const std::string& name : file.materialFiles) {
        const std::size_t refused = folder.refused().size();
        const std::optional<std::string> text = readText(folder, std::filesystem::path(notes.file()).parent_path() / name);
        if (text.has_value()) {
            readColors(*text, colors);
        } else if (folder.refused().size() == refused) {
            notes.warn("material file " + quotedName(name) + " cannot be read: its colours are white");
        }
    }
    return colors;
}

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) { return (std::uint64_t{std::min(a, b)} << 32U) | std::max(a, b); }

// The file's tags by what they are on, and whether any object has it.
template <typename Key>
struct TagTable {
    struct Entry {
        float sharpness = 0;
        bool used = false;
    };
    std::unordered_map<Key, Entry> entries;

    [[nodiscard]] std::size_t unused() const {
        return static_cast<std::size_t>(std::count_if(entries.begin(), entries.end(), [](const auto& one) { return !one.second.used; }));
    }
};

class CageMaker {
public:
    CageMaker(const ObjFile& file, SubdivisionScheme scheme, Colors colors, const MeshNotes& notes)
        : file_(file), scheme_(scheme), colors_(std::move(colors)), notes_(notes) {}

    Scene make() {
        scene_.name = notes_.file();
        sortFaces();
        if (objects_ == 1) {
            makeWhole();
        } else {
            makeParts();
        }
        return std::move(scene_);
    }

private:
    // Where each face's corners begin, and faces object after object.
    void sortFaces() {
        std::vector<std::size_t> counts(file_.objects.size() + 1, 0);
        std::size_t corner = 0;
        for (const ObjFile::Face& face : file_.faces) {
            firstCorner_.push_back(corner);
            corner += face.size;
            ++counts[face.object + 1];
        }
        objects_ = static_cast<std::size_t>(std::count_if(counts.begin() + 1, counts.end(), [](std::size_t n) { return n > 0; }));
        for (std::size_t i = 1; i < counts.size(); ++i) counts[i] += counts[i - 1];
        firstFace_ = counts;
        sorted_.resize(file_.faces.size());
        for (std::uint32_t face = 0; face < file_.faces.size(); ++face) sorted_[counts[file_.faces[face].object]++] = face;
    }

    [[nodiscard]] std::span<const std::uint32_t> facesOf(std::size_t object) const {
        return std::span(sorted_).subspan(firstFace_[object], firstFace_[object + 1] - firstFace_[object]);
    }

    // A single object: all vertices, and tags as they are.
    void makeWhole() {
        const std::uint32_t object = file_.faces[0].object;
        Cage cage = facesOnly(object);
        cage.points = file_.points;
        cage.creases = file_.creases;
        cage.corners = file_.corners;
        cage.holes = file_.holes;
        add(std::move(cage), object);
    }

    void makeParts() {
        for (const Crease& crease : file_.creases) creases_.entries[edgeKey(crease.a, crease.b)].sharpness = crease.sharpness;
        for (const Corner& corner : file_.corners) corners_.entries[corner.vertex].sharpness = corner.sharpness;
        holes_.insert(file_.holes.begin(), file_.holes.end());
        for (std::uint32_t object = 0; object < file_.objects.size(); ++object) {
            if (!facesOf(object).empty()) makePart(object);
        }
        if (const std::size_t unused = creases_.unused(); unused > 0)
            notes_.warn("creases left out that are on no edge of an object: " + std::to_string(unused));
        if (const std::size_t unused = corners_.unused(); unused > 0)
            notes_.warn("corners left out that are vertices of no object: " + std::to_string(unused));
    }

    void makePart(std::uint32_t object) {
        Cage cage = facesOnly(object);
        addCreases(cage);
        const std::vector<std::uint32_t> vertices = renumber(cage.faceVertices);
        for (std::uint32_t i = 0; i < vertices.size(); ++i) {
            cage.points.push_back(file_.points[vertices[i]]);
            const auto corner = corners_.entries.find(vertices[i]);
            if (corner == corners_.entries.end()) continue;
            cage.corners.push_back({i, corner->second.sharpness});
            corner->second.used = true;
        }
        for (Crease& crease : cage.creases) {
            for (std::uint32_t* const end : {&crease.a, &crease.b}) {
                *end = static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), *end) - vertices.begin());
            }
        }
        std::uint32_t number = 0;
        for (const std::uint32_t face : facesOf(object)) {
            if (holes_.contains(face)) cage.holes.push_back(number);
            ++number;
        }
        add(std::move(cage), object);
    }

    // Those on an edge of a face, each once, with the file's numbers.
    void addCreases(Cage& cage) {
        if (creases_.entries.empty()) return;
        std::unordered_set<std::uint64_t> seen;
        std::size_t first = 0;
        for (const std::uint32_t size : cage.faceSizes) {
            for (std::size_t k = 0; k < size; ++k) {
                const std::uint32_t a = cage.faceVertices[first + k], b = cage.faceVertices[first + (k + 1) % size];
                const auto crease = creases_.entries.find(edgeKey(a, b));
                if (crease == creases_.entries.end() || !seen.insert(crease->first).second) continue;
                cage.creases.push_back({std::min(a, b), std::max(a, b), crease->second.sharpness});
                crease->second.used = true;
            }
            first += size;
        }
    }

    // Faces with the file's numbers of vertices, and texture points of their own.
    Cage facesOnly(std::uint32_t object) {
        Cage cage;
        cage.scheme = scheme_;
        cage.boundary = file_.boundary.value_or(cage.boundary);
        for (const std::uint32_t face : facesOf(object)) {
            cage.faceSizes.push_back(file_.faces[face].size);
            for (std::size_t k = 0; k < file_.faces[face].size; ++k) {
                cage.faceVertices.push_back(file_.faceVertices[firstCorner_[face] + k]);
                cage.faceTexturePoints.push_back(file_.faceTexturePoints[firstCorner_[face] + k]);
            }
        }
        const auto missing = std::count(cage.faceTexturePoints.begin(), cage.faceTexturePoints.end(), ObjFile::kNone);
        if (missing == 0) {
            for (const std::uint32_t one : renumber(cage.faceTexturePoints)) cage.texturePoints.push_back(file_.texturePoints[one]);
            return cage;
        }
        if (missing < static_cast<std::ptrdiff_t>(cage.faceTexturePoints.size())) {
            notes_.warn("object " + quotedName(file_.objects[object]) + ": some corners have no texture point: none is taken");
        }
        cage.faceTexturePoints.clear();
        return cage;
    }

    void add(Cage cage, std::uint32_t number) {
        cage.name = names_.make(file_.objects[number]);
        dropUnplacedFaces(cage, notes_);
        Object object;
        object.name = cage.name;
        object.mesh = cage.name;
        object.color = colorOf(number);
        scene_.objects.push_back(std::move(object));
        scene_.cages.push_back(std::move(cage));
    }

    // Of the material that most faces have; of equal ones the first in the file.
    glm::vec3 colorOf(std::uint32_t object) const {
        std::unordered_map<std::uint32_t, std::size_t> counts;
        for (const std::uint32_t face : facesOf(object)) ++counts[file_.faces[face].material];
        const auto most = std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
            return a.second != b.second ? a.second < b.second : a.first > b.first;
        });
        if (counts.size() > 1) {
            notes_.warn("object " + quotedName(file_.objects[object]) + " has " + std::to_string(counts.size()) +
                        " materials: it takes the colour of the one that most faces have");
        }
        if (most->first == ObjFile::kNone) return kWhite;
        const auto found = colors_.find(file_.materials[most->first]);
        return found == colors_.end() ? kWhite : found->second;
    }

    const ObjFile& file_;
    SubdivisionScheme scheme_;
    Colors colors_;
    const MeshNotes& notes_;
    Scene scene_;
    UniqueNames names_{"mesh"};
    std::size_t objects_ = 0;               // that have faces
    std::vector<std::size_t> firstCorner_;  // of each face
    std::vector<std::size_t> firstFace_;    // of each object in sorted_, and the end
    std::vector<std::uint32_t> sorted_;
    TagTable<std::uint64_t> creases_;
    TagTable<std::uint32_t> corners_;
    std::unordered_set<std::uint32_t> holes_;
};

}  // namespace

Scene readObjCages(std::string_view text, SubdivisionScheme scheme, MeshFolder& folder, const MeshNotes& notes) {
    const ObjFile file = parseObj(text, notes);
    if (file.faces.empty()) notes.fail("there is no face in it; give a file with a mesh");
    return CageMaker(file, scheme, readColors(file, folder, notes), notes).make();
}

}  // namespace tessera
