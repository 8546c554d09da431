// Cages in .mscene files, read and written.
#include "formats/mscene_cage.h"

#include "formats/mscene_lists.h"
#include "scene/text.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tessera {

namespace {

SubdivisionScheme readScheme(const MsceneReading& reading, schema::Cage::Reader source, const std::string& item) {
    switch (source.getScheme()) {
        case schema::Cage::Scheme::CATMULL_CLARK:
            return SubdivisionScheme::catmullClark;
        case schema::Cage::Scheme::LOOP:
            return SubdivisionScheme::loop;
        case schema::Cage::Scheme::BILINEAR:
            return SubdivisionScheme::bilinear;
        case schema::Cage::Scheme::NONE:
            return SubdivisionScheme::none;
    }
    // A file may hold any number here.
    reading.fail(item + ": unknown scheme " + std::to_string(static_cast<int>(source.getScheme())) +
                 "; use catmullClark, loop, bilinear or none");
}

BoundaryRule readBoundary(const MsceneReading& reading, schema::Cage::Reader source, const std::string& item) {
    switch (source.getBoundary()) {
        case schema::Cage::Boundary::NONE:
            return BoundaryRule::none;
        case schema::Cage::Boundary::EDGE_AND_CORNER:
            return BoundaryRule::edgeAndCorner;
        case schema::Cage::Boundary::EDGE_ONLY:
            return BoundaryRule::edgeOnly;
    }
    reading.fail(item + ": unknown boundary rule " + std::to_string(static_cast<int>(source.getBoundary())) +
                 "; use none, edgeAndCorner or edgeOnly");
}

// `count` numbers a point.
template <typename Point>
std::vector<Point> readPoints(const MsceneReading& reading, capnp::List<float>::Reader numbers, const std::string& what) {
    constexpr auto count = static_cast<std::uint32_t>(Point::length());
    if (numbers.size() % count != 0) {
        reading.fail(what + ": " + std::to_string(numbers.size()) + " numbers are no multiple of the " + std::to_string(count) +
                     " of a point; give whole points");
    }
    std::vector<Point> points(numbers.size() / count);
    for (std::uint32_t i = 0; i < numbers.size(); ++i) points[i / count][static_cast<int>(i % count)] = numbers[i];
    return points;
}

std::vector<std::uint32_t> readNumbers(capnp::List<std::uint32_t>::Reader numbers) {
    std::vector<std::uint32_t> read;
    read.reserve(numbers.size());
    for (const std::uint32_t number : numbers) read.push_back(number);
    return read;
}

void readTags(const MsceneReading& reading, schema::Cage::Reader source, Cage& cage) {
    const auto creases = source.getCreases();
    reading.checkItems("crease", creases.size(), 1);
    for (const schema::Cage::Crease::Reader one : creases) cage.creases.push_back({one.getA(), one.getB(), one.getSharpness()});
    const auto corners = source.getCorners();
    reading.checkItems("corner", corners.size(), 1);
    for (const schema::Cage::Corner::Reader one : corners) cage.corners.push_back({one.getVertex(), one.getSharpness()});
    cage.holes = readNumbers(source.getHoles());
}

template <typename List, typename Points>
void setPoints(List target, const Points& points) {
    std::uint32_t i = 0;
    for (const auto& point : points) {
        for (int k = 0; k < point.length(); ++k) target.set(i++, point[k]);
    }
}

template <typename List>
void setNumbers(List target, const std::vector<std::uint32_t>& numbers) {
    for (std::uint32_t i = 0; i < target.size(); ++i) target.set(i, numbers[i]);
}

schema::Cage::Scheme schemeOf(SubdivisionScheme scheme) {
    switch (scheme) {
        case SubdivisionScheme::catmullClark:
            return schema::Cage::Scheme::CATMULL_CLARK;
        case SubdivisionScheme::loop:
            return schema::Cage::Scheme::LOOP;
        case SubdivisionScheme::bilinear:
            return schema::Cage::Scheme::BILINEAR;
        case SubdivisionScheme::none:
            return schema::Cage::Scheme::NONE;
    }
    return schema::Cage::Scheme::CATMULL_CLARK;
}

schema::Cage::Boundary boundaryOf(BoundaryRule rule) {
    if (rule == BoundaryRule::none) return schema::Cage::Boundary::NONE;
    return rule == BoundaryRule::edgeOnly ? schema::Cage::Boundary::EDGE_ONLY : schema::Cage::Boundary::EDGE_AND_CORNER;
}

}  // namespace

Cage readCage(const MsceneReading& reading, schema::Cage::Reader source, std::size_t index) {
    Cage cage;
    cage.name = readName(reading, source.getName(), itemText("cage", index));
    const std::string item = "cage " + quotedName(cage.name);
    cage.scheme = readScheme(reading, source, item);
    cage.boundary = readBoundary(reading, source, item);
    cage.points = readPoints<glm::vec3>(reading, source.getPositions(), item);
    cage.faceSizes = readNumbers(source.getFaceSizes());
    cage.faceVertices = readNumbers(source.getFaceVertices());
    readTags(reading, source, cage);
    cage.texturePoints = readPoints<glm::vec2>(reading, source.getTexturePositions(), item + ", texture");
    cage.faceTexturePoints = readNumbers(source.getFaceTexturePoints());
    if (cage.faceSizes.empty()) reading.warn(item + " has no faces");
    return cage;
}

void writeCage(schema::Cage::Builder target, const Cage& cage) {
    const auto size = [&](std::size_t count, std::string_view what) {
        return msceneListSize(count, "cage " + quotedName(cage.name) + ", " + std::string(what));
    };
    target.setName({cage.name.c_str(), cage.name.size()});
    target.setScheme(schemeOf(cage.scheme));
    target.setBoundary(boundaryOf(cage.boundary));
    setPoints(target.initPositions(size(cage.points.size() * 3, "coordinates")), cage.points);
    setNumbers(target.initFaceSizes(size(cage.faceSizes.size(), "faces")), cage.faceSizes);
    setNumbers(target.initFaceVertices(size(cage.faceVertices.size(), "corners")), cage.faceVertices);
    auto creases = target.initCreases(size(cage.creases.size(), "creases"));
    for (std::uint32_t i = 0; i < creases.size(); ++i) {
        creases[i].setA(cage.creases[i].a);
        creases[i].setB(cage.creases[i].b);
        creases[i].setSharpness(cage.creases[i].sharpness);
    }
    auto corners = target.initCorners(size(cage.corners.size(), "sharp corners"));
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
        corners[i].setVertex(cage.corners[i].vertex);
        corners[i].setSharpness(cage.corners[i].sharpness);
    }
    setNumbers(target.initHoles(size(cage.holes.size(), "holes")), cage.holes);
    setPoints(target.initTexturePositions(size(cage.texturePoints.size() * 2, "texture coordinates")), cage.texturePoints);
    setNumbers(target.initFaceTexturePoints(size(cage.faceTexturePoints.size(), "texture corners")), cage.faceTexturePoints);
}

}  // namespace tessera
