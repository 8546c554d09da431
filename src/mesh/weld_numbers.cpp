// Goes through the patches once, in order: each vertex gets its number where it is first met. A curve's vertices come in runs of following
// numbers, one run a curve but for those that patches of several levels share.
#include "mesh/weld_numbers.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "mesh/pattern.h"
#include "mesh/weld_keys.h"

namespace tessera {

class WeldMaker {
public:
    WeldMaker(WeldNumbers& numbers, const MeshOutline& outline, WeldScope scope)
        : numbers_(numbers), outline_(outline), scope_(scope), keys_(outline.scene) {}

    void run() {
        const WeldNumbers::PatchSides nothing{};
        numbers_.patches_.assign(outline_.patches.size(), nothing);
        for (std::size_t patch = 0; patch < outline_.patches.size(); ++patch) {
            numbers_.firstNew_.push_back(next_);
            const std::uint32_t object = outline_.patches[patch].object;
            if (patch == 0 || object != outline_.patches[patch - 1].object) beginObject(object);
            const mesh_pattern& pattern = outline_.patterns[patch];
            if (pattern.form == MESH_NOTHING) continue;
            addLoop(patch);
            next_ += patternVertices(pattern) - patternLoop(pattern);
        }
        numbers_.firstNew_.push_back(next_);
    }

private:
    static constexpr std::uint64_t unknown = std::numeric_limits<std::uint64_t>::max();

    using Run = WeldNumbers::Run;
    using Curve = WeldNumbers::Curve;
    using Side = WeldNumbers::Side;

    // A curve cut into other numbers of segments is another curve.
    struct CutCurve {
        CurveKey curve{};
        std::uint32_t segments = 0;

        bool operator==(const CutCurve&) const = default;
    };

    void beginObject(std::uint32_t object) {
        keys_.setObject(object);
        if (scope_ != WeldScope::object) return;
        curves_.clear();
        firstCurve_ = numbers_.curves_.size();
        corners_.clear();
        cornerNumbers_.clear();
    }

    void addLoop(std::size_t patch) {
        const mesh_pattern& pattern = outline_.patterns[patch];
        const std::uint32_t inMesh = outline_.patches[patch].patch;
        WeldNumbers::PatchSides& own = numbers_.patches_[patch];
        for (std::uint32_t s = 0; s < 4; ++s)
            if (pattern.side[s] > 0) own.sides[s] = sideOf(inMesh, s, pattern.side[s]);
        for (std::uint32_t s = 0; s < 4; ++s) {
            if (pattern.side[s] == 0) continue;
            own.corners[s] = cornerOf(inMesh, s, pattern, own);
            addInner(own.sides[s], pattern.side[s]);
        }
    }

    Side sideOf(std::uint32_t patch, std::uint32_t side, std::uint32_t segments) {
        const BorderCurve border = keys_.curve(patch, side);
        const std::uint32_t whole = segments << border.level;
        const std::size_t number = firstCurve_ + curves_.of({border.key, whole});
        if (number == numbers_.curves_.size()) numbers_.curves_.push_back({whole, WeldNumbers::none, border.folded});
        const bool alongLoop = side < 2;
        return {static_cast<std::uint32_t>(number), border.index * segments, alongLoop != border.turned};
    }

    // Which corner the side's first one along the loop is, as parameters 0 or 1; where a side is one point all its corners are its first,
    // as in vertex_settle() (surface/vertex.clh).
    [[nodiscard]] std::array<std::uint32_t, 2> settledCorner(std::uint32_t side, const mesh_pattern& pattern) const {
        constexpr std::array<std::array<std::uint32_t, 2>, 4> starts{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        std::array<std::uint32_t, 2> at = starts[side];
        for (std::uint32_t s = 0; s < 4; ++s) {
            if (pattern.side[s] > 0 || !onSide(s, at)) continue;
            if (s == 1 && keys_.isTriangle()) at[0] = 1;
            at[s & 1U] = 0;
        }
        return at;
    }

    [[nodiscard]] bool onSide(std::uint32_t side, const std::array<std::uint32_t, 2>& at) const {
        if (side == 0) return at[1] == 0;
        if (side == 3) return at[0] == 0;
        if (keys_.isTriangle()) return side == 1 && at[0] + at[1] == 1;
        return side == 1 ? at[0] == 1 : at[1] == 1;
    }

    // As in vertex_by_records(): the last of the records that hold the corner strictly inside their curve gives it, else its control point.
    std::uint64_t cornerOf(std::uint32_t patch, std::uint32_t side, const mesh_pattern& pattern, const WeldNumbers::PatchSides& own) {
        const std::array<std::uint32_t, 2> at = settledCorner(side, pattern);
        std::optional<std::uint64_t> onRecord;
        for (std::uint32_t s = 0; s < 4; ++s) {
            if (pattern.side[s] == 0 || !onSide(s, at) || keys_.record(patch, s) == nullptr) continue;
            const Side& used = own.sides[s];
            const Curve& curve = numbers_.curves_[used.curve];
            const bool last = at[s & 1U] == 1;
            const std::uint32_t vertex = used.low + (last == (used.rises == (s < 2)) ? pattern.side[s] : 0);
            if (vertex == 0 || vertex == curve.segments) continue;
            cover(used.curve, vertex, vertex + 1, true);
            onRecord = numbers_.numberOn(curve, vertex);
        }
        if (onRecord) return *onRecord;
        const std::size_t number = corners_.of(keys_.corner(patch, side, side >= 2));
        if (number == cornerNumbers_.size()) cornerNumbers_.push_back(next_++);
        return cornerNumbers_[number];
    }

    void addInner(const Side& side, std::uint32_t segments) {
        if (segments > 1) cover(side.curve, side.low + 1, side.low + segments, side.rises);
    }

    // Numbers those of a curve's vertices [low, high) that have none, from the first on or from the last.
    void cover(std::uint32_t curveNumber, std::uint32_t low, std::uint32_t high, bool rises) {
        const Curve& curve = numbers_.curves_[curveNumber];
        if (curve.folded) {
            // Numbers are those of the first half. What reaches over the middle meets it from its nearer end, whichever way it goes.
            const std::uint32_t last = curve.segments / 2;
            if (low <= last && high > last + 1) {
                low = std::min(low, curve.segments - (high - 1));
                high = last + 1;
                rises = true;
            } else if (low > last) {
                const std::uint32_t end = curve.segments - low + 1;
                low = curve.segments - (high - 1);
                high = end;
                rises = !rises;
            }
        }
        std::vector<Run>& gaps = gaps_;
        findGaps(curve, low, high);
        if (!rises) std::reverse(gaps.begin(), gaps.end());
        for (Run& gap : gaps) {
            gap.first = next_;
            gap.falls = !rises;
            gap.next = numbers_.curves_[curveNumber].firstRun;
            next_ += gap.high - gap.low;
            numbers_.curves_[curveNumber].firstRun = static_cast<std::uint32_t>(numbers_.runs_.size());
            numbers_.runs_.push_back(gap);
        }
    }

    void findGaps(const Curve& curve, std::uint32_t low, std::uint32_t high) {
        covered_.clear();
        gaps_.clear();
        for (std::uint32_t r = curve.firstRun; r != WeldNumbers::none; r = numbers_.runs_[r].next)
            if (numbers_.runs_[r].low < high && numbers_.runs_[r].high > low) covered_.push_back(numbers_.runs_[r]);
        std::sort(covered_.begin(), covered_.end(), [](const Run& a, const Run& b) { return a.low < b.low; });
        for (const Run& run : covered_) {
            if (run.low > low) gaps_.push_back({low, run.low});
            low = std::max(low, run.high);
        }
        if (low < high) gaps_.push_back({low, high});
    }

    WeldNumbers& numbers_;
    const MeshOutline& outline_;
    WeldScope scope_;
    BorderKeys keys_;
    KeyNumbers<CutCurve> curves_;
    std::size_t firstCurve_ = 0;
    KeyNumbers<CornerKey> corners_;
    std::vector<std::uint64_t> cornerNumbers_;
    std::vector<Run> covered_;
    std::vector<Run> gaps_;
    std::uint64_t next_ = 0;
};

WeldNumbers::WeldNumbers(const MeshOutline& outline, WeldScope scope) : patterns_(outline.patterns) {
    firstNew_.reserve(outline.patches.size() + 1);
    if (scope != WeldScope::patch) {
        WeldMaker(*this, outline, scope).run();
        return;
    }
    firstNew_.push_back(0);
    for (const mesh_pattern& pattern : patterns_) firstNew_.push_back(firstNew_.back() + patternVertices(pattern));
}

std::uint64_t WeldNumbers::firstInner(std::size_t patch) const {
    const mesh_pattern& pattern = patterns_[patch];
    return firstNew_[patch + 1] - (patternVertices(pattern) - (pattern.form == MESH_NOTHING ? 0 : patternLoop(pattern)));
}

void WeldNumbers::loop(std::size_t patch, std::vector<std::uint64_t>& numbers) const {
    const mesh_pattern& pattern = patterns_[patch];
    numbers.resize(pattern.form == MESH_NOTHING ? 0 : patternLoop(pattern));
    if (patches_.empty()) {
        std::iota(numbers.begin(), numbers.end(), firstNew_[patch]);
        return;
    }
    std::size_t at = 0;
    for (std::size_t s = 0; s < 4 && at < numbers.size(); ++s) {
        const std::uint32_t segments = pattern.side[s];
        if (segments == 0) continue;
        numbers[at] = patches_[patch].corners[s];
        fill(patches_[patch].sides[s], std::span(numbers).subspan(at + 1, segments - 1));
        at += segments;
    }
}

void WeldNumbers::fill(const Side& side, std::span<std::uint64_t> inner) const {
    if (inner.empty()) return;
    const Curve& curve = curves_[side.curve];
    const auto count = static_cast<std::uint32_t>(inner.size());
    const auto place = [&](std::uint32_t vertex) { return side.rises ? vertex - side.low - 1 : side.low + count - vertex; };
    if (curve.folded) {
        for (std::uint32_t k = side.low + 1; k <= side.low + count; ++k) inner[place(k)] = numberOn(curve, k);
        return;
    }
    for (std::uint32_t r = curve.firstRun; r != none; r = runs_[r].next) {
        const Run& run = runs_[r];
        const std::uint32_t end = std::min(run.high, side.low + 1 + count);
        for (std::uint32_t k = std::max(run.low, side.low + 1); k < end; ++k)
            inner[place(k)] = run.first + (run.falls ? run.high - 1 - k : k - run.low);
    }
}

std::uint64_t WeldNumbers::numberOn(const Curve& curve, std::uint32_t vertex) const {
    const std::uint32_t k = curve.folded ? std::min(vertex, curve.segments - vertex) : vertex;
    std::uint32_t r = curve.firstRun;
    while (k < runs_[r].low || k >= runs_[r].high) r = runs_[r].next;
    return runs_[r].first + (runs_[r].falls ? runs_[r].high - 1 - k : k - runs_[r].low);
}

}  // namespace tessera
