#include "surface/view_planes.h"

#include <cmath>

namespace tessera {
namespace {

// As in patch_box.clh.
constexpr double marginPixels = 1.0;
// Four times the kernel's, for it adds to what placing has rounded.
constexpr double rounding = 8e-6;

}  // namespace

ViewPlanes::ViewPlanes(const frame_params& frame, const placed_object& object) {
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t k = 0; k < 4; ++k) eye_[row][k] = object.eye_from_object[4 * row + k];
    const double focal = frame.focal;
    const double left = frame.cull_left - marginPixels - frame.centre_x, right = frame.cull_right + marginPixels - frame.centre_x;
    const double bottom = frame.cull_bottom - marginPixels - frame.centre_y, top = frame.cull_top + marginPixels - frame.centre_y;
    for (std::size_t k = 0; k < 4; ++k) {
        const double x = focal * eye_[0][k], y = focal * eye_[1][k], z = eye_[2][k];
        planes_[0][k] = x - left * z;
        planes_[1][k] = right * z - x;
        planes_[2][k] = y - bottom * z;
        planes_[3][k] = top * z - y;
        planes_[4][k] = z;
    }
    planes_[4][3] -= frame.near_plane;
    reach_ = {focal + std::abs(left), focal + std::abs(right), focal + std::abs(bottom), focal + std::abs(top), 1.0};
}

bool ViewPlanes::mayShow(const ObjectBox& box) const {
    std::array<double, 3> centre{}, half{};
    for (std::size_t c = 0; c < 3; ++c) {
        centre[c] = 0.5 * (static_cast<double>(box.lower[c]) + box.upper[c]);
        half[c] = 0.5 * (static_cast<double>(box.upper[c]) - box.lower[c]);
    }
    double size = 0.0;  // no coordinate of the box is greater in eye space, nor is a term of one
    for (const Row& row : eye_) {
        for (std::size_t c = 0; c < 3; ++c) size += std::abs(row[c]) * (std::abs(centre[c]) + half[c]);
        size += std::abs(row[3]);
    }
    for (std::size_t k = 0; k < planes_.size(); ++k) {
        double most = planes_[k][3];
        for (std::size_t c = 0; c < 3; ++c) most += planes_[k][c] * centre[c] + std::abs(planes_[k][c]) * half[c];
        if (most < -rounding * size * reach_[k]) return false;
    }
    return true;
}

}  // namespace tessera
