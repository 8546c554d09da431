// opensubdiv_sheet: points per second of OpenSubdiv's patch evaluation, by one thread and by OpenMP, on the sheet's regular patches.
#include "mesh/comparator.h"
#include "mesh/sheet.h"

#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/osd/cpuEvaluator.h>
#include <opensubdiv/osd/cpuPatchTable.h>
#include <opensubdiv/osd/ompEvaluator.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace Far = OpenSubdiv::Far;
namespace Osd = OpenSubdiv::Osd;
using namespace tessera::bench;

// The sheet's control points as a grid of quads. Its border's faces have no limit surface, so that what is left is the sheet.
std::unique_ptr<Far::PatchTable> patchTableOf(const Sheet& sheet) {
    const int across = sheet.pointsAlong();
    std::vector<int> corners;
    for (int j = 0; j + 1 < across; ++j) {
        for (int i = 0; i + 1 < across; ++i) {
            const int first = j * across + i;
            corners.insert(corners.end(), {first, first + 1, first + across + 1, first + across});
        }
    }
    const std::vector<int> counts(corners.size() / 4, 4);
    Far::TopologyDescriptor grid;
    grid.numVertices = across * across;
    grid.numFaces = static_cast<int>(counts.size());
    grid.numVertsPerFace = counts.data();
    grid.vertIndicesPerFace = corners.data();
    OpenSubdiv::Sdc::Options rules;
    rules.SetVtxBoundaryInterpolation(OpenSubdiv::Sdc::Options::VTX_BOUNDARY_NONE);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    const std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(grid, Factory::Options(OpenSubdiv::Sdc::SCHEME_CATMARK, rules)));
    refiner->RefineAdaptive(Far::TopologyRefiner::AdaptiveOptions(1));
    return std::unique_ptr<Far::PatchTable>(Far::PatchTableFactory::Create(*refiner));
}

// (rate + 1)^2 points a patch, patch after patch, which is the kindest order to caches.
std::vector<Osd::PatchCoord> coordinates(const Sheet& sheet, const Far::PatchTable& table, int rate) {
    const Far::PatchMap map(table);
    std::vector<Osd::PatchCoord> places;
    for (int row = 0; row < sheet.along; ++row) {
        for (int column = 0; column < sheet.along; ++column) {
            const int face = (row + 1) * (sheet.along + 2) + column + 1;
            for (int j = 0; j <= rate; ++j) {
                for (int i = 0; i <= rate; ++i) {
                    const double s = static_cast<double>(i) / rate;
                    const double t = static_cast<double>(j) / rate;
                    const Far::PatchTable::PatchHandle* handle = map.FindPatch(face, s, t);
                    if (handle == nullptr) throw std::runtime_error("OpenSubdiv has no patch for face " + std::to_string(face));
                    places.emplace_back(*handle, static_cast<float>(s), static_cast<float>(t));
                }
            }
        }
    }
    return places;
}

// What is evaluated, and where to: three floats a point, and as many for either derivative.
struct Work {
    const float* source = nullptr;
    std::vector<Osd::PatchCoord> places;
    std::unique_ptr<Osd::CpuPatchTable> table;
    std::vector<float> positions, du, dv;
};

template <typename Evaluator>
void evaluatePositions(Work& work) {
    const Osd::BufferDescriptor three(0, 3, 3);
    if (!Evaluator::EvalPatches(work.source, three, work.positions.data(), three, static_cast<int>(work.places.size()), work.places.data(),
                                work.table->GetPatchArrayBuffer(), work.table->GetPatchIndexBuffer(), work.table->GetPatchParamBuffer())) {
        throw std::runtime_error("OpenSubdiv refused to evaluate");
    }
}

template <typename Evaluator>
void evaluateDerivatives(Work& work) {
    const Osd::BufferDescriptor three(0, 3, 3);
    if (!Evaluator::EvalPatches(work.source, three, work.positions.data(), three, work.du.data(), three, work.dv.data(), three,
                                static_cast<int>(work.places.size()), work.places.data(), work.table->GetPatchArrayBuffer(),
                                work.table->GetPatchIndexBuffer(), work.table->GetPatchParamBuffer())) {
        throw std::runtime_error("OpenSubdiv refused to evaluate");
    }
}

// That both programs are asked for one surface: the greatest distance of what was evaluated from the Bezier form.
double greatestDistance(const Sheet& sheet, const Work& work, int rate) {
    const std::vector<glm::vec3> patches = bezierPoints(sheet);
    const std::size_t each = static_cast<std::size_t>(rate + 1) * static_cast<std::size_t>(rate + 1);
    double greatest = 0;
    for (std::size_t i = 0; i < work.places.size(); ++i) {
        const glm::dvec3 there(work.positions[3 * i], work.positions[3 * i + 1], work.positions[3 * i + 2]);
        const glm::dvec3 here = bezierPoint(&patches[i / each * 16], work.places[i].s, work.places[i].t);
        greatest = std::max(greatest, glm::length(there - here));
    }
    return greatest;
}

void measure(const std::map<std::string, double>& options) {
    const Sheet sheet = makeSheet(static_cast<int>(options.at("along")));
    const int rate = static_cast<int>(options.at("rate"));
    const int runs = static_cast<int>(options.at("runs"));
    const std::unique_ptr<Far::PatchTable> table = patchTableOf(sheet);
    Work work;
    work.source = &sheet.points.front().x;
    work.places = coordinates(sheet, *table, rate);
    work.table = std::make_unique<Osd::CpuPatchTable>(table.get());
    work.positions.resize(3 * work.places.size());
    work.du.resize(work.positions.size());
    work.dv.resize(work.positions.size());
    evaluatePositions<Osd::CpuEvaluator>(work);
    const double distance = greatestDistance(sheet, work, rate);
    if (!(distance < 1e-5 * sheet.along))
        throw std::runtime_error("OpenSubdiv's surface is another one, " + std::to_string(distance) + " away");
    const std::map<std::string, double> counts{{"points", static_cast<double>(work.places.size())},
                                               {"patches", static_cast<double>(table->GetNumPatchesTotal())}};
    printRuns("cpu_positions", counts, secondsOf(runs, [&] { evaluatePositions<Osd::CpuEvaluator>(work); }));
    printRuns("cpu_derivatives", counts, secondsOf(runs, [&] { evaluateDerivatives<Osd::CpuEvaluator>(work); }));
    printRuns("omp_positions", counts, secondsOf(runs, [&] { evaluatePositions<Osd::OmpEvaluator>(work); }));
    printRuns("omp_derivatives", counts, secondsOf(runs, [&] { evaluateDerivatives<Osd::OmpEvaluator>(work); }));
}

}  // namespace

int main(int argc, char** argv) {
    return guarded("opensubdiv_sheet", [&] { measure(numberOptions(argc, argv, {{"along", 64}, {"rate", 16}, {"runs", 3}})); });
}
