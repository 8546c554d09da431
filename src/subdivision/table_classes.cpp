// Readings of rings in all their directions, and classes' values by cages of their own.
#include "subdivision/table_classes.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "subdivision/table_limit.h"
#include "subdivision/vertex_limit.h"

namespace tessera::subdivision {
namespace {

// The ring counter-clockwise (step 1) or clockwise (-1). A closed one from its edge `first` on, which is then its own.
CornerRing readRing(const CornerRing& ring, std::uint32_t first, std::int32_t step) {
    CornerRing out = ring;
    if (!ring.closed) {
        out.own = first;
        if (step > 0) return out;
        out.own = static_cast<std::uint32_t>(ring.ends.size()) - 1 - first;
        std::reverse(out.ends.begin(), out.ends.end());
        std::reverse(out.edgeSharpness.begin(), out.edgeSharpness.end());
        std::reverse(out.diagonals.begin(), out.diagonals.end());
        return out;
    }
    out.own = 0;
    for (std::uint32_t k = 0; k < ring.ends.size(); ++k) {
        const std::uint32_t edge = ring.edge(first, step * static_cast<std::int32_t>(k));
        out.ends[k] = ring.ends[edge];
        out.edgeSharpness[k] = ring.edgeSharpness[edge];
        out.diagonals[k] = ring.diagonals[step > 0 ? edge : ring.edge(edge, -1)];
    }
    return out;
}

bool alone(const EdgeRings& rings) { return rings.aroundEnd.ends.empty(); }

// Whether there is a face that lies behind (before) an edge of a ring.
bool hasFace(const CornerRing& ring, std::uint32_t edge, bool behind) {
    return ring.closed || (behind ? edge + 1 < ring.ends.size() : edge > 0);
}

std::uint32_t faceAt(const CornerRing& ring, std::uint32_t edge, bool behind) { return behind ? edge : ring.edge(edge, -1); }

// All of a ring's diagonals but those of the two faces at the edge, which are ends of the other ring.
template <typename Work>
void eachOwnDiagonal(const CornerRing& ring, bool whole, const Work& work) {
    for (std::uint32_t face = 0; face < ring.faces(); ++face) {
        const bool shared = !whole && ((hasFace(ring, ring.own, true) && face == faceAt(ring, ring.own, true)) ||
                                       (hasFace(ring, ring.own, false) && face == faceAt(ring, ring.own, false)));
        if (!shared) work(face);
    }
}

void addKey(Key& key, const CornerRing& ring) {
    key.insert(key.end(), {ring.closed ? 1U : 0U, ring.faces(), ring.own, std::bit_cast<std::uint32_t>(ring.sharpness)});
    for (const float sharpness : ring.edgeSharpness) key.push_back(std::bit_cast<std::uint32_t>(sharpness));
}

// The same rings with slots for positions.
EdgeRings modelOf(const EdgeRings& rings) {
    EdgeRings model = rings;
    model.reversed = false;
    std::uint32_t next = 0;
    model.start = next++;
    if (!alone(rings)) model.end = next++;
    const auto addEnds = [&](CornerRing& ring, std::uint32_t other) {
        for (std::uint32_t k = 0; k < ring.ends.size(); ++k) ring.ends[k] = !alone(rings) && k == ring.own ? other : next++;
    };
    addEnds(model.around, model.end);
    addEnds(model.aroundEnd, model.start);
    // The face behind the edge at one end is the one before it at the other.
    const auto share = [&](CornerRing& ring, const CornerRing& other) {
        for (const bool behind : {true, false})
            if (hasFace(ring, ring.own, behind))
                ring.diagonals[faceAt(ring, ring.own, behind)] = other.ends[other.edge(other.own, behind ? -1 : 1)];
    };
    if (!alone(rings)) {
        share(model.around, model.aroundEnd);
        share(model.aroundEnd, model.around);
    }
    eachOwnDiagonal(model.around, alone(rings), [&](std::uint32_t face) { model.around.diagonals[face] = next++; });
    eachOwnDiagonal(model.aroundEnd, alone(rings), [&](std::uint32_t face) { model.aroundEnd.diagonals[face] = next++; });
    return model;
}

// Whether a crease that is sharp for ever ends here.
bool isDart(const CornerRing& ring) {
    constexpr float infinite = 10;
    return ring.closed && ring.sharpness < infinite &&
           std::count_if(ring.edgeSharpness.begin(), ring.edgeSharpness.end(), [](float s) { return s >= infinite; }) == 1;
}

// What each slot adds, point after point, by the limit surface of one of the faces at the edge.
std::vector<double> modelValues(const EdgeRings& model) {
    const std::vector<std::uint32_t> slots = slotsOf(model);
    const bool behind = hasFace(model.around, model.around.own, true);
    RingCage cage;
    cage.addRing(model.start, model.around, faceAt(model.around, model.around.own, behind));
    if (!alone(model)) cage.addRing(model.end, model.aroundEnd, 0);
    const Cage small = cage.cage(static_cast<std::uint32_t>(slots.size()));
    if (alone(model) && isDart(model.around)) return vertexLimit(small, model.start);
    FirstFace face(small);
    const std::uint32_t points = alone(model) ? 1 : sidePoints;
    std::vector<double> values(slots.size() * points);
    for (std::uint32_t t = 0; t < points; ++t) {
        const double along = t / (sidePoints - 1.0);
        const std::vector<double>& sums = face.at(behind ? along : 0, behind ? 0 : along)[0];
        for (std::size_t slot = 0; slot < slots.size(); ++slot) values[slot * points + t] = sums[slot];
    }
    return values;
}

// The least of all values that are the same but for rounding, one for each symmetry.
std::vector<float> classValues(const EdgeRings& rings) {
    const EdgeRings model = modelOf(rings);
    const std::vector<double> values = modelValues(model);
    const std::size_t points = alone(model) ? 1 : sidePoints;
    std::vector<double> least = values;
    for (const EdgeRings& reading : leastReadings(model)) {
        const std::vector<std::uint32_t> slots = slotsOf(reading);
        for (std::size_t slot = 0; slot < slots.size(); ++slot)
            for (std::size_t t = 0; t < points; ++t)
                least[slot * points + t] =
                    std::min(least[slot * points + t], values[slots[slot] * points + (reading.reversed ? points - 1 - t : t)]);
    }
    return {least.begin(), least.end()};
}

// The rings at a side of a face, and of a corner.
EdgeRings edgeOf(const FaceRing& ring, std::uint32_t side) {
    const std::uint32_t next = (side + 1) % 4;
    EdgeRings rings{side, next, ring.corners[side], ring.corners[next], false};
    rings.aroundEnd.own = rings.aroundEnd.edge(rings.aroundEnd.own, 1);
    return rings;
}

EdgeRings cornerOf(const FaceRing& ring, std::uint32_t corner) { return {corner, corner, ring.corners[corner], CornerRing(), false}; }

// The sum of each row's values, which come as they may.
class RowSums {
public:
    explicit RowSums(std::size_t rows) : terms_(rows) {}
    void add(std::uint32_t row, float value) { terms_[row].push_back(value); }
    template <typename Put>
    void finish(const Put& put) {
        for (std::size_t row = 0; row < terms_.size(); ++row) {
            std::sort(terms_[row].begin(), terms_[row].end());
            double sum = 0;
            for (const float term : terms_[row]) sum += static_cast<double>(term);
            put(row, static_cast<float>(sum));
            terms_[row].clear();
        }
    }

private:
    std::vector<std::vector<float>> terms_;
};

}  // namespace

std::vector<std::uint32_t> slotsOf(const EdgeRings& rings) {
    std::vector<std::uint32_t> slots = {rings.start};
    if (!alone(rings)) slots.push_back(rings.end);
    for (const CornerRing* ring : {&rings.around, &rings.aroundEnd})
        for (std::uint32_t k = 0; k < ring->ends.size(); ++k)
            if (alone(rings) || k != ring->own) slots.push_back(ring->ends[k]);
    for (const CornerRing* ring : {&rings.around, &rings.aroundEnd})
        eachOwnDiagonal(*ring, alone(rings), [&](std::uint32_t face) { slots.push_back(ring->diagonals[face]); });
    return slots;
}

Key keyOf(const EdgeRings& rings) {
    Key key;
    addKey(key, rings.around);
    if (!alone(rings)) addKey(key, rings.aroundEnd);
    return key;
}

std::vector<EdgeRings> leastReadings(const EdgeRings& rings) {
    std::vector<EdgeRings> readings;
    const auto add = [&](const CornerRing& around, std::uint32_t first, std::int32_t step, bool reversed) {
        EdgeRings out = rings;
        out.reversed = reversed;
        out.around = readRing(around, first, step);
        if (alone(rings)) {
            // Its first edge need not be told from the others.
            if (!out.around.closed && out.around.own != 0) return;
        } else {
            const CornerRing& other = reversed ? rings.around : rings.aroundEnd;
            out.aroundEnd = readRing(other, other.own, step);
            if (reversed) std::swap(out.start, out.end);
        }
        readings.push_back(std::move(out));
    };
    for (const std::int32_t step : {1, -1}) {
        if (alone(rings)) {
            for (std::uint32_t first = 0; first < rings.around.ends.size(); ++first) add(rings.around, first, step, false);
        } else {
            add(rings.around, rings.around.own, step, false);
            add(rings.aroundEnd, rings.aroundEnd.own, step, true);
        }
    }
    std::vector<Key> keys(readings.size());
    std::transform(readings.begin(), readings.end(), keys.begin(), keyOf);
    const Key least = *std::min_element(keys.begin(), keys.end());
    std::vector<EdgeRings> out;
    for (std::size_t k = 0; k < keys.size(); ++k)
        if (keys[k] == least) out.push_back(std::move(readings[k]));
    return out;
}

const std::vector<float>& SymmetryClasses::values(const EdgeRings& rings) {
    const auto [found, added] = (alone(rings) ? vertices_ : edges_).try_emplace(keyOf(rings));
    if (added) found->second = classValues(rings);
    return found->second;
}

void SymmetryClasses::fillSide(const FaceRing& ring, std::uint32_t side, std::span<const std::uint32_t> rowOf, std::span<float> rows) {
    RowSums sums(rows.size() / sidePoints);
    const EdgeRings edge = leastReadings(edgeOf(ring, side)).front();
    const std::vector<std::uint32_t> slots = slotsOf(edge);
    const std::vector<float>& coefficients = values(edge);
    for (std::uint32_t t = 1; t + 1 < sidePoints; ++t) {
        for (std::size_t slot = 0; slot < slots.size(); ++slot) sums.add(rowOf[slots[slot]], coefficients[slot * sidePoints + t]);
        const std::uint32_t point = edge.reversed ? sidePoints - 1 - t : t;
        sums.finish([&](std::size_t row, float sum) { rows[row * sidePoints + point] = sum; });
    }
    for (const std::uint32_t end : {0U, 1U}) {
        const EdgeRings corner = leastReadings(cornerOf(ring, (side + end) % 4)).front();
        const std::size_t point = end == 0 ? 0 : sidePoints - 1;
        const std::vector<std::uint32_t> cornerSlots = slotsOf(corner);
        const std::vector<float>& cornerCoefficients = values(corner);
        for (std::size_t slot = 0; slot < cornerSlots.size(); ++slot) sums.add(rowOf[cornerSlots[slot]], cornerCoefficients[slot]);
        sums.finish([&](std::size_t row, float sum) { rows[row * sidePoints + point] = sum; });
    }
}

}  // namespace tessera::subdivision
