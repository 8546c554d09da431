// Puts cells together: corners by place, borders by line. On a line the longest borders rule: their curves are drawn by all whose borders
// lie within, and corners strictly inside of one lie on its curve.
#include <algorithm>
#include <optional>
#include <span>
#include <unordered_map>

#include "scene/weld_curve.h"
#include "scene/weld_group.h"
#include "subdivision/cell_lines.h"

namespace tessera::subdivision {

namespace {

// More and a coarse border's least number of segments gets out of hand: 2 to the power of this.
constexpr std::uint32_t kMostCuts = 3;

struct PlacedBorder {
    CellBorder border;
    std::uint32_t cell = 0, side = 0;
};

// Line after line, along each; of those that begin together the longest first.
std::vector<PlacedBorder> sortedBorders(const QuadDomains& domains, std::span<const Cell> cells) {
    std::vector<PlacedBorder> borders;
    borders.reserve(4 * cells.size());
    for (std::uint32_t cell = 0; cell < cells.size(); ++cell) {
        for (std::uint32_t side = 0; side < 4; ++side) borders.push_back({borderOf(domains, cells[cell], side), cell, side});
    }
    std::sort(borders.begin(), borders.end(), [](const PlacedBorder& a, const PlacedBorder& b) {
        if (a.border.line != b.border.line) return a.border.line < b.border.line;
        if (a.border.begin != b.border.begin) return a.border.begin < b.border.begin;
        if (a.border.end != b.border.end) return a.border.end > b.border.end;
        return 4 * std::uint64_t{a.cell} + a.side < 4 * std::uint64_t{b.cell} + b.side;
    });
    return borders;
}

// Borders within the first one's, which is longer than, or as long as, any.
using Interval = std::span<const PlacedBorder>;

std::vector<Interval> intervalsOf(std::span<const PlacedBorder> borders) {
    std::vector<Interval> intervals;
    for (std::size_t first = 0; first < borders.size();) {
        std::size_t end = first + 1;
        while (end < borders.size() && borders[end].border.line == borders[first].border.line &&
               borders[end].border.end <= borders[first].border.end) {
            ++end;
        }
        intervals.push_back(borders.subspan(first, end - first));
        first = end;
    }
    return intervals;
}

std::uint32_t lengthOf(const PlacedBorder& border) { return border.border.end - border.border.begin; }

std::uint32_t levelIn(const Interval& interval, const PlacedBorder& border) {
    std::uint32_t level = 0;
    while (lengthOf(border) << level < lengthOf(interval.front())) ++level;
    return level;
}

std::uint32_t cutsOf(const Interval& interval) {
    std::uint32_t cuts = 0;
    for (const PlacedBorder& border : interval) cuts = std::max(cuts, levelIn(interval, border));
    return cuts;
}

// Cuts bicubic cells whose borders have too fine neighbours, until none has.
void balance(const QuadDomains& domains, std::vector<Cell>& cells) {
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<std::uint8_t> cut(cells.size());  // 1 in u, 2 in v
        const std::vector<PlacedBorder> borders = sortedBorders(domains, cells);
        for (const Interval& interval : intervalsOf(borders)) {
            if (cutsOf(interval) <= kMostCuts) continue;
            for (const PlacedBorder& border : interval) {
                if (lengthOf(border) != lengthOf(interval.front()) || cells[border.cell].kind != PatchKind::bezier) continue;
                cut[border.cell] = border.side % 2 == 0 ? 1 : 2;
                changed = true;
            }
        }
        if (!changed) break;
        std::vector<Cell> finer;
        finer.reserve(cells.size() + 64);
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (cut[k] == 0) {
                finer.push_back(cells[k]);
            } else {
                for (const Cell& part : cutCell(cells[k], cut[k] == 1)) finer.push_back(part);
            }
        }
        cells = std::move(finer);
    }
}

glm::vec3 single(const glm::dvec3& p) { return glm::vec3(p) + 0.0F; }  // and +0 for -0

class Stitcher {
public:
    Stitcher(const QuadDomains& domains, std::vector<Cell> cells) : domains_(domains), cells_(std::move(cells)) {
        balance(domains_, cells_);
        borders_ = sortedBorders(domains_, cells_);
        intervals_ = intervalsOf(borders_);
    }

    StitchedMeshes make(bool textured) {
        findPlaces();
        setCorners();
        for (const Interval& interval : intervals_) setBorders(interval);
        return meshes(textured);
    }

private:
    struct Place {
        glm::vec3 point{0.0F};
        std::uint32_t interval = kNone;  // in whose inside it lies
        bool settled = false;
    };
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    [[nodiscard]] const welding::Layout& layoutOf(std::uint32_t cell) const { return welding::layout(cells_[cell].kind); }
    [[nodiscard]] PlaceKey cornerPlace(std::uint32_t cell, std::uint32_t corner) const { return placeOf(domains_, cells_[cell], corner); }

    // A place is where the first of the cells with a corner there has it, unless it lies on a longer border's curve.
    void findPlaces() {
        places_.reserve(2 * cells_.size());
        for (std::uint32_t cell = 0; cell < cells_.size(); ++cell) {
            for (std::uint32_t corner = 0; corner < 4; ++corner) {
                const auto [at, isNew] = places_.try_emplace(cornerPlace(cell, corner));
                if (isNew) at->second.point = single(cells_[cell].points[layoutOf(cell).corners[corner]]);
            }
        }
        for (std::uint32_t k = 0; k < intervals_.size(); ++k) {
            const CellBorder& whole = intervals_[k].front().border;
            for (const PlacedBorder& border : intervals_[k]) {
                for (const std::uint32_t at : {border.border.begin, border.border.end}) {
                    if (at > whole.begin && at < whole.end) places_.at(placeOn(domains_, whole.line, at)).interval = k;
                }
            }
        }
    }

    // The curve of an interval, along its line, between its settled ends. Ends are settled first: borders end on borders that run on, and
    // cells come from halving, so that no chain of these comes back.
    [[nodiscard]] EdgeRecord curveOf(const Interval& interval) {
        const PlacedBorder& whole = interval.front();
        const welding::Layout& where = layoutOf(whole.cell);
        EdgeRecord curve;
        for (std::size_t k = 0; k < 4; ++k) curve.points[k] = single(cells_[whole.cell].points[where.sides[whole.side][k]]);
        curve.points[0] = settled(cornerPlace(whole.cell, static_cast<std::uint32_t>(where.ends[whole.side][0])));
        curve.points[3] = settled(cornerPlace(whole.cell, static_cast<std::uint32_t>(where.ends[whole.side][1])));
        if (whole.border.reversed) std::reverse(curve.points.begin(), curve.points.end());
        return curve;
    }

    glm::vec3 settled(const PlaceKey& key) {
        Place& place = places_.at(key);
        if (place.settled) return place.point;
        place.settled = true;
        if (place.interval == kNone) return place.point;
        const Interval& interval = intervals_[place.interval];
        const CellBorder& whole = interval.front().border;
        const std::uint32_t at = key.kind == 2 ? (whole.line.inside == 1 ? key.a : key.b) : key.kind == 1 ? key.a : kLineLength / 2;
        const float t = static_cast<float>(at - whole.begin) / static_cast<float>(whole.end - whole.begin);
        place.point = welding::pointOnRecord(curveOf(interval), t) + 0.0F;
        return place.point;
    }

    void setCorners() {
        for (std::uint32_t cell = 0; cell < cells_.size(); ++cell) {
            for (std::uint32_t corner = 0; corner < 4; ++corner) {
                cells_[cell].points[layoutOf(cell).corners[corner]] = glm::dvec3(settled(cornerPlace(cell, corner)));
            }
        }
    }

    // The interval's curve to the borders that are all of it; a record to all where some are finer.
    void setBorders(const Interval& interval) {
        EdgeRecord record = curveOf(interval);
        record.cuts = cutsOf(interval);
        for (const PlacedBorder& border : interval) {
            record.level = levelIn(interval, border);
            record.reversed = border.border.reversed;
            if (record.level == 0) {
                const std::array<std::size_t, 4>& side = layoutOf(border.cell).sides[border.side];
                for (std::size_t k = 1; k < 3; ++k) {
                    cells_[border.cell].points[side[k]] = glm::dvec3(record.points[record.reversed ? 3 - k : k]);
                }
            }
            if (record.cuts == 0) continue;
            record.index = (border.border.begin - interval.front().border.begin) / lengthOf(border);
            record.patch = border.cell;  // of all cells, until there are meshes
            record.side = border.side;
            records_.push_back(record);
        }
    }

    StitchedMeshes meshes(bool textured) {
        StitchedMeshes made;
        made.bezier.kind = PatchKind::bezier;
        made.gregory.kind = PatchKind::gregory;
        std::sort(records_.begin(), records_.end(),
                  [](const EdgeRecord& a, const EdgeRecord& b) { return a.patch != b.patch ? a.patch < b.patch : a.side < b.side; });
        std::size_t next = 0;
        for (std::uint32_t k = 0; k < cells_.size(); ++k) {
            const Cell& cell = cells_[k];
            Mesh& mesh = cell.kind == PatchKind::gregory ? made.gregory : made.bezier;
            const auto patch = static_cast<std::uint32_t>(mesh.patchCount());
            for (std::size_t i = 0; i < pointsPerPatch(cell.kind); ++i) mesh.points.push_back(single(cell.points[i]));
            if (textured) {
                for (const glm::dvec2& point : cell.texture) mesh.textureNets.emplace_back(point);
            }
            (cell.kind == PatchKind::gregory ? made.gregoryDomains : made.bezierDomains).push_back(cell.domain);
            for (; next < records_.size() && records_[next].patch == k; ++next) {
                mesh.edges.push_back(records_[next]);
                mesh.edges.back().patch = patch;
            }
        }
        made.bezier.welded = made.gregory.welded = true;
        return made;
    }

    const QuadDomains& domains_;
    std::vector<Cell> cells_;
    std::vector<PlacedBorder> borders_;
    std::vector<Interval> intervals_;
    std::unordered_map<PlaceKey, Place, PlaceHash> places_;
    std::vector<EdgeRecord> records_;
};

}  // namespace

StitchedMeshes stitch(const QuadDomains& domains, std::vector<Cell> cells, bool textured) {
    return Stitcher(domains, std::move(cells)).make(textured);
}

}  // namespace tessera::subdivision
