// Rings as little cages of their own, point by point.
#include "subdivision/table_build.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "subdivision/table_limit.h"

namespace tessera::subdivision {
namespace {

// Rows of coefficients in double precision.
using Rows = std::array<std::vector<double>, 3>;

// The row of each position, and how many there are.
std::uint32_t rowsOf(const FaceRing& ring, const Key& repeats, std::vector<std::uint32_t>& rowOf) {
    std::uint32_t rows = 0;
    for (std::uint32_t k = 0; k < ring.vertices.size(); ++k)
        rowOf.push_back(repeats.empty() || repeats[k] == k ? rows++ : rowOf[repeats[k]]);
    return rows;
}

Rows evaluate(const FaceRing& ring, std::span<const std::uint32_t> rowOf, std::uint32_t count) {
    RingCage cage;
    for (std::uint32_t c = 0; c < 4; ++c) cage.addRing(c, ring.corners[c], c == 0 ? ring.corners[0].own : 0);
    FirstFace face(cage.cage(static_cast<std::uint32_t>(rowOf.size())));
    Rows rows;
    for (std::vector<double>& row : rows) row.assign(std::size_t{count} * tablePoints, 0.0);
    for (std::uint32_t point = 0; point < tablePoints; ++point) {
        const std::uint32_t column = point % sidePoints, line = point / sidePoints;
        const auto& sums = face.at(column / (sidePoints - 1.0), line / (sidePoints - 1.0));
        for (std::size_t d = 0; d < 3; ++d)
            for (std::size_t k = 0; k < rowOf.size(); ++k) rows[d][std::size_t{rowOf[k]} * tablePoints + point] += sums[d][k];
    }
    return rows;
}

// The sum of a point's magnitudes.
double normAt(const std::vector<double>& row, std::size_t point) {
    double sum = 0;
    for (std::size_t at = point; at < row.size(); at += tablePoints) sum += std::fabs(row[at]);
    return sum;
}

// At irregular corners tangents shrink to nothing or grow beyond all bounds: there they get the length of their neighbours'.
void scaleCorners(Rows& rows) {
    constexpr std::size_t last = sidePoints - 1, up = last * sidePoints;
    const std::array<std::array<std::size_t, 2>, 4> corners{
        {{0, sidePoints + 1}, {last, 2 * sidePoints - 2}, {up + last, up - 2}, {up, up + 1 - sidePoints}}};
    for (std::size_t d = 1; d < 3; ++d) {
        for (const auto& [corner, beside] : corners) {
            const double norm = normAt(rows[d], corner);
            if (norm == 0) continue;
            const double scale = normAt(rows[d], beside) / norm;
            for (std::size_t at = corner; at < rows[d].size(); at += tablePoints) rows[d][at] *= scale;
        }
    }
}

// The greatest sum of magnitudes of the second differences along both directions, over steps of `step` points.
double differences(const std::vector<double>& row, std::size_t step) {
    const std::size_t rows = row.size() / tablePoints;
    double most = 0;
    for (std::size_t j = 0; j < sidePoints; j += step) {
        for (std::size_t i = step; i + step < sidePoints; i += 2 * step) {
            double along = 0, up = 0;
            for (std::size_t r = 0; r < rows; ++r) {
                const double* const values = row.data() + r * tablePoints;
                const auto at = [&](std::size_t x, std::size_t y) { return values[y * sidePoints + x]; };
                along += std::fabs(at(i - step, j) + at(i + step, j) - 2 * at(i, j));
                up += std::fabs(at(j, i - step) + at(j, i + step) - 2 * at(j, i));
            }
            most = std::max({most, along, up});
        }
    }
    return most;
}

float decayOf(const std::vector<double>& row) {
    // At an irregular corner tangents shrink by the ratio of the magnitudes and what is upright on them by its square, and nowhere does a
    // cubic's fall by less than a quarter.
    constexpr double most = 0.6;
    const double ratio = differences(row, 1) / differences(row, 2);
    return static_cast<float>(std::clamp(ratio * ratio, 0.25, most));
}

// Which points of a row a side's are.
std::size_t sidePoint(std::uint32_t side, std::size_t t) {
    constexpr std::size_t last = sidePoints - 1;
    switch (side) {
        case 0:
            return t;
        case 1:
            return t * sidePoints + last;
        case 2:
            return last * sidePoints + (last - t);
        default:
            return (last - t) * sidePoints;
    }
}

}  // namespace

RingTable makeRingTable(const FaceRing& ring, const Key& repeats, SymmetryClasses& classes) {
    std::vector<std::uint32_t> rowOf;
    RingTable table;
    table.rows = rowsOf(ring, repeats, rowOf);
    Rows rows = evaluate(ring, rowOf, table.rows);
    scaleCorners(rows);
    table.decay = decayOf(rows[0]);
    for (std::size_t d = 0; d < 3; ++d) table.values[d].assign(rows[d].begin(), rows[d].end());
    std::vector<float> line(std::size_t{table.rows} * sidePoints);
    for (std::uint32_t side = 0; side < 4; ++side) {
        classes.fillSide(ring, side, rowOf, line);
        for (std::size_t row = 0; row < table.rows; ++row)
            for (std::size_t t = 0; t < sidePoints; ++t)
                table.values[0][row * tablePoints + sidePoint(side, t)] = line[row * sidePoints + t];
    }
    return table;
}

std::uint32_t TableStore::tableOf(const FaceRing& ring) {
    const std::pair<Key, Key> key{ringKey(ring), repeatsOf(ring)};
    const auto found = numbers_.find(key);
    if (found != numbers_.end()) return found->second;
    tables_.push_back(makeRingTable(ring, key.second, classes_));
    const auto number = static_cast<std::uint32_t>(tables_.size() - 1);
    numbers_.emplace(key, number);
    return number;
}

}  // namespace tessera::subdivision
