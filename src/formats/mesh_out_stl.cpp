// Binary STL: 80 bytes of text, a count, and 50 bytes a triangle.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "formats/file_section.h"
#include "formats/mesh_out_base.h"
#include "formats/mesh_out_formats.h"

namespace tessera {
namespace {

using Position = std::array<float, 3>;

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kTriangleBytes = 50;

Position positionOf(const MeshPiece& piece, std::uint64_t k) {
    const float* const at = piece.positions.empty() ? piece.vertices[k].position : piece.positions.data() + 3 * k;
    return {at[0], at[1], at[2]};
}

// 0 where the triangle has no area: so the format has it.
Position facetNormal(const std::array<Position, 3>& p) {
    std::array<double, 3> a{}, b{};
    for (std::size_t c = 0; c < 3; ++c) {
        a[c] = double{p[1][c]} - double{p[0][c]};
        b[c] = double{p[2][c]} - double{p[0][c]};
    }
    const std::array<double, 3> n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (length == 0.0) return {0.0F, 0.0F, 0.0F};
    return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length), static_cast<float>(n[2] / length)};
}

class StlWriter final : public FormatWriter {
public:
    explicit StlWriter(const std::filesystem::path& path) : FormatWriter(path, false) {}

    [[nodiscard]] bool positionsSuffice() const override { return true; }

protected:
    void layOut() override {
        checkCount(triangles_, std::numeric_limits<std::uint32_t>::max(), "triangles");
        vertices_ = 3 * triangles_;
        bytes_ = kHeaderBytes + kTriangleBytes * triangles_;
        section_.emplace(makeFile(bytes_), 0);
        // It must not begin with "solid", by which readers know text.
        constexpr std::string_view note = "binary STL made by Tessera";
        std::array<std::byte, 80> header{};
        std::transform(note.begin(), note.end(), header.begin(), [](char c) { return static_cast<std::byte>(c); });
        section_->put(header);
        BytePutter(section_->room(4)).put(static_cast<std::uint32_t>(triangles_));
    }

    void writeUnit(const MeshPiece& piece, const MeshUnit& unit) override {
        eachFace(piece, unit, [&](std::span<const std::uint32_t> corners) {
            std::array<Position, 3> p{};
            for (std::size_t k = 0; k < 3; ++k) p[k] = positionOf(piece, unit.firstVertex + corners[k]);
            BytePutter out(section_->room(kTriangleBytes));
            out.put(facetNormal(p));
            out.put(p);
            out.put(std::uint16_t{0});
        });
    }

    void complete() override { section_->flush(); }

private:
    std::optional<FileSection> section_;
};

}  // namespace

std::unique_ptr<MeshWriter> makeStlWriter(const std::filesystem::path& path) { return std::make_unique<StlWriter>(path); }

}  // namespace tessera
