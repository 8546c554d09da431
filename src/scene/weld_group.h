// The patches that weld() looks at together, and where the control points of their borders lie.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/weld_curve.h"
#include "tessera/scene.h"

namespace tessera::welding {

// "No point", "no corner".
constexpr std::size_t kNone = ~std::size_t{0};

// Where a kind of patch has its border points. Corners are numbered (0, 0), (1, 0), (1, 1), (0, 1); sides as in EdgeRecord.
struct Layout {
    std::array<std::size_t, 4> corners{};               // the point in each corner
    std::array<std::array<std::size_t, 4>, 4> sides{};  // the points along each side
    std::array<std::array<std::size_t, 2>, 4> ends{};   // the corners in which each side begins and ends
};

[[nodiscard]] const Layout& layout(PatchKind kind);

// Patches are numbered mesh by mesh, borders 4 * patch + side. A pn triangle has no border of side 2.
class Group {
public:
    struct Place {
        Mesh* mesh = nullptr;
        std::size_t meshIndex = 0;
        std::size_t patch = 0;  // in the mesh
    };

    // `relativeTolerance` times the diagonal of a mesh's bounds is its tolerance. The meshes must outlive the group.
    // Throws Error naming the first mesh when there are more patches than numbers for them.
    Group(std::vector<Mesh*> meshes, double relativeTolerance);

    [[nodiscard]] const std::vector<Mesh*>& meshes() const { return meshes_; }
    [[nodiscard]] std::size_t patchCount() const { return firstPatch_.back(); }
    [[nodiscard]] std::size_t firstPatch(std::size_t meshIndex) const { return firstPatch_[meshIndex]; }
    [[nodiscard]] double meshTolerance(std::size_t meshIndex) const { return tolerances_[meshIndex]; }

    [[nodiscard]] Place place(std::size_t patch) const;
    [[nodiscard]] double tolerance(std::uint32_t border) const { return tolerances_[place(border / 4).meshIndex]; }
    [[nodiscard]] Curve curve(std::uint32_t border) const;

private:
    std::vector<Mesh*> meshes_;
    std::vector<std::size_t> firstPatch_;  // one a mesh, and the count
    std::vector<double> tolerances_;       // absolute, one a mesh
};

// The meshes of `scene` by the transforms of their objects: those that share one, to the bit, are in one group, and so on. Meshes keep
// their order, and groups that of their first meshes.
[[nodiscard]] std::vector<std::vector<Mesh*>> meshesByTransform(Scene& scene);

}  // namespace tessera::welding
