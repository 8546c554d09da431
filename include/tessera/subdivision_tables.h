// Catmull-Clark surfaces evaluated as table times control points: the fast path for animated cages (Bolz, Schroeder: "Evaluation of
// Subdivision Surfaces on Programmable Graphics Hardware", 2003; "Rapid Evaluation of Catmull-Clark Subdivision Surfaces", 2002).
// Part of tessera::subdivision.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "tessera/mesh_sink.h"
#include "tessera/scene.h"
#include "tessera/tessellator.h"

namespace tessera {

// In which order a vertex's products are summed up.
enum class TableOrder {
    global,     // by the control points' numbers, with coefficients that are the same on both sides of every edge: neighbours' vertices on
                // it have the same bits
    unordered,  // as the table holds them: neighbours may differ in the last bits
};

struct TableOptions {
    // Just one of level, tolerance and pixelError is given.
    int level = -1;         // every quadrilateral of a cage gets 2^level squared cells, after a step of Catmull-Clark where there are other
                            // faces; 0 to 8. Beyond 5, or where a tolerance asks for it, all of the cage takes more such steps, and
                            // MeshVertex::patch counts the finer quadrilaterals
    double tolerance = 0;   // world units, above 0: each face takes the lowest level up to 8 whose cells lie so near the limit surface
    double pixelError = 0;  // as TessellateOptions::pixelError, with `camera`, `width` and `height`
    std::optional<Camera> camera;
    int width = 1280;
    int height = 720;
    TableOrder order = TableOrder::global;
    bool positionsOnly = false;     // vertices are three floats, not MeshVertex; tables of tangents are not read
    std::uint64_t memoryBytes = 0;  // as TessellateOptions::memoryBytes

    void validate() const;  // throws Error naming the option and its range
};

// What tables there are; bytes are those on the device.
struct TableSizes {
    std::size_t faces = 0;           // quadrilaterals that have a table, after the coarse steps
    std::size_t configurations = 0;  // distinct neighbourhoods, each with one table
    std::size_t edgeClasses = 0;     // of edges that are the same but for symmetry
    std::size_t vertexClasses = 0;
    int coarseSteps = 0;             // of Catmull-Clark, before the tables: 1 where the cage has faces of other than four corners
    std::uint64_t tableBytes = 0;    // coefficients
    std::uint64_t indexBytes = 0;    // which control points a face has, in which order
    std::uint64_t stencilBytes = 0;  // of the coarse steps
    std::uint64_t pointBytes = 0;    // control points: what a frame uploads
    double buildMs = 0;              // host time
};

struct TableStatistics {
    std::string device;
    TableSizes tables;
    MeshSizes sizes;
    double uploadMs = 0;  // control points, the last time
    double coarseMs = 0;  // coarse steps
    double levelsMs = 0;  // choosing levels, and offsets
    double vertexMs = 0;
    double indexMs = 0;
    double tessellateMs = 0;          // wall clock
    std::uint64_t uploadedBytes = 0;  // to the device since the mesh before: control points alone, in an animation
    std::uint64_t deviceBytesBudget = 0;
    std::uint64_t deviceBytesPeak = 0;
};

// Not for use by several threads at once.
class TableTessellator {
public:
    explicit TableTessellator(const RendererSettings& settings = {});
    ~TableTessellator();
    TableTessellator(TableTessellator&&) noexcept;
    TableTessellator& operator=(TableTessellator&&) noexcept;
    TableTessellator(const TableTessellator&) = delete;
    TableTessellator& operator=(const TableTessellator&) = delete;

    [[nodiscard]] const DeviceInfo& device() const;

    // Validates the scene, takes its Catmull-Clark cages and builds their tables; tables are kept over scenes while they are small beside
    // the budget. Objects that share a cage share its topology, tables and control points. `creaseAngle` as in SubdivisionOptions. Throws
    // Error: a scene with meshes or cages of other schemes, naming the first, and on tables that do not fit `memoryBytes` (0: as in
    // TableOptions), with the bytes they take.
    void setScene(const Scene& scene, double creaseAngle = 180.0, std::uint64_t memoryBytes = 0);

    // The next frame of an animation: as many points as the cage has, in the order of Cage::points. Nothing else is uploaded.
    void replacePoints(std::size_t cage, std::span<const glm::vec3> points);

    [[nodiscard]] TableSizes tables() const;
    [[nodiscard]] MeshSizes measure(const TableOptions& options);
    // As Tessellator::tessellate(): buffers stay the tessellator's. MeshVertex::patch counts the cage's quadrilaterals.
    [[nodiscard]] DeviceMesh tessellate(const TableOptions& options);
    void stream(const TableOptions& options, MeshSink& sink, const Progress& progress = {});
    [[nodiscard]] const TableStatistics& statistics() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace tessera
