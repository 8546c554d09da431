// What both methods of `tessera tessellate` do alike.
#include "tessellate_report.h"

#include "console.h"

namespace tessera::program {

double usualTolerance(const Scene& scene) {
    const Bounds bounds = worldBounds(scene);
    const double size = bounds.empty() ? 0.0 : glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
    // Of what has no size any will do.
    return size > 0.0 ? size / 1000.0 : 1.0;
}

std::string toleranceNote(double tolerance) {
    return "the tolerance is " + about(tolerance) + ", a thousandth of the scene's size; choose one by --tolerance";
}

std::string meshSummary(const std::string& counted, const MeshSizes& sizes, const StreamedMesh& mesh, const std::string& device,
                        const TessellateArguments& arguments) {
    const WrittenMesh& written = mesh.written;
    const bool welded = arguments.file.weld && written.vertices < sizes.distinctVertices;
    std::string text = counted + ", " + program::counted(written.vertices, "vertex", "vertices") + (welded ? " (welded)" : "");
    if (written.quads > 0) text += ", " + program::counted(written.quads, "quad", "quads");
    text += ", " + program::counted(written.triangles, "triangle", "triangles");
    text += ", " + fixed(mesh.totalMs - written.writeMs, 1) + " ms on " + device;
    return text + ", " + byteText(written.bytes) + " in " + fixed(written.writeMs, 1) + " ms, wrote " + arguments.output;
}

}  // namespace tessera::program
