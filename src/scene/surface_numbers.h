// What the makers of surfaces share: parameters checked, results rounded.
#pragma once

#include <glm/glm.hpp>

#include <string>
#include <string_view>

namespace tessera {

// The surface that is being made, for messages: Error names its kind and name.
struct SurfaceLabel {
    std::string_view kind;  // "sphere"
    std::string_view name;

    [[noreturn]] void fail(const std::string& what) const;

    // Throws Error where `value` is not finite or beyond the 1e9 that scenes may measure.
    void requireFinite(std::string_view parameter, double value) const;

    // The same, and where `value` is not above 0.
    void requirePositive(std::string_view parameter, double value) const;

    // Both finite, and `low` below `high`.
    void requireRising(std::string_view lowName, double low, std::string_view highName, double high) const;
};

// The shortest decimal text that reads back as `value`.
[[nodiscard]] std::string numberText(double value);

// Single precision, and no negative zeros: points that are equal are equal to the bit.
[[nodiscard]] inline glm::vec3 rounded(const glm::dvec3& point) { return glm::vec3(point) + 0.0F; }

}  // namespace tessera
