// Corners of faces that belong together: disjoint sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace tessera::subdivision {

// A set is known by its least corner.
class CornerSets {
public:
    explicit CornerSets(std::size_t corners) : parents_(corners) { std::iota(parents_.begin(), parents_.end(), 0U); }

    [[nodiscard]] std::uint32_t find(std::uint32_t corner) {
        // Halving the way as it is walked keeps the next walk short.
        while (parents_[corner] != corner) corner = std::exchange(parents_[corner], parents_[parents_[corner]]);
        return corner;
    }

    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parents_[a < b ? b : a] = a < b ? a : b;
    }

private:
    std::vector<std::uint32_t> parents_;
};

}  // namespace tessera::subdivision
