// Split decisions made to do harm: the kernel's text, and its twin on the host.
#include "split_adversary.h"

#include <bit>
#include <stdexcept>

namespace tessera::splitting {
namespace {

// A patch's orders are the x of its first four control points: patch index, seed, plot, p. All arithmetic below is exact, so that
// kernel and host agree whatever the device's rounding: hashes are of integers, and the parameters are multiples of 2^-24.
constexpr const char* boundText = R"(
#if LANES == 1
#define bits_of(x) as_uint(x)
#else
#define bits_of(x) LANES_JOIN(as_uint, LANES)(x)
#endif

static inline vuint stir(vuint h, vuint more) {
    h = (h ^ more) * 0x9e3779b1u;
    return h ^ (h >> 15);
}

static inline vint bound_ranges(const frame_params* frame, const NET_SPACE float* net, int stride, vfloat u0, vfloat v0, vfloat u_size,
                                vfloat v_size, vint u_level, vint v_level, vint gregory) {
    vint patch_index = vto_int(load_lanes(net));
    vint seed = vto_int(load_lanes(net + stride));
    vint plot = vto_int(load_lanes(net + 2 * stride));
    vfloat p = load_lanes(net + 3 * stride);
    vint level = u_level + v_level;
    vuint h = stir(stir(stir(stir(stir(bits_of(seed), bits_of(patch_index)), bits_of(u0)), bits_of(v0)), bits_of(u_level)), bits_of(v_level));
    h = stir(h, h >> 7);
    vint coin = vlt(vas_int((h >> 8) & 255u), (vint)(140));
    vint deep = vle((vint)((int)frame->max_depth), level + 5);
    vint first = veq(u0, (vfloat)(0.0f)) & veq(v0, (vfloat)(0.0f));
    vint last = veq(u0 + u_size, (vfloat)(1.0f)) & veq(v0 + v_size, (vfloat)(1.0f));
    vint place = patch_index % vto_int(p);
    vint near_end = vlt((p - 1.0f - vto_float(place)) + (1.0f - u0 - u_size), p * u_size);

    vint splits = veq(plot, (vint)(0));
    splits |= veq(plot, (vint)(1)) & coin;
    splits |= veq(plot, (vint)(2)) & (coin | deep);
    splits |= veq(plot, (vint)(3)) & first;
    splits |= veq(plot, (vint)(4)) & last;
    splits |= veq(plot, (vint)(5)) & near_end;
    splits &= vlt(level, (vint)((int)frame->max_depth));

    vint along_u = veq(plot, (vint)(5)) | veq(vas_int((h >> 20) & 1u), (vint)(0));
    vint culls = veq(plot, (vint)(6)) | (veq(vas_int(h & 3u), (vint)(0)) & vlt(plot, (vint)(6)));
    vint ends = vselect((vint)(ACTION_DICE), (vint)(ACTION_CULL), culls);
    return vselect(ends, vselect((vint)(ACTION_SPLIT_V), (vint)(ACTION_SPLIT_U), along_u), splits);
}
)";

std::uint32_t stir(std::uint32_t h, std::uint32_t more) {
    h = (h ^ more) * 0x9e3779b1U;
    return h ^ (h >> 15U);
}

std::uint32_t hashOf(const Plan& plan, const range_t& range, const Side& u, const Side& v) {
    std::uint32_t h = plan.seed;
    for (const std::uint32_t more : {range.patch_index, std::bit_cast<std::uint32_t>(u.start), std::bit_cast<std::uint32_t>(v.start),
                                     static_cast<std::uint32_t>(u.level), static_cast<std::uint32_t>(v.level)})
        h = stir(h, more);
    return stir(h, h >> 7U);
}

bool splits(Plot plot, const Plan& plan, const range_t& range, const Side& u, const Side& v, std::uint32_t h) {
    const bool coin = ((h >> 8U) & 255U) < 140;
    switch (plot) {
        case Plot::everything:
            return true;
        case Plot::coin:
            return coin;
        case Plot::burst:
            return coin || u.level + v.level + 5 >= plan.depth;
        case Plot::first:
            return u.start == 0.0F && v.start == 0.0F;
        case Plot::last:
            return u.start + u.size == 1.0F && v.start + v.size == 1.0F;
        case Plot::tightest: {
            // Patches p-1, 2p-1, ... come last of those that are fed together.
            const double behind = static_cast<double>(plan.batch - 1 - range.patch_index % plan.batch) + (1.0 - u.start - u.size);
            return behind < static_cast<double>(plan.batch) * u.size;
        }
        case Plot::cullAll:
        case Plot::diceAll:
            break;
    }
    return false;
}

int decide(const Plan& plan, const range_t& range) {
    const Plot plot = plan.plots[range.patch_index];
    const Side u = sideOf(range.u_side);
    const Side v = sideOf(range.v_side);
    const std::uint32_t h = hashOf(plan, range, u, v);
    if (u.level + v.level < plan.depth && splits(plot, plan, range, u, v, h)) {
        return plot == Plot::tightest || ((h >> 20U) & 1U) == 0 ? ACTION_SPLIT_U : ACTION_SPLIT_V;
    }
    if (plot == Plot::cullAll) return ACTION_CULL;
    return plot != Plot::diceAll && (h & 3U) == 0 ? ACTION_CULL : ACTION_DICE;
}

}  // namespace

KernelSources adversarialKernels() {
    KernelSources sources = kernelSources();
    const auto bound = sources.find("split/bound.clh");
    if (bound == sources.end()) throw std::runtime_error("split/bound.clh is not among the kernels");
    bound->second = boundText;
    return sources;
}

Scene sceneOf(const Plan& plan) {
    Scene scene;
    scene.name = "plot";
    Mesh mesh;
    mesh.name = "orders";
    mesh.points.resize(16 * plan.plots.size());
    for (std::size_t patch = 0; patch < plan.plots.size(); ++patch) {
        glm::vec3* const points = &mesh.points[16 * patch];
        points[0].x = static_cast<float>(patch);
        points[1].x = static_cast<float>(plan.seed);
        points[2].x = static_cast<float>(static_cast<std::uint32_t>(plan.plots[patch]));
        points[3].x = static_cast<float>(plan.batch);
    }
    scene.meshes.push_back(std::move(mesh));
    Object object;
    object.name = "orders";
    object.mesh = "orders";
    scene.objects.push_back(object);
    return scene;
}

Decide decisionsOf(const Plan& plan) {
    return [&plan](const range_t& range) { return decide(plan, range); };
}

KernelSources replaced(KernelSources sources, const std::vector<Replacement>& replacements) {
    for (const Replacement& replacement : replacements) {
        const auto found = sources.find(replacement.file);
        if (found == sources.end()) throw std::runtime_error(replacement.file + " is not among the kernels");
        std::string& text = found->second;
        const std::size_t at = text.find(replacement.from);
        if (at == std::string::npos || text.find(replacement.from, at + 1) != std::string::npos)
            throw std::runtime_error("not found exactly once in " + replacement.file + ": " + replacement.from);
        text.replace(at, replacement.from.size(), replacement.to);
    }
    return sources;
}

}  // namespace tessera::splitting
