// Animates a surface: a sheet of cubic B-splines in the wind, tessellated anew each frame into buffers that stay on the device.
//     animate_surface [FRAMES]
// Only control points travel to the device, and the buffers of one frame are used again by the next. What draws them takes DeviceMesh's
// buffers as they are, on its queue or any of its context.
#include <tessera/error.h>
#include <tessera/scene.h>
#include <tessera/surfaces.h>
#include <tessera/tessellator.h>

#include <charconv>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iostream>
#include <string_view>

namespace {

constexpr std::size_t kPoints = 20;  // along each side of the sheet, which is 10 units wide: 17 x 17 patches
constexpr double kFrameSeconds = 1.0 / 30.0;

// Uniform knots: neighbouring patches meet smoothly, and share their borders to the bit, so the mesh has no cracks in any frame.
tessera::Nurbs flatSheet() {
    tessera::Nurbs sheet;
    sheet.name = "sheet";
    sheet.uCount = kPoints;
    for (std::size_t i = 0; i < kPoints + 4; ++i) sheet.uKnots.push_back(static_cast<double>(i));
    sheet.vKnots = sheet.uKnots;
    for (std::size_t j = 0; j < kPoints; ++j) {
        for (std::size_t i = 0; i < kPoints; ++i) {
            sheet.points.emplace_back(10.0 * static_cast<double>(i) / (kPoints - 1), 0.0, 10.0 * static_cast<double>(j) / (kPoints - 1));
        }
    }
    return sheet;
}

// Moves the sheet's points to where they are at `seconds`.
void wave(tessera::Nurbs& sheet, double seconds) {
    for (glm::dvec3& point : sheet.points) point.y = 0.6 * std::sin(0.9 * point.x + 4.0 * seconds) * std::cos(0.7 * point.z - seconds);
}

tessera::Scene sceneOf(const tessera::Nurbs& sheet) {
    tessera::Scene scene;
    scene.name = "sheet";
    scene.meshes.push_back(tessera::nurbsMesh(sheet));
    tessera::Object object;
    object.name = "sheet";
    object.mesh = scene.meshes.front().name;
    scene.objects.push_back(object);
    return scene;
}

void printFrame(int frame, const tessera::MeshSizes& sizes, const tessera::MeshStatistics& times, bool usedAgain) {
    std::cout << "frame " << frame << ": " << sizes.vertices << " vertices, " << sizes.triangles << " triangles, place " << times.placeMs
              << " ms, factors " << times.factorsMs << " ms, offsets " << times.offsetsMs << " ms, vertices " << times.vertexMs
              << " ms, indices " << times.indexMs << " ms, in all " << times.tessellateMs << " ms, buffers "
              << (usedAgain ? "used again" : "new") << "\n";
}

void animate(int frames) {
    tessera::Nurbs sheet = flatSheet();
    wave(sheet, 0.0);
    tessera::Tessellator tessellator;
    tessellator.setScene(sceneOf(sheet));
    std::cout << "on " << tessellator.device().name << "\n";

    tessera::TessellateOptions options;
    options.tolerance = 0.001;
    tessera::DeviceMesh mesh;
    for (int frame = 0; frame < frames; ++frame) {
        if (frame > 0) {
            wave(sheet, frame * kFrameSeconds);
            tessellator.replacePoints(0, tessera::nurbsMesh(sheet).points);
        }
        // Sizes are known before anything is allocated; tessellate() does not measure again.
        const tessera::MeshSizes sizes = tessellator.measure(options);
        const tessera::DeviceMesh next = tessellator.tessellate(options);
        printFrame(frame, sizes, tessellator.statistics(), next.vertices == mesh.vertices && next.indices == mesh.indices);
        mesh = next;
    }
}

int framesOf(int argc, char** argv) {
    if (argc < 2) return 10;
    const std::string_view text = argv[1];
    int frames = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), frames);
    if (argc > 2 || result.ec != std::errc() || result.ptr != text.data() + text.size() || frames < 1) {
        throw tessera::Error("usage: animate_surface [FRAMES]");
    }
    return frames;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        animate(framesOf(argc, argv));
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "animate_surface: " << error.what() << "\n";
        return 1;
    }
}
