// Tests boxes in an object's space against a frame's bounds, on the host.
#pragma once

#include <array>

#include "core/frame_shared.h"
#include "surface/patch_shared.h"
#include "surface/source_mesh.h"

namespace tessera {

// The planes through the eye along the frame's bounds (frame_params::cull_left and so on), a pixel out, and the near plane.
class ViewPlanes {
public:
    ViewPlanes(const frame_params& frame, const placed_object& object);

    // False only where the box lies wholly beyond one plane, by more than the device's rounding may move its points (patch_box.clh).
    [[nodiscard]] bool mayShow(const ObjectBox& box) const;

private:
    using Row = std::array<double, 4>;  // times (x, y, z, 1)

    std::array<Row, 3> eye_{};       // the object's matrix
    std::array<Row, 5> planes_{};    // at least 0 inside
    std::array<double, 5> reach_{};  // what a unit of rounding in eye space does to each
};

}  // namespace tessera
