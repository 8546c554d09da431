// Tolerances as kernels measure them: in world units, or by depth, less what rounding takes.
#include "mesh/mesh_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string_view>
#include <unordered_map>

#include "scene/validate.h"
#include "tessera/error.h"

namespace tessera {
namespace {

// Of the greatest coordinate. A vertex is within some 2^-21 of it of where it belongs: a dozen roundings of 2^-24 and one of the placing.
constexpr double roundingShare = 0x1p-21;
// A tolerance of eight times that leaves seven parts of it to the triangles.
constexpr double leastShare = 8 * roundingShare;

Bounds boxOf(const Mesh& mesh) {
    Bounds box;
    const std::size_t each = pointsPerPatch(mesh.kind), positions = positionsPerPatch(mesh.kind);
    for (std::size_t k = 0; k < mesh.points.size(); ++k)
        if (k % each < positions) box.include(mesh.points[k]);
    for (const EdgeRecord& edge : mesh.edges)
        for (const glm::vec3& point : edge.points) box.include(point);
    return box;
}

double greatestOf(const Bounds& box, const glm::dmat4& place) {
    double most = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 at((corner & 1) != 0 ? box.upper.x : box.lower.x, (corner & 2) != 0 ? box.upper.y : box.lower.y,
                            (corner & 4) != 0 ? box.upper.z : box.lower.z, 1.0);
        const glm::dvec4 placed = glm::abs(place * at);
        most = std::max({most, placed.x, placed.y, placed.z});
    }
    return most;
}

std::string numberOf(double value) {
    std::ostringstream text;
    text.precision(3);
    text << value;
    return text.str();
}

// Written so that NaN is refused.
void requirePositive(const char* option, double value) {
    if (value > 0.0 && std::isfinite(value)) return;
    throw Error(std::string(option) + " is " + numberOf(value) + ", but must be a number above 0");
}

void setCamera(mesh_view& view, const Camera& camera, const TessellateOptions& options) {
    const double halfHeight = std::tan(static_cast<double>(camera.fovy) * std::numbers::pi / 360.0);
    const double halfWidth = halfHeight * options.width / options.height;
    const double focal = options.height / 2.0 / halfHeight;
    // A step in space moves a point on the screen by no more than focal / depth times 1 / cos of its angle off the axis.
    const double slant = std::sqrt(1.0 + halfHeight * halfHeight + halfWidth * halfWidth);
    view.view = 1;
    view.cull = options.cull ? 1 : 0;
    view.tolerance = static_cast<float>(options.pixelError / (focal * slant));
    view.depth_share = static_cast<float>(1.0 / slant);
    view.near_plane = camera.near;
    view.slope_x = static_cast<float>(halfWidth);
    view.slope_y = static_cast<float>(halfHeight);
    glm::dmat4 eye = glm::inverse(matrix(camera.transform));
    for (int column = 0; column < 4; ++column) eye[column][2] = -eye[column][2];
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) view.eye_from_world[4 * row + column] = static_cast<float>(eye[column][row]);
}

}  // namespace

void TessellateOptions::validate() const {
    const bool hasTolerance = tolerance != 0.0, hasError = pixelError != 0.0;
    if (hasTolerance && hasError) throw Error("a tolerance and a pixel error are given; give one of them");
    if (hasError) {
        requirePositive("pixel error", pixelError);
        if (!camera) throw Error("a pixel error needs a camera to be seen by; give one");
        validateCamera(*camera, "camera '" + camera->name + "'");
        if (width < 1 || width > 65536 || height < 1 || height > 65536)
            throw Error("picture size is " + std::to_string(width) + " x " + std::to_string(height) + ", but must be 1 to 65536 each way");
        return;
    }
    requirePositive("tolerance", tolerance);
    if (camera) throw Error("a camera is given, but the tolerance is the same everywhere; give a pixel error instead");
}

SceneReach::SceneReach(const Scene& scene) {
    std::unordered_map<std::string_view, std::size_t> byName;
    for (const Mesh& mesh : scene.meshes) {
        byName.emplace(mesh.name, boxes_.size());
        boxes_.push_back(boxOf(mesh));
    }
    for (const Object& object : scene.objects) meshOfObject_.push_back(byName.at(object.mesh));
}

void SceneReach::update(const Scene& scene, std::size_t index) { boxes_[index] = boxOf(scene.meshes[index]); }

double SceneReach::greatest(const Scene& scene) const {
    double most = 0.0;
    for (std::size_t k = 0; k < meshOfObject_.size(); ++k) {
        const Bounds& box = boxes_[meshOfObject_[k]];
        if (!box.empty()) most = std::max(most, greatestOf(box, matrix(scene.objects[k].transform)));
    }
    return most;
}

mesh_view setUpView(const TessellateOptions& options, const std::string& sceneName, double greatest) {
    options.validate();
    mesh_view view{};
    view.least_tolerance = static_cast<float>(std::max((leastShare - roundingShare) * greatest, 1e-30));
    if (options.camera) {
        setCamera(view, *options.camera, options);
        // What is near may well be drawn as finely as positions can be; where all would be, the error is none that anybody sees.
        const double farthest = glm::length(glm::dvec3(options.camera->transform.translation)) + std::numbers::sqrt3 * greatest;
        const double finest = options.pixelError * leastShare * greatest / std::max(double{view.tolerance} * farthest, 1e-300);
        if (finest > options.pixelError) {
            throw Error(sceneName + ": pixel error " + numberOf(options.pixelError) +
                        " is finer than 32-bit positions can be at this scene's size; " + numberOf(finest * 1.01) + " is the least");
        }
        return view;
    }
    if (options.tolerance < leastShare * greatest) {
        throw Error(sceneName + ": tolerance " + numberOf(options.tolerance) +
                    " is finer than 32-bit positions can be at this scene's size; " + numberOf(leastShare * greatest * 1.01) +
                    " is the least");
    }
    view.tolerance = static_cast<float>(std::min(options.tolerance - roundingShare * greatest, 1e30));
    return view;
}

std::vector<placed_object> worldObjects(const Scene& scene) {
    std::vector<placed_object> placed;
    placed.reserve(scene.objects.size());
    for (const Object& object : scene.objects) {
        const glm::dmat4 worldFromObject = matrix(object.transform);
        placed_object& out = placed.emplace_back();
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column)
                out.eye_from_object[4 * row + column] = static_cast<float>(worldFromObject[column][row]);
        out.id = static_cast<std::uint32_t>(placed.size() - 1);
    }
    return placed;
}

}  // namespace tessera
