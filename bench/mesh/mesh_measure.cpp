// Frames of the tessellator and their times by stage.
#include "mesh/mesh_measure.h"

#include "mesh/mesh_distance.h"
#include "mesh/mesh_scenes.h"
#include "mesh/sheet.h"
#include "tessera/error.h"

#include <array>
#include <cmath>
#include <utility>

namespace tessera::bench {

namespace {

constexpr double kPixelError = 0.5;
constexpr int kWidth = 1024;
constexpr int kHeight = 768;

Scene sheetScene(int along) {
    Mesh mesh;
    mesh.name = "sheet";
    mesh.points = bezierPoints(makeSheet(along));
    Scene scene;
    scene.name = "sheet";
    scene.meshes.push_back(std::move(mesh));
    Object object;
    object.name = object.mesh = "sheet";
    scene.objects.push_back(std::move(object));
    return scene;
}

void addSheets(std::vector<MeshMeasurement>& all, const std::string& prefix, int rate, int along) {
    for (const bool positionsOnly : {false, true}) {
        const std::string name = prefix + "/" + std::to_string(rate) + "/" + (positionsOnly ? "positions" : "full");
        all.push_back({name, [along] { return sheetScene(along); }, "", rate, along, positionsOnly});
    }
}

// Segments a side in the mean: a patch of rate r has r * r cells of two triangles.
double meanRate(const MeshSizes& sizes) {
    return std::sqrt(static_cast<double>(sizes.triangles) / 2.0 / static_cast<double>(sizes.patches));
}

// The finer, the more triangles: halved until it is fine enough, so that it never goes far below what 32-bit positions hold, then by
// bisection.
double toleranceOfRate(Tessellator& tessellator, TessellateOptions options, int rate) {
    const auto rateAt = [&](double tolerance) {
        options.tolerance = tolerance;
        return meanRate(tessellator.measure(options));
    };
    double fine = 1.0;
    while (rateAt(fine) < rate) fine *= 0.5;
    double coarse = 2.0 * fine;
    for (int step = 0; step < 30; ++step) {
        const double middle = std::sqrt(coarse * fine);
        const double found = rateAt(middle);
        if (std::abs(found - rate) < 0.01 * rate) return middle;
        (found < rate ? coarse : fine) = middle;
    }
    throw Error("no tolerance gives a mean rate of " + std::to_string(rate));
}

// What was measured for equal options would be used again, and a frame would pass for faster than one of an animation is. Measuring for
// others in between, outside the time, leaves nothing to use.
void forget(Tessellator& tessellator, TessellateOptions options) {
    options.tolerance *= 2.0;
    options.pixelError *= 2.0;
    static_cast<void>(tessellator.measure(options));
}

void takeFrame(const MeshStatistics& frame, std::map<std::string, std::vector<double>>& ms) {
    if (!(frame.factorsMs > 0.0)) throw Error("a frame took no time for its factors: it was not measured anew");
    const std::array<std::pair<const char*, double>, 6> stages{{{"place", frame.placeMs},
                                                                {"factors", frame.factorsMs},
                                                                {"offsets", frame.offsetsMs},
                                                                {"vertex", frame.vertexMs},
                                                                {"index", frame.indexMs},
                                                                {"all", frame.tessellateMs}}};
    for (const auto& [stage, value] : stages) ms[stage].push_back(value);
}

Camera cameraOf(const Scene& scene, const std::string& name) {
    if (!name.empty()) {
        const Camera* camera = scene.findCamera(name);
        if (camera == nullptr) throw Error("scene '" + scene.name + "' has no camera '" + name + "'");
        return *camera;
    }
    return scene.cameras.empty() ? framingCamera(scene, 40.0F) : scene.cameras.front();
}

MeshMeasured measured(Tessellator& tessellator, const MeshMeasurement& what, int runs) {
    MeshMeasured result;
    const Scene scene = what.make();
    tessellator.setScene(scene);
    TessellateOptions options;
    options.positionsOnly = what.positionsOnly;
    if (what.rate > 0) {
        options.tolerance = toleranceOfRate(tessellator, options, what.rate);
    } else {
        options.pixelError = kPixelError;
        options.camera = cameraOf(scene, what.camera);
        options.width = kWidth;
        options.height = kHeight;
    }
    for (int run = -1; run < runs; ++run) {
        forget(tessellator, options);
        result.sizes = tessellator.tessellate(options).sizes;
        if (run >= 0) takeFrame(tessellator.statistics(), result.ms);
    }
    result.tolerance = options.tolerance;
    if (what.along > 0 && !what.positionsOnly) {
        // Outside the time; what it throws stands in the table as the measurement's error.
        result.distance = greatestDistance(tessellator.tessellate(options), scene.meshes.front().points);
    }
    return result;
}

}  // namespace

std::vector<MeshMeasurement> meshMeasurements(const std::string& folder) {
    std::vector<MeshMeasurement> all;
    for (const MeshTrial& trial : meshTrials(folder)) {
        all.push_back({"table" + std::to_string(trial.table) + "/" + trial.name, trial.make, trial.camera, 0, 0, false});
    }
    for (const int rate : {4, 8, 16, 32, 64}) addSheets(all, "sheet", rate, 1024 / rate);
    for (const int rate : {8, 16}) addSheets(all, "equal", rate, 32);
    return all;
}

MeshMeasured measureMesh(Tessellator& tessellator, const MeshMeasurement& what, int runs) {
    MeshMeasured result;
    try {
        result = measured(tessellator, what, runs);
    } catch (const Error& error) {
        result = {};
        result.error = error.what();
    }
    result.name = what.name;
    result.along = what.along;
    return result;
}

}  // namespace tessera::bench
