// Faces of a cage that can be drawn.
#include <opensubdiv/far/types.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "scene/text.h"
#include "subdivision/clean_cage_parts.h"
#include "tessera/error.h"

namespace tessera::subdivision {

namespace {

constexpr std::uint32_t kMostNeighbours = OpenSubdiv::Far::VALENCE_LIMIT;
constexpr std::size_t kMostNumbers = std::numeric_limits<std::int32_t>::max();
constexpr float kLargestCoordinate = 1e9F;  // as scenes may measure

// Written so that NaN fails.
bool isPosition(const glm::vec3& p) {
    return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate && std::abs(p.z) <= kLargestCoordinate;
}

[[noreturn]] void refuse(const Cage& cage, const std::string& what) { throw Error("cage " + quotedName(cage.name) + ": " + what); }

// Collects the corners of one face after the other, without those that repeat the one before.
class FaceReader {
public:
    FaceReader(const Cage& cage, CageFaces& faces) : cage_(cage), faces_(faces) {}

    // Whether the face of corners `first` to `first` + `size` - 1 is one; if not nothing is added.
    bool add(std::size_t first, std::size_t size) {
        corners_.clear();
        for (std::size_t corner = first; corner < first + size; ++corner) {
            const std::uint32_t vertex = cage_.faceVertices[corner];
            if (vertex >= cage_.points.size() || !isPosition(cage_.points[vertex])) return false;
            if (corners_.empty() || cage_.faceVertices[corners_.back()] != vertex) corners_.push_back(corner);
        }
        while (corners_.size() > 1 && cage_.faceVertices[corners_.back()] == cage_.faceVertices[corners_.front()]) corners_.pop_back();
        if (corners_.size() < 3 || corners_.size() > kMostNeighbours || repeats()) return false;
        shortened_ += corners_.size() < size ? 1U : 0U;
        for (const std::size_t corner : corners_) {
            faces_.vertices.push_back(cage_.faceVertices[corner]);
            if (!cage_.faceTexturePoints.empty()) faces_.textures.push_back(cage_.faceTexturePoints[corner]);
        }
        faces_.starts.push_back(static_cast<std::uint32_t>(faces_.vertices.size()));
        return true;
    }

    // Faces that lost corners.
    [[nodiscard]] std::size_t shortened() const { return shortened_; }

private:
    bool repeats() {
        sorted_.clear();
        for (const std::size_t corner : corners_) sorted_.push_back(cage_.faceVertices[corner]);
        std::sort(sorted_.begin(), sorted_.end());
        return std::adjacent_find(sorted_.begin(), sorted_.end()) != sorted_.end();
    }

    const Cage& cage_;
    CageFaces& faces_;
    std::vector<std::size_t> corners_;
    std::vector<std::uint32_t> sorted_;
    std::size_t shortened_ = 0;
};

// A face's vertices read from its least one towards the lesser neighbour of that: the same for every way to write the face.
class FaceReading {
public:
    FaceReading(const CageFaces& faces, std::uint32_t face)
        : vertices_(faces.vertices.data() + faces.starts[face]), size_(faces.size(face)) {
        first_ = static_cast<std::uint32_t>(std::min_element(vertices_, vertices_ + size_) - vertices_);
        const std::uint32_t next = vertices_[(first_ + 1) % size_], last = vertices_[(first_ + size_ - 1) % size_];
        step_ = next < last ? 1 : size_ - 1;
    }

    [[nodiscard]] std::uint32_t size() const { return size_; }

    // Below, at or above 0 as this reading comes before, with or after the other of the same size.
    [[nodiscard]] int compare(const FaceReading& other) const {
        std::uint32_t here = first_, there = other.first_;
        for (std::uint32_t k = 0; k < size_; ++k) {
            if (vertices_[here] != other.vertices_[there]) return vertices_[here] < other.vertices_[there] ? -1 : 1;
            here = (here + step_) % size_;
            there = (there + other.step_) % size_;
        }
        return 0;
    }

private:
    const std::uint32_t* vertices_;
    std::uint32_t size_;
    std::uint32_t first_ = 0;
    std::uint32_t step_ = 1;
};

// Of faces with the same vertices, whichever way round, all but the first.
std::vector<bool> findDuplicates(const CageFaces& faces) {
    std::vector<std::uint32_t> order(faces.count());
    std::iota(order.begin(), order.end(), 0U);
    std::vector<FaceReading> readings;
    readings.reserve(faces.count());
    for (const std::uint32_t face : order) readings.emplace_back(faces, face);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        if (readings[a].size() != readings[b].size()) return readings[a].size() < readings[b].size();
        const int compared = readings[a].compare(readings[b]);
        return compared != 0 ? compared < 0 : a < b;
    });
    std::vector<bool> dropped(faces.count());
    for (std::size_t i = 1; i < order.size(); ++i) {
        const FaceReading &here = readings[order[i]], &before = readings[order[i - 1]];
        dropped[order[i]] = here.size() == before.size() && here.compare(before) == 0;
    }
    return dropped;
}

// Faces at vertices of more faces than OpenSubdiv can count, leaving one for the further edge that boundary vertices have.
std::vector<bool> findCrowded(const CageFaces& faces, std::size_t vertices) {
    std::vector<std::uint32_t> users(vertices, 0);
    for (const std::uint32_t vertex : faces.vertices) ++users[vertex];
    std::vector<bool> dropped(faces.count());
    for (std::size_t face = 0; face < faces.count(); ++face) {
        dropped[face] = std::any_of(faces.vertices.begin() + faces.starts[face], faces.vertices.begin() + faces.starts[face + 1],
                                    [&](std::uint32_t vertex) { return users[vertex] >= kMostNeighbours; });
    }
    return dropped;
}

// Leaves out the faces that `dropped` marks; returns how many.
std::size_t removeMarked(CageFaces& faces, const std::vector<bool>& dropped) {
    CageFaces kept;
    for (std::size_t face = 0; face < faces.count(); ++face) {
        if (dropped[face]) continue;
        const auto first = faces.starts[face], end = faces.starts[face + 1];
        kept.vertices.insert(kept.vertices.end(), faces.vertices.begin() + first, faces.vertices.begin() + end);
        if (!faces.textures.empty())
            kept.textures.insert(kept.textures.end(), faces.textures.begin() + first, faces.textures.begin() + end);
        kept.starts.push_back(static_cast<std::uint32_t>(kept.vertices.size()));
        kept.faceOf.push_back(faces.faceOf[face]);
    }
    const std::size_t removed = faces.count() - kept.count();
    if (removed != 0) faces = std::move(kept);
    return removed;
}

}  // namespace

void checkCageLists(const Cage& cage) {
    const std::size_t corners = cage.faceVertices.size();
    if (corners > kMostNumbers || cage.points.size() > kMostNumbers || cage.texturePoints.size() > kMostNumbers) {
        refuse(cage, "more than 2147483647 vertices, texture points or corners of faces; split it");
    }
    std::uint64_t sum = 0;
    for (const std::uint32_t size : cage.faceSizes) sum += size;
    if (sum != corners) {
        refuse(cage, "its faces' sizes add up to " + std::to_string(sum) + ", but it lists " + std::to_string(corners) +
                         " corners; give a vertex for each corner of each face");
    }
    if (cage.faceTexturePoints.empty()) return;
    if (cage.faceTexturePoints.size() != corners) {
        refuse(cage, std::to_string(cage.faceTexturePoints.size()) + " texture numbers for " + std::to_string(corners) +
                         " corners; give one a corner, or none");
    }
    const std::uint32_t greatest = *std::max_element(cage.faceTexturePoints.begin(), cage.faceTexturePoints.end());
    if (greatest < cage.texturePoints.size()) return;
    refuse(cage, "a corner has texture point " + std::to_string(greatest) + " of " + std::to_string(cage.texturePoints.size()) +
                     "; number them from 0");
}

CageFaces usableFaces(const Cage& cage, CageReport& report) {
    CageFaces faces;
    FaceReader reader(cage, faces);
    std::size_t first = 0, tooLarge = 0;
    for (std::size_t face = 0; face < cage.faceCount(); first += cage.faceSizes[face++]) {
        if (reader.add(first, cage.faceSizes[face])) {
            faces.faceOf.push_back(static_cast<std::uint32_t>(face));
        } else {
            ++report.droppedFaces;
            tooLarge += cage.faceSizes[face] > kMostNeighbours ? 1U : 0U;
        }
    }
    const std::string limit = std::to_string(kMostNeighbours);
    noteCount(report, reader.shortened(), "face", "kept without corners that repeat the one before");
    noteCount(report, tooLarge, "face", "of more than " + limit + " corners left out");
    report.droppedFaces += removeMarked(faces, findDuplicates(faces));
    const std::size_t crowded = removeMarked(faces, findCrowded(faces, cage.points.size()));
    noteCount(report, crowded, "face", "left out at vertices of " + limit + " faces or more");
    report.droppedFaces += crowded;
    return faces;
}

}  // namespace tessera::subdivision
