// Cameras made rather than read: one that looks at a point, one that frames a whole scene.
#include "tessera/scene.h"

#include "scene/text.h"
#include "tessera/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera {

namespace {

void checkFieldOfView(float fovyDegrees) {
    if (fovyDegrees > 0.0F && fovyDegrees < 180.0F) return;
    throw Error("camera: field of view of " + numberText(fovyDegrees) + " degrees; give more than 0, less than 180");
}

// Columns right, up, back of a camera whose unit +z axis is `back`.
glm::dmat3 cameraAxes(const glm::dvec3& back) {
    // Within a millionth of the vertical the sideways direction would be made of rounding errors.
    const bool vertical = std::hypot(back.x, back.z) < 1e-6;
    const glm::dvec3 hint = vertical ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(hint, back));
    return {right, glm::cross(back, right), back};
}

// At most the usual near plane, but always well before what is looked at, and a normal float.
float nearPlane(double distanceToSubject) {
    const double smallest = std::numeric_limits<float>::min();
    return static_cast<float>(std::clamp(distanceToSubject * 0.01, smallest, static_cast<double>(Camera{}.near)));
}

// The box to be framed: never empty, and wide enough that single precision can tell eye and target apart.
struct Box {
    glm::dvec3 centre;
    glm::dvec3 half;
};

Box boxToFrame(const Bounds& bounds) {
    if (bounds.empty()) return {glm::dvec3(0.0), glm::dvec3(1.0)};
    const glm::dvec3 lower(bounds.lower);
    const glm::dvec3 upper(bounds.upper);
    Box box{(lower + upper) * 0.5, (upper - lower) * 0.5};
    const double size = std::max({box.half.x, box.half.y, box.half.z});
    const double farthest = std::max({std::abs(box.centre.x), std::abs(box.centre.y), std::abs(box.centre.z)});
    const double resolved = farthest * 1e-5;
    if (size < 1e-30 && resolved < 1e-30) {
        box.half = glm::dvec3(1.0);
    } else if (size < resolved) {
        box.half = glm::dvec3(resolved);
    }
    return box;
}

}  // namespace

Camera lookAt(const glm::vec3& eye, const glm::vec3& target, float fovyDegrees) {
    checkFieldOfView(fovyDegrees);
    const glm::dvec3 back = glm::dvec3(eye) - glm::dvec3(target);
    const double distance = glm::length(back);
    if (!std::isfinite(distance)) throw Error("camera: eye or target is not finite; give coordinates below 1e9");
    if (distance == 0.0) throw Error("camera: eye and target are the same point; move one of them");
    Camera camera;
    camera.name = "look-at";
    camera.transform.translation = eye;
    camera.transform.rotation = glm::quat(glm::quat_cast(cameraAxes(back / distance)));
    camera.near = nearPlane(distance);
    camera.fovy = fovyDegrees;
    return camera;
}

Camera framingCamera(const Scene& scene, float fovyDegrees) {
    checkFieldOfView(fovyDegrees);
    const Box box = boxToFrame(worldBounds(scene));
    const glm::dmat3 axes = cameraAxes(glm::normalize(glm::dvec3(0.5, 0.45, 1.0)));
    // The picture's shape is not known here: the box fits a square one, and so any that is wider than high.
    // Half the height of the picture at distance 1, less a margin of a twelfth.
    // The angle is floored where single precision could no longer hold the eye's place.
    const double angle = glm::radians(std::max(static_cast<double>(fovyDegrees), 1e-4));
    const double halfHeight = std::tan(angle * 0.5) * (11.0 / 12.0);
    double distance = 0.0;
    double nearestCorner = 0.0;  // of the box, along the view axis towards the eye, from the centre
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign((corner & 1U) != 0 ? 1.0 : -1.0, (corner & 2U) != 0 ? 1.0 : -1.0, (corner & 4U) != 0 ? 1.0 : -1.0);
        const glm::dvec3 seen = glm::transpose(axes) * (sign * box.half);
        distance = std::max(distance, seen.z + std::max(std::abs(seen.x), std::abs(seen.y)) / halfHeight);
        nearestCorner = std::max(nearestCorner, seen.z);
    }
    // Very wide angles would put the eye onto the box's surface.
    const double size = std::max({box.half.x, box.half.y, box.half.z});
    distance = std::max(distance, nearestCorner + 0.05 * size);

    Camera camera;
    camera.name = "framing";
    camera.transform.translation = glm::vec3(box.centre + axes[2] * distance);
    camera.transform.rotation = glm::quat(glm::quat_cast(axes));
    camera.near = nearPlane(distance - nearestCorner);
    camera.far = std::max(camera.far, static_cast<float>(2.0 * (distance + nearestCorner)));
    camera.fovy = fovyDegrees;
    return camera;
}

}  // namespace tessera
