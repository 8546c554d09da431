// What is to be rendered: meshes of patches, objects that place them, lights and cameras.
// Conventions: right-handed; a camera looks along its -z axis, y up; colours are linear RGB.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/cage.h"

namespace tessera {

// A rigid motion: first the rotation, then the translation.
struct Transform {
    glm::vec3 translation{0.0F};
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};  // need not be of unit length; zero length is refused
};

// The unit rotation of `transform`. Requires a rotation of non-zero, finite length.
[[nodiscard]] glm::dmat3 rotationMatrix(const Transform& transform);

// The 4x4 matrix that takes local to world coordinates, in double precision.
[[nodiscard]] glm::dmat4 matrix(const Transform& transform);

enum class PatchKind : std::uint32_t {
    bezier,    // 16 points, row by row: point 4 v + u of the bicubic control net
    gregory,   // 20 points: p0..p3, e+0..e+3, e-0..e-3, f+0..f+3, f-0..f-3 (Loop et al. 2009)
    rational,  // 16 points as for bezier, and a weight above 0 for each in Mesh::weights
    pn,        // 16 vectors: a cubic triangle's 10 points, then its quadratic normals' 6 (Vlachos et al. 2001). Corners A, B, C lie
               // at (u, v) = (0, 0), (1, 0), (0, 1). Row by row of rising powers of v, in a row of rising powers of u:
               //     points   0 A   1     2     3 B      normals  10 A  11    12 B
               //              4     5     6                       13    14
               //              7     8                             15 C
               //              9 C
               // With a = 1 - u - v the normal is along 10 a^2 + 11 a u + 12 u^2 + 13 a v + 14 u v + 15 v^2, no binomials, as there.
};

[[nodiscard]] constexpr std::size_t pointsPerPatch(PatchKind kind) { return kind == PatchKind::gregory ? 20 : 16; }

// The first of these are positions; the rest, of a pn triangle, are normals.
[[nodiscard]] constexpr std::size_t positionsPerPatch(PatchKind kind) { return kind == PatchKind::pn ? 10 : pointsPerPatch(kind); }

[[nodiscard]] std::string_view name(PatchKind kind);

// The curve that a patch's border is drawn by instead of its own, where its neighbour is of another kind or level: both users of an
// edge hold the same record, to the bit, so that what they draw there is the same (DESIGN.md, "Edges between patches").
struct EdgeRecord {
    std::uint32_t patch = 0;  // in the mesh
    // The border: 0 is v = 0 from (0, 0) to (1, 0); 1 is u = 1 from (1, 0) to (1, 1), of a pn triangle B to C, with v the parameter;
    // 2 is v = 1 from (0, 1) to (1, 1), which a pn triangle has not; 3 is u = 0 from (0, 0) to (0, 1).
    std::uint32_t side = 0;
    // The border is the part [index, index + 1] / 2^level of a cubic Bezier curve; rational unless all weights are 1.
    std::array<glm::vec3, 4> points{};
    std::array<float, 4> weights{1.0F, 1.0F, 1.0F, 1.0F};
    std::uint32_t level = 0;  // at most 8
    std::uint32_t index = 0;
    bool reversed = false;   // whether the border's parameter falls along the curve
    std::uint32_t cuts = 0;  // at most 8: the curve is cut in the middle at least so many times, as its finest user is; >= level
};

// Patches of one kind; no point is shared between patches.
struct Mesh {
    std::string name;
    PatchKind kind = PatchKind::bezier;
    std::vector<glm::vec3> points;    // pointsPerPatch(kind) points a patch
    std::vector<float> weights{};     // rational: one a point; else empty
    std::vector<EdgeRecord> edges{};  // made by weld() (tessera/weld.h); at most one a border, sorted by patch and side
    // Texture coordinates: the 16 points of a bicubic Bezier net (point 4 v + u) a patch; empty: a patch's own (u, v) stand for them.
    std::vector<glm::vec2> textureNets{};
    bool welded = false;  // made with its edge records and shared points (subdivide()): weld() leaves it as it is

    [[nodiscard]] std::size_t patchCount() const { return points.size() / pointsPerPatch(kind); }
};

enum class MaterialKind : std::uint32_t {
    matte,    // Lambert
    plastic,  // Lambert and a white Blinn-Phong highlight
};

struct Material {
    MaterialKind kind = MaterialKind::matte;
    float specular = 0.3F;   // plastic: strength of the highlight, 0 to 1
    float roughness = 0.1F;  // plastic: width of the highlight, above 0 to 1
};

// A mesh placed in the world. Objects may share a mesh.
struct Object {
    std::string name;
    Transform transform;
    std::string mesh;  // Mesh::name or Cage::name
    glm::vec3 color{1.0F};
    Material material;
};

enum class LightKind : std::uint32_t {
    point,        // at the transform's translation; falls off with the square of the distance
    directional,  // shines along the -z axis of the transform
    hemi,         // a sky around the +z axis of the transform: full light on a normal along +z, none along -z
};

[[nodiscard]] std::string_view name(LightKind kind);

struct Light {
    std::string name;
    Transform transform;
    glm::vec3 color{1.0F};
    float intensity = 1.0F;  // directional, hemi: radiance of a white matte surface that faces it; point: the same at distance 1
    LightKind kind = LightKind::directional;
};

struct Camera {
    std::string name;
    Transform transform;
    float near = 0.01F;   // distance of the near plane, scene units, above 0
    float far = 1000.0F;  // kept for the file's sake; classical mode culls beyond 1000 whatever it says
    float fovy = 45.0F;   // vertical field of view, degrees, above 0 and below 180
};

struct Scene {
    std::string name;  // file name or name of the built-in scene, for messages
    std::vector<Mesh> meshes;
    std::vector<Cage> cages{};  // to be made meshes by subdivide(): a scene with any is not drawn
    std::vector<Light> lights;
    std::vector<Object> objects;
    std::vector<Camera> cameras;

    [[nodiscard]] const Mesh* findMesh(std::string_view meshName) const;
    [[nodiscard]] const Camera* findCamera(std::string_view cameraName) const;
    [[nodiscard]] std::size_t placedPatchCount() const;  // patches over all objects

    // Throws Error, naming scene and item (mesh, patch and point), on: coordinates that are not finite or beyond 1e9
    // (an eye or a pn triangle's normals need only be finite), point counts that are no multiple of a patch's, weights outside 1e-6 to
    // 1e6, missing or out of place, edge records that break their own rules, mesh names used twice, objects whose
    // mesh does not exist, rotations of zero length, near <= 0, fovy outside (0, 180), colours, intensities and far planes
    // that are not finite, materials outside their ranges, kinds that do not exist.
    void validate() const;
};

// An axis-aligned box in world space. Empty when lower > upper.
struct Bounds {
    glm::vec3 lower{std::numeric_limits<float>::infinity()};
    glm::vec3 upper{-std::numeric_limits<float>::infinity()};

    void include(const glm::vec3& point);
    [[nodiscard]] bool empty() const { return lower.x > upper.x; }
};

// The box of all control points of all objects, cages' included, which holds the surfaces (convex hull).
[[nodiscard]] Bounds worldBounds(const Scene& scene);

// A camera at `eye` that looks at `target`, y up (z up where the view is vertical). Throws Error when the two coincide
// or are not finite, and on fovy outside (0, 180).
[[nodiscard]] Camera lookAt(const glm::vec3& eye, const glm::vec3& target, float fovyDegrees);

// A camera that sees all of the scene from a little above, for scenes that have none: y up, in any picture at least as
// wide as high. Of an empty scene it sees the origin. Scenes of some 1000 units and more are beyond what classical
// mode draws (it culls at 1000 units). Throws Error on fovy outside (0, 180).
[[nodiscard]] Camera framingCamera(const Scene& scene, float fovyDegrees);

// Scenes that need no file.
[[nodiscard]] const std::vector<std::string_view>& builtinSceneNames();
[[nodiscard]] bool isBuiltinScene(std::string_view sceneName);
[[nodiscard]] Scene builtinScene(std::string_view sceneName);  // throws Error on an unknown name

}  // namespace tessera
