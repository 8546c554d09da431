// What both methods of `tessera tessellate` do alike: how fine where the command line does not say, and what is told at the end.
#pragma once

#include "choose_camera.h"
#include "load_scene.h"
#include "mesh_output.h"
#include "progress_line.h"
#include "tessellate_arguments.h"

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::program {

// A thousandth of the scene's size.
[[nodiscard]] double usualTolerance(const Scene& scene);

// The note that tells of it.
[[nodiscard]] std::string toleranceNote(double tolerance);

// Sets what is left open on the command line in `options`, which has what the line says of tolerance and pixel error; returns what the user
// may not expect, a line each. Options is TessellateOptions or TableOptions.
template <typename Options>
std::vector<std::string> completeDensity(Options& options, const CameraArguments& camera, const LoadedScene& loaded) {
    std::vector<std::string> notes = loaded.warnings;
    if (options.pixelError > 0.0) {
        const ChosenCamera chosen = chooseCamera(loaded.scene, camera);
        options.camera = chosen.camera;
        if (!chosen.note.empty()) notes.push_back(chosen.note);
    } else if (!(options.tolerance > 0.0)) {
        options.tolerance = usualTolerance(loaded.scene);
        notes.push_back(toleranceNote(options.tolerance));
    }
    return notes;
}

struct StreamedMesh {
    WrittenMesh written;
    double totalMs = 0;  // wall clock, from the first command to the file's name, writing included
};

// Streams a mesh of `tessellator`'s to the file. Engine is Tessellator or TableTessellator.
template <typename Engine, typename Options>
StreamedMesh streamMesh(Engine& tessellator, const Options& options, MeshOutput& output, bool quiet) {
    // Made whole of pieces and written as they come; what a file's end takes is not told by the tessellator.
    constexpr double kStreamShare = 0.95;
    ProgressLine line(!quiet, 1);
    // Without a line to show, the tessellator need not look at its counts in between.
    Progress progress;
    if (line.enabled()) progress = [&line](std::string_view stage, double fraction) { line.update(0, stage, kStreamShare * fraction); };
    const auto start = std::chrono::steady_clock::now();
    tessellator.stream(options, output, progress);
    line.update(0, "write", kStreamShare);
    StreamedMesh mesh{output.finish(), 0.0};
    mesh.totalMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return mesh;
}

// "32 patches, 800 vertices (welded), ...": `counted` is what the mesh was made of.
[[nodiscard]] std::string meshSummary(const std::string& counted, const MeshSizes& sizes, const StreamedMesh& mesh,
                                      const std::string& device, const TessellateArguments& arguments);

}  // namespace tessera::program
