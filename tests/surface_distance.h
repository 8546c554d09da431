// Points of a scene's surfaces and of a mesh that are nearest to others, in double precision and with nothing of the tessellator's.
#pragma once

#include "mesh_kept.h"

#include "tessera/scene.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace tessera::test {

// The patches of all objects, in world space.
class PlacedSurfaces {
public:
    explicit PlacedSurfaces(const Scene& scene);

    [[nodiscard]] std::size_t patches() const { return patches_.size(); }
    [[nodiscard]] PatchKind kind(std::size_t patch) const { return patches_[patch].kind; }

    // Requires numbers that the scene has.
    [[nodiscard]] std::size_t number(std::uint32_t object, std::uint32_t patch) const { return firstOfObject_.at(object) + patch; }

    [[nodiscard]] glm::dvec3 at(std::size_t patch, const glm::dvec2& uv) const;

    // A point of the patch that is `enough`, or as near to `point` as steps downhill from `from`, and from places all over the patch, come.
    [[nodiscard]] glm::dvec3 nearest(std::size_t patch, const glm::dvec3& point, const glm::dvec2& from,
                                     const std::function<bool(const glm::dvec3&)>& enough) const;

private:
    struct Patch {
        PatchKind kind = PatchKind::bezier;
        std::vector<glm::dvec3> points;
        std::vector<double> weights;
    };
    [[nodiscard]] glm::dvec3 downhill(const Patch& patch, const glm::dvec3& point, glm::dvec2 uv) const;

    std::vector<Patch> patches_;
    std::vector<std::size_t> firstOfObject_;
};

// The triangles of a mesh in cells, each in all that come within `reach` of it.
class NearTriangles {
public:
    NearTriangles(const KeptMesh& mesh, double reach);

    // The nearest point of the mesh, if any is within reach.
    [[nodiscard]] std::optional<glm::dvec3> nearest(const glm::dvec3& point) const;

private:
    [[nodiscard]] glm::ivec3 cellOf(const glm::dvec3& point) const;
    [[nodiscard]] std::size_t numberOf(const glm::ivec3& cell) const;
    [[nodiscard]] glm::dvec3 corner(std::size_t index) const;

    const KeptMesh& mesh_;
    double reach_;
    glm::dvec3 lower_{0.0};
    glm::dvec3 cellSize_{1.0};
    std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace tessera::test
