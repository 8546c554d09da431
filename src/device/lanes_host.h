// Stands in for device/lanes.clh where the host compiles kernel headers as C++: one lane, the same bits.
// For src/split/bound_host.cpp, src/split/quad_host.cpp and tests of kernel headers.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace tessera::kernels {

using uint = std::uint32_t;
using vfloat = float;
using vint = std::int32_t;
using vuint = std::uint32_t;

inline float fmin(float a, float b) { return std::fmin(a, b); }
inline float fmax(float a, float b) { return std::fmax(a, b); }
inline float sqrt(float a) { return std::sqrt(a); }
inline float fabs(float a) { return std::fabs(a); }
inline vint vlt(float a, float b) { return a < b ? -1 : 0; }
inline vint vlt(vint a, vint b) { return a < b ? -1 : 0; }
inline vint vle(float a, float b) { return a <= b ? -1 : 0; }
inline vint vle(vint a, vint b) { return a <= b ? -1 : 0; }
inline vint veq(float a, float b) { return a == b ? -1 : 0; }
inline vint veq(vint a, vint b) { return a == b ? -1 : 0; }
template <typename T>
T vselect(T otherwise, T then, vint mask) {
    return mask != 0 ? then : otherwise;
}
inline bool vany(vint mask) { return mask != 0; }
template <typename T>
T load_lanes(const T* pointer) {
    return *pointer;
}
inline vint vlane_index() { return 0; }
inline vint vfirst(vint x) { return x; }
inline float vto_float(vint x) { return static_cast<float>(x); }
inline vint vto_int(float x) { return static_cast<vint>(x); }
inline uint min(uint a, uint b) { return std::min(a, b); }
inline vint vas_int(float x) { return std::bit_cast<vint>(x); }
inline float vas_float(vint x) { return std::bit_cast<float>(x); }

struct vpoint {
    vfloat x, y, z;
};

}  // namespace tessera::kernels
