// Small pictures of a scene by ray casting, with the conventions of the renderer: pinhole, looking along -z of the camera,
// y up, origin of the image top left, a pixel's only sample at its centre.
#pragma once

#include "ray_caster.h"

#include <optional>
#include <vector>

namespace tessera::reference {

struct Pixel {
    bool covered = false;
    double z = std::numeric_limits<double>::infinity();  // distance along the view axis
    glm::dvec3 normal{0.0};                              // for shading; unit, world space, towards the viewer; zero where there is none
    Hit hit;                                             // valid when covered
};

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<Pixel> pixels;  // row by row from the top left

    [[nodiscard]] const Pixel& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

// A camera with the size of its picture.
class View {
public:
    View(const Camera& camera, int width, int height);

    // The ray through a point of the picture, in pixels from the top left; its t is the distance along the view axis.
    [[nodiscard]] Ray ray(double x, double y) const;

    // Where a point of the world stands in the picture (x and y in pixels) and its distance along the view axis (z).
    // Requires a point in front of the eye.
    [[nodiscard]] glm::dvec3 project(const glm::dvec3& point) const;

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] double near() const { return near_; }
    [[nodiscard]] double pixelSize() const { return pixel_; }  // of a pixel, at distance 1

private:
    Placement placement_;
    int width_;
    int height_;
    double near_;
    double pixel_;
};

// Casts a ray through each pixel's centre, on all cores. Nothing nearer than the near plane is seen.
[[nodiscard]] Picture castPicture(const RayCaster& caster, const View& view);

}  // namespace tessera::reference
