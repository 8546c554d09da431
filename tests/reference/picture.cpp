// Pictures by ray casting: the camera, and rows of pixels handed out to threads.
#include "picture.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <numbers>
#include <thread>

namespace tessera::reference {

namespace {

Pixel castPixel(const RayCaster& caster, const Ray& ray, double near) {
    const std::optional<Hit> hit = caster.cast(ray, near);
    if (!hit) return {};
    const glm::dvec3& normal = hit->shadingNormal;
    return {true, hit->t, glm::dot(normal, ray.direction) > 0.0 ? -normal : normal, *hit};
}

// Calls row(y) for 0 <= y < count from several threads; throws what one of them threw.
template <typename Row>
void forEachRow(int count, const Row& row) {
    std::atomic<int> next{0};
    std::exception_ptr failure;
    std::mutex failureMutex;
    const auto work = [&] {
        try {
            for (int y = next++; y < count; y = next++) row(y);
        } catch (...) {
            const std::lock_guard lock(failureMutex);
            failure = std::current_exception();
            next = count;
        }
    };
    {
        std::vector<std::jthread> threads;
        for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(work);
        work();
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace

View::View(const Camera& camera, int width, int height)
    : placement_(placement(camera.transform)),
      width_(width),
      height_(height),
      near_(camera.near),
      pixel_(2.0 * std::tan(static_cast<double>(camera.fovy) * std::numbers::pi / 360.0) / height) {}

Ray View::ray(double x, double y) const {
    const glm::dvec3 direction((x - 0.5 * width_) * pixel_, (0.5 * height_ - y) * pixel_, -1.0);
    return {placement_.translation, placement_.rotation * direction};
}

glm::dvec3 View::project(const glm::dvec3& point) const {
    const glm::dvec3 eye = glm::transpose(placement_.rotation) * (point - placement_.translation);
    const double scale = 1.0 / (-eye.z * pixel_);
    return {0.5 * width_ + eye.x * scale, 0.5 * height_ - eye.y * scale, -eye.z};
}

Picture castPicture(const RayCaster& caster, const View& view) {
    Picture picture{view.width(), view.height(), {}};
    picture.pixels.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
    forEachRow(picture.height, [&](int y) {
        for (int x = 0; x < picture.width; ++x) {
            const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
            picture.pixels[at] = castPixel(caster, view.ray(x + 0.5, y + 0.5), view.near());
        }
    });
    return picture;
}

}  // namespace tessera::reference
