// Numbers that come out the same on every machine: + - * / sqrt and floor are the same everywhere, other functions are not.
#include "scene/generate_numbers.h"

#include <cmath>

namespace tessera {

namespace {

// Spreads every bit of the state over the whole word.
std::uint64_t mixed(std::uint64_t word) {
    word = (word ^ (word >> 29U)) * 0xD6E8FEB86659FD93U;
    word = (word ^ (word >> 32U)) * 0xA3B195354A39B70DU;
    return word ^ (word >> 31U);
}

}  // namespace

Random::Random(std::uint32_t seed, std::uint32_t stream) : state_(mixed((std::uint64_t{stream} << 32U) + seed + 1)) {}

double Random::next() {
    state_ += 0x9E3779B97F4A7C15U;
    return static_cast<double>(mixed(state_) >> 11U) / 9007199254740992.0;
}

std::size_t Random::below(std::size_t count) { return static_cast<std::size_t>(next() * static_cast<double>(count)); }

glm::dvec3 Random::direction() {
    const double z = between(-1.0, 1.0);
    const glm::dvec2 around = onCircle(next()) * std::sqrt(1.0 - z * z);
    return {around.x, z, around.y};
}

glm::dvec3 Random::within(double half) {
    const double x = between(-half, half);
    const double y = between(-half, half);
    return {x, y, between(-half, half)};
}

glm::dvec2 onCircle(double turns) {
    const double quarters = std::floor(4.0 * turns + 0.5);
    const double x = 6.283185307179586 * (turns - 0.25 * quarters);
    const double xx = x * x;
    // Taylor's series within an eighth of a turn: what is left out is below the last bit.
    double sine = 1.0;
    double cosine = 1.0;
    for (int k = 9; k > 0; --k) {
        sine = 1.0 - sine * xx / ((2 * k) * (2 * k + 1));
        cosine = 1.0 - cosine * xx / ((2 * k - 1) * (2 * k));
    }
    sine *= x;
    const double quadrant = quarters - 4.0 * std::floor(quarters / 4.0);
    if (quadrant < 0.5) return {cosine, sine};
    if (quadrant < 1.5) return {-sine, cosine};
    if (quadrant < 2.5) return {-cosine, -sine};
    return {sine, -cosine};
}

}  // namespace tessera
