// OpenSubdiv's evaluators on one thread and with OpenMP.
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/osd/bufferDescriptor.h>
#include <opensubdiv/osd/cpuEvaluator.h>
#include <opensubdiv/osd/cpuPatchTable.h>
#include <opensubdiv/osd/ompEvaluator.h>

#include <algorithm>
#include <chrono>

#include "subdivision/refiner.h"
#include "table_bench.h"

namespace tessera::bench {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Osd = OpenSubdiv::Osd;

// Points that limit stencils are made of at most: 18 coefficients of 16 bytes each are some 430 MB.
constexpr std::uint64_t mostStencils = 1'500'000;
constexpr int isolation = 4;

double since(std::chrono::steady_clock::time_point began) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
}

std::vector<float> pointsOf(const Cage& cage) {
    std::vector<float> points;
    for (const glm::vec3& p : cage.points) points.insert(points.end(), {p.x, p.y, p.z});
    return points;
}

// Output of one contender.
struct Output {
    std::vector<float> points, du, dv;
    void resize(std::size_t vertices, bool normals) {
        points.resize(3 * vertices);
        if (!normals) return;
        du.resize(3 * vertices);
        dv.resize(3 * vertices);
    }
};

const Osd::BufferDescriptor three(0, 3, 3);

template <typename Evaluator>
void evalStencils(const std::vector<float>& from, Output& to, const Far::LimitStencilTable& table, bool normals) {
    const int count = table.GetNumStencils();
    if (normals) {
        Evaluator::EvalStencils(from.data(), three, to.points.data(), three, to.du.data(), three, to.dv.data(), three,
                                table.GetSizes().data(), table.GetOffsets().data(), table.GetControlIndices().data(),
                                table.GetWeights().data(), table.GetDuWeights().data(), table.GetDvWeights().data(), 0, count);
    } else {
        Evaluator::EvalStencils(from.data(), three, to.points.data(), three, table.GetSizes().data(), table.GetOffsets().data(),
                                table.GetControlIndices().data(), table.GetWeights().data(), 0, count);
    }
}

// A cage's points at (i, j) / 2^level of the first faces, in rows.
std::size_t facesFor(const Cage& cage, std::uint64_t each) { return std::min<std::size_t>(cage.faceCount(), mostStencils / each); }

}  // namespace

std::vector<Contender> limitStencils(const Cage& cage, int level, bool normals) {
    const std::uint64_t side = (std::uint64_t{1} << level) + 1, each = side * side;
    const std::size_t faces = facesFor(cage, each);
    const std::unique_ptr<subdivision::Refiner> refiner = subdivision::makeRefiner(cage);
    refiner->RefineAdaptive(subdivision::Refiner::AdaptiveOptions(isolation));
    std::vector<float> s, t;
    for (std::uint64_t k = 0; k < each; ++k) {
        s.push_back(static_cast<float>(k % side) / static_cast<float>(side - 1));
        t.push_back(static_cast<float>(k / side) / static_cast<float>(side - 1));
    }
    Far::LimitStencilTableFactory::LocationArrayVec locations(faces);
    for (std::size_t f = 0; f < faces; ++f) {
        locations[f].ptexIdx = static_cast<int>(f);
        locations[f].numLocations = static_cast<int>(each);
        locations[f].s = s.data();
        locations[f].t = t.data();
    }
    Far::LimitStencilTableFactory::Options options;
    options.generate1stDerivatives = normals;
    const std::shared_ptr<const Far::LimitStencilTable> table(
        Far::LimitStencilTableFactory::Create(*refiner, locations, nullptr, nullptr, options));
    const std::uint64_t entries = table->GetControlIndices().size(), vertices = faces * each;
    const auto bytes = static_cast<double>(entries * (normals ? 16 : 8) + vertices * 8);
    const double share = static_cast<double>(faces) / static_cast<double>(cage.faceCount());
    const auto points = std::make_shared<const std::vector<float>>(pointsOf(cage));
    const auto to = std::make_shared<Output>();
    to->resize(vertices, normals);
    std::vector<Contender> out;
    for (const Threads threads : {Threads::one, Threads::openMp}) {
        Contender c;
        c.name = threads == Threads::one ? "limit stencils, CpuEvaluator" : "limit stencils, OmpEvaluator";
        c.vertices = vertices;
        c.share = share;
        c.memoryBytes = static_cast<std::uint64_t>(bytes / share);
        c.frameBytes = 0;
        c.run = [=] {
            const auto began = std::chrono::steady_clock::now();
            if (threads == Threads::one)
                evalStencils<Osd::CpuEvaluator>(*points, *to, *table, normals);
            else
                evalStencils<Osd::OmpEvaluator>(*points, *to, *table, normals);
            return since(began);
        };
        out.push_back(std::move(c));
    }
    return out;
}

namespace {

// A patch table with the stencils of its points.
struct Patches {
    std::unique_ptr<Far::PatchTable> far;
    std::unique_ptr<Osd::CpuPatchTable> table;
    std::unique_ptr<const Far::StencilTable> stencils;  // of all points behind the cage's own
    std::vector<Osd::PatchCoord> places;
    std::vector<float> points;  // the cage's, then the stencils'
    std::size_t cagePoints = 0;
};

std::shared_ptr<Patches> makePatches(const Cage& cage, std::uint64_t side, std::size_t faces) {
    auto out = std::make_shared<Patches>();
    const std::unique_ptr<subdivision::Refiner> refiner = subdivision::makeRefiner(cage);
    Far::PatchTableFactory::Options options(isolation);
    options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    refiner->RefineAdaptive(options.GetRefineAdaptiveOptions());
    out->far.reset(Far::PatchTableFactory::Create(*refiner, options));
    Far::StencilTableFactory::Options stencilOptions;
    stencilOptions.generateOffsets = true;
    const std::unique_ptr<const Far::StencilTable> refined(Far::StencilTableFactory::Create(*refiner, stencilOptions));
    out->stencils.reset(
        Far::StencilTableFactory::AppendLocalPointStencilTable(*refiner, refined.get(), out->far->GetLocalPointStencilTable()));
    out->table.reset(Osd::CpuPatchTable::Create(out->far.get()));
    const Far::PatchMap map(*out->far);
    for (std::size_t f = 0; f < faces; ++f) {
        for (std::uint64_t k = 0; k < side * side; ++k) {
            const double s = static_cast<double>(k % side) / static_cast<double>(side - 1),
                         t = static_cast<double>(k / side) / static_cast<double>(side - 1);
            const Far::PatchTable::PatchHandle* const handle = map.FindPatch(static_cast<int>(f), s, t);
            out->places.emplace_back(*handle, static_cast<float>(s), static_cast<float>(t));
        }
    }
    out->points = pointsOf(cage);
    out->cagePoints = cage.points.size();
    out->points.resize(out->points.size() + 3 * static_cast<std::size_t>(out->stencils->GetNumStencils()));
    return out;
}

template <typename Evaluator>
void evalPatches(Patches& p, Output& to, bool normals) {
    float* const behind = p.points.data() + 3 * p.cagePoints;
    Evaluator::EvalStencils(p.points.data(), three, behind, three, p.stencils->GetSizes().data(), p.stencils->GetOffsets().data(),
                            p.stencils->GetControlIndices().data(), p.stencils->GetWeights().data(), 0, p.stencils->GetNumStencils());
    const int count = static_cast<int>(p.places.size());
    if (normals) {
        Evaluator::EvalPatches(p.points.data(), three, to.points.data(), three, to.du.data(), three, to.dv.data(), three, count,
                               p.places.data(), p.table->GetPatchArrayBuffer(), p.table->GetPatchIndexBuffer(),
                               p.table->GetPatchParamBuffer());
    } else {
        Evaluator::EvalPatches(p.points.data(), three, to.points.data(), three, count, p.places.data(), p.table->GetPatchArrayBuffer(),
                               p.table->GetPatchIndexBuffer(), p.table->GetPatchParamBuffer());
    }
}

}  // namespace

std::vector<Contender> patchEvaluation(const Cage& cage, int level, bool normals) {
    const std::uint64_t side = (std::uint64_t{1} << level) + 1;
    const std::size_t faces = facesFor(cage, side * side);
    const std::shared_ptr<Patches> patches = makePatches(cage, side, faces);
    const auto to = std::make_shared<Output>();
    to->resize(patches->places.size(), normals);
    const double share = static_cast<double>(faces) / static_cast<double>(cage.faceCount());
    const std::uint64_t fixed = patches->table->GetPatchIndexSize() * sizeof(int) + patches->stencils->GetControlIndices().size() * 8 +
                                patches->points.size() * sizeof(float);
    std::vector<Contender> out;
    for (const Threads threads : {Threads::one, Threads::openMp}) {
        Contender c;
        c.name = threads == Threads::one ? "patches, CpuEvaluator" : "patches, OmpEvaluator";
        c.vertices = patches->places.size();
        c.share = share;
        c.memoryBytes = fixed + static_cast<std::uint64_t>(static_cast<double>(patches->places.size() * sizeof(Osd::PatchCoord)) / share);
        c.run = [=] {
            const auto began = std::chrono::steady_clock::now();
            if (threads == Threads::one)
                evalPatches<Osd::CpuEvaluator>(*patches, *to, normals);
            else
                evalPatches<Osd::OmpEvaluator>(*patches, *to, normals);
            return since(began);
        };
        out.push_back(std::move(c));
    }
    return out;
}

}  // namespace tessera::bench
