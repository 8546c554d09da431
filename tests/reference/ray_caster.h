// Casts rays against the smooth surfaces of a Scene in double precision: what a picture ought to show.
#pragma once

#include "patch_piece.h"

#include "tessera/scene.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace tessera::reference {

struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0};  // not zero, of any length
};

struct Hit {
    double t = 0.0;  // the point is origin + t direction
    glm::dvec3 point{0.0};
    std::size_t object = 0;  // index into Scene::objects
    std::size_t patch = 0;   // index into the object's mesh
    double u = 0.0;
    double v = 0.0;
    glm::dvec3 normal{0.0};         // unit du x dv in world space, whichever way it points; zero where the surface has none
    glm::dvec3 shadingNormal{0.0};  // what a picture shows in its place: another one on pn triangles
    double residual = 0.0;          // distance of the surface point from the ray: at most 1e-12 of the scene's size
};

// An object's rotation and translation, from its quaternion of any length.
struct Placement {
    glm::dmat3 rotation{1.0};
    glm::dvec3 translation{0.0};

    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& local) const { return rotation * local + translation; }
};
[[nodiscard]] Placement placement(const Transform& transform);

class RayCaster {
public:
    // Keeps copies of all control points in world space. Requires a scene that Scene::validate() accepts.
    explicit RayCaster(const Scene& scene);

    // The nearest hit with tMin < t < tMax. May be called from several threads at once.
    [[nodiscard]] std::optional<Hit> cast(const Ray& ray, double tMin, double tMax = std::numeric_limits<double>::infinity()) const;

    [[nodiscard]] double sceneSize() const { return size_; }  // diagonal of the box of all control points

private:
    struct PlacedPatch {
        std::size_t object, patch;
        PatchShape shape;                // in world space
        std::vector<glm::dvec3> points;  // in world space, of a pn triangle with its normals behind
    };
    struct Leaf {
        std::size_t placed;
        Piece piece;
        Box box;
    };
    struct Node {
        Box box;
        std::size_t first, count;  // of the leaves below
        std::size_t left, right;   // nodes; 0 in a node whose leaves are looked at one by one
    };

    void addObject(const Scene& scene, std::size_t object);
    void addLeaves(std::size_t placed, const Piece& piece, int levels);
    std::size_t build(std::size_t first, std::size_t count);
    // The nearest hit within a leaf, its t along the unit ray.
    [[nodiscard]] std::optional<Hit> lookInto(const Leaf& leaf, const Ray& unitRay, double nearest, double farthest) const;

    double size_ = 0.0;
    std::vector<PlacedPatch> placed_;
    std::vector<Leaf> leaves_;
    std::vector<Node> nodes_;
};

}  // namespace tessera::reference
