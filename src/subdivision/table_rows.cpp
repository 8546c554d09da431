// The order of a MESH_RING's vertices (mesh/pattern.clh): around the loop, then row by row.
#include "subdivision/table_rows.h"

namespace tessera::subdivision {
namespace {

constexpr std::uint32_t last = sidePoints - 1;

std::uint32_t pointAt(std::uint32_t i, std::uint32_t j) { return j * sidePoints + i; }

std::vector<std::uint32_t> columnsOf(std::uint32_t level) {
    const std::uint32_t step = last >> level;
    std::vector<std::uint32_t> columns;
    for (std::uint32_t t = 0; t < last; t += step) columns.push_back(pointAt(t, 0));
    for (std::uint32_t t = 0; t < last; t += step) columns.push_back(pointAt(last, t));
    for (std::uint32_t t = 0; t < last; t += step) columns.push_back(pointAt(last - t, last));
    for (std::uint32_t t = 0; t < last; t += step) columns.push_back(pointAt(0, last - t));
    for (std::uint32_t j = step; j < last; j += step)
        for (std::uint32_t i = step; i < last; i += step) columns.push_back(pointAt(i, j));
    return columns;
}

std::uint32_t padded(std::size_t count) { return static_cast<std::uint32_t>((count + TABLE_PAD - 1) / TABLE_PAD * TABLE_PAD); }

std::vector<float> rowsOf(const std::vector<RingTable>& tables, std::uint32_t level, std::size_t first, std::size_t end) {
    const std::vector<std::uint32_t> columns = columnsOf(level);
    const std::size_t padding = paddedColumns(level) - columns.size();
    std::vector<float> rows;
    for (const RingTable& table : tables) {
        for (std::uint32_t row = 0; row < table.rows; ++row) {
            for (std::size_t d = first; d < end; ++d) {
                for (const std::uint32_t column : columns) rows.push_back(table.values[d][row * tablePoints + column]);
                rows.insert(rows.end(), padding, 0.0F);
            }
        }
    }
    return rows;
}

// A point, the ends of what it is the middle of, and another line's, across that one; at a side none: c is d.
struct Middle {
    std::uint32_t point = 0, a = 0, b = 0, c = 0, d = 0;
};

std::vector<Middle> middlesOf(std::uint32_t level) {
    const std::uint32_t step = last >> level, half = step / 2;
    std::vector<Middle> middles;
    for (std::uint32_t j = 0; j <= last; j += step) {
        for (std::uint32_t i = 0; i < last; i += step) {
            const bool side = j == 0 || j == last;
            const std::uint32_t before = side ? j : j - step, behind = side ? j : j + step;
            middles.push_back(
                {pointAt(i + half, j), pointAt(i, j), pointAt(i + step, j), pointAt(i + half, before), pointAt(i + half, behind)});
            middles.push_back(
                {pointAt(j, i + half), pointAt(j, i), pointAt(j, i + step), pointAt(before, i + half), pointAt(behind, i + half)});
        }
    }
    // Triangles at the sides may have either diagonal.
    for (std::uint32_t j = 0; j < last; j += step) {
        for (std::uint32_t i = 0; i < last; i += step) {
            const std::uint32_t a = pointAt(i, j), b = pointAt(i + step, j), c = pointAt(i + step, j + step), d = pointAt(i, j + step);
            middles.push_back({pointAt(i + half, j + half), a, c, b, d});
            middles.push_back({pointAt(i + half, j + half), b, d, a, c});
        }
    }
    return middles;
}

}  // namespace

std::uint32_t paddedColumns(std::uint32_t level) {
    const std::uint32_t side = (1U << level) + 1;
    return padded(std::size_t{side} * side);
}

std::vector<float> positionRows(const std::vector<RingTable>& tables, std::uint32_t level) { return rowsOf(tables, level, 0, 1); }

std::vector<float> tangentRows(const std::vector<RingTable>& tables, std::uint32_t level) { return rowsOf(tables, level, 1, 3); }

std::vector<float> deviationRows(const std::vector<RingTable>& tables) {
    std::vector<std::vector<Middle>> levels;
    for (std::uint32_t level = 0; level + 1 < TABLE_LEVELS; ++level) levels.push_back(middlesOf(level));
    std::vector<float> rows;
    for (const RingTable& table : tables) {
        for (std::uint32_t row = 0; row < table.rows; ++row) {
            const float* const values = table.values[0].data() + std::size_t{row} * tablePoints;
            const auto add = [&](const auto& of) {
                for (const std::vector<Middle>& middles : levels) {
                    for (const Middle& m : middles) rows.push_back(of(m));
                    rows.insert(rows.end(), padded(middles.size()) - middles.size(), 0.0F);
                }
            };
            add([&](const Middle& m) { return values[m.point] - 0.5F * (values[m.a] + values[m.b]); });
            add([&](const Middle& m) { return values[m.b] - values[m.a]; });
            add([&](const Middle& m) { return values[m.d] - values[m.c]; });
        }
    }
    return rows;
}

std::vector<float> placeRows() {
    std::vector<float> rows;
    for (std::uint32_t level = 0; level < TABLE_LEVELS; ++level) {
        const std::vector<std::uint32_t> columns = columnsOf(level);
        const std::size_t padding = paddedColumns(level) - columns.size();
        for (const bool up : {false, true}) {
            for (const std::uint32_t column : columns)
                rows.push_back(static_cast<float>(up ? column / sidePoints : column % sidePoints) / static_cast<float>(last));
            rows.insert(rows.end(), padding, 0.0F);
        }
    }
    return rows;
}

std::vector<table_info> tableInfos(const std::vector<RingTable>& tables) {
    std::vector<table_info> infos;
    std::uint32_t rows = 0;
    for (const RingTable& table : tables) {
        infos.push_back({rows, table.rows, table.decay});
        rows += table.rows;
    }
    return infos;
}

}  // namespace tessera::subdivision
