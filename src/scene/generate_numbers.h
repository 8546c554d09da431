// Numbers that come out the same on every machine: chance, and angles without the mathematics library, whose last bits differ.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

namespace tessera {

// Two of them with different seeds or streams are independent. Take no two numbers within one expression or list of arguments:
// compilers take these in orders of their own.
class Random {
public:
    explicit Random(std::uint32_t seed, std::uint32_t stream = 0);

    double next();                             // 0 to below 1, 53 bits
    double between(double least, double most)  // below `most`
    {
        return least + (most - least) * next();
    }
    std::size_t below(std::size_t count);  // 0 to count - 1; count is above 0
    glm::dvec3 direction();                // of unit length, all alike
    glm::dvec3 within(double half);        // of a cube about the origin

private:
    std::uint64_t state_;
};

// Cosine (x) and sine (y) of an angle in whole turns; exact at quarter turns.
[[nodiscard]] glm::dvec2 onCircle(double turns);

}  // namespace tessera
