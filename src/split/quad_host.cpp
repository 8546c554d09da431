// The host's side of the watertight split: the kernels' own rule, compiled as C++.
#include "split/quad_host.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "device/lanes_host.h"

// clang-format off
#include "device/kernel_headers_begin.h"
namespace tessera::kernels {
#include "split/quad_measure.clh"
}  // namespace tessera::kernels
#include "device/kernel_headers_end.h"
// clang-format on

namespace tessera {
namespace {

using Places = std::array<float, QUAD_SAMPLES>;

struct Sight {
    kernels::patch_ref eye;
    kernels::patch_ref dicing;
};

Sight sightOf(const frame_params& frame, const HostPatches& patches, std::uint32_t patchIndex) {
    const auto from = [&](const std::vector<float>& points) {
        return kernels::patch_at(&frame, points.data(), patches.placed.data(), patches.records.data(), patchIndex);
    };
    const kernels::patch_ref eye = from(patches.eyePoints);
    return {eye, patches.dicingPoints.empty() ? eye : from(patches.dicingPoints)};
}

float distance(const Places& x, const Places& y, std::size_t a, std::size_t b) {
    const float dx = x[b] - x[a];
    const float dy = y[b] - y[a];
    return std::sqrt(dx * dx + dy * dy);
}

// Whether the range lies wholly beyond one plane of the view, and how fine its interior must be.
bool judgeHull(const frame_params& frame, const Sight& sight, const quad_range& range, kernels::quad_interior& interior) {
    Places x{};
    Places y{};
    int outside = -1;
    const float rounding = kernels::hull_rounding(sight.eye);
    for (int k = 0; k < QUAD_HULL; ++k) {
        kernels::hull_lanes hull = kernels::quad_hull(sight.eye, &range, k);
        outside &= kernels::hull_outside(&frame, hull, rounding);
        if (frame.dicing_apart != 0) hull = kernels::quad_hull(sight.dicing, &range, k);
        const float scale = kernels::dicing_scale(&frame, hull.x, hull.y, hull.z, hull.w);
        x[static_cast<std::size_t>(k)] = hull.x * scale;
        y[static_cast<std::size_t>(k)] = hull.y * scale;
    }
    Places along{};
    Places across{};
    for (std::size_t k = 0; k < QUAD_HULL - 1; ++k) along[k] = distance(x, y, k, k + 1);
    for (std::size_t k = 0; k < QUAD_HULL - 4; ++k) across[k] = distance(x, y, k, k + 4);
    interior = kernels::quad_interior_of(&frame, sight.eye.kind, along.data(), across.data());
    if (outside != 0 && sight.eye.flags >= SIDE_RECORDED) outside &= kernels::records_outside(&frame, sight.eye, &range, rounding);
    return outside != 0;
}

std::uint32_t measuredRate(const frame_params& frame, const Sight& sight, const kernels::quad_edge& edge) {
    Places x{};
    Places y{};
    const kernels::quad_edge canonical = kernels::canonical_edge(edge);
    for (int k = 0; k < EDGE_SAMPLES; ++k) {
        const kernels::quad_point at = kernels::edge_sample(canonical, k);
        const kernels::vpoint p = kernels::patch_vertex(sight.dicing, at.u, at.v);
        const float scale = kernels::dicing_scale(&frame, p.x, p.y, p.z, 1.0F);
        x[static_cast<std::size_t>(k)] = p.x * scale;
        y[static_cast<std::size_t>(k)] = p.y * scale;
    }
    std::array<float, 4> parts{};
    for (std::size_t k = 0; k < parts.size(); ++k) parts[k] = distance(x, y, k, k + 1);
    const float dx = x[2] - 0.5F * (x[0] + x[4]);
    const float dy = y[2] - 0.5F * (y[0] + y[4]);
    return kernels::edge_rate(&frame, sight.dicing, edge, parts.data(), std::sqrt(dx * dx + dy * dy));
}

quad_cut measureCut(const frame_params& frame, const Sight& sight, const quad_range& range, int direction) {
    quad_cut cut{};
    std::array<kernels::quad_edge, 5> edges{};
    kernels::quad_cut_edges(&range, direction, edges.data());
    for (int e = 0; e < 5; ++e) {
        const std::uint32_t rate = kernels::quad_cut_measures(&range, direction, e)
                                       ? measuredRate(frame, sight, edges[static_cast<std::size_t>(e)])
                                       : kernels::quad_cut_share(&range, direction, e);
        if (e < 4)
            cut.halves = kernels::quad_with_byte(cut.halves, e, rate);
        else
            cut.inner = rate;
    }
    return cut;
}

void halve(const kernels::quad_point& a, const kernels::quad_point& b, std::uint32_t segments, std::vector<kernels::quad_point>& out) {
    if (segments < 2) return;
    const kernels::quad_point middle{(a.u + b.u) >> 1, (a.v + b.v) >> 1};
    halve(a, middle, segments / 2, out);
    out.push_back(middle);
    halve(middle, b, segments / 2, out);
}

}  // namespace

quad_range wholePatch(const frame_params& frame, std::uint32_t patchIndex) {
    const bool triangle = kernels::patch_kind(&frame, patchIndex) == KIND_PN;
    quad_range quad{patchIndex, 0, 0, {0, UNIT, triangle ? 0U : UNIT, 0}, {0, 0, UNIT, UNIT}};
    for (int k = 0; k < 4; ++k) quad.rates = kernels::quad_with_byte(quad.rates, k, RATE_UNKNOWN);
    return quad;
}

QuadStep splitOnHost(const frame_params& frame, const HostPatches& patches, const quad_range& range) {
    const Sight sight = sightOf(frame, patches, range.patch_index);
    QuadStep step;
    kernels::quad_interior interior{};
    if (judgeHull(frame, sight, range, interior)) return step;
    quad_range measured = range;
    for (int e = 0; e < 4; ++e) {
        if (kernels::quad_byte(range.rates, e) != RATE_UNKNOWN) continue;
        measured.rates = kernels::quad_with_byte(measured.rates, e, measuredRate(frame, sight, kernels::quad_own_edge(&range, e)));
    }
    step.action = kernels::quad_decide(&measured, interior, frame.grid_bits, frame.level_most);
    if (step.action == QUAD_DICE) {
        step.diced = kernels::quad_diced(&measured, interior, frame.grid_bits);
    } else {
        const int direction = step.action - QUAD_SPLIT;
        const quad_cut cut = measureCut(frame, sight, measured, direction);
        for (int k = 0; k < 2; ++k) step.children[static_cast<std::size_t>(k)] = kernels::quad_child(&measured, direction, cut, k);
    }
    return step;
}

std::vector<HostVertex> edgeVerticesOnHost(const frame_params& frame, const HostPatches& patches, const quad_range& range, int edge) {
    const Sight sight = sightOf(frame, patches, range.patch_index);
    const kernels::quad_point a = kernels::quad_corner(&range, edge);
    const kernels::quad_point b = kernels::quad_corner(&range, edge + 1);
    const std::uint32_t rate = kernels::quad_byte(range.rates, edge);
    std::vector<kernels::quad_point> points{a};
    if (rate != RATE_ZERO) {
        halve(a, b, 1U << (rate - 1), points);
        points.push_back(b);
    }
    std::vector<HostVertex> vertices;
    for (const kernels::quad_point& p : points) {
        const kernels::vpoint at = kernels::patch_vertex(sight.eye, p.u, p.v);
        vertices.push_back({static_cast<std::uint32_t>(p.u), static_cast<std::uint32_t>(p.v), {at.x, at.y, at.z}});
    }
    return vertices;
}

}  // namespace tessera
