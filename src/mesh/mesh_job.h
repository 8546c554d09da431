// What a Tessellator does: a scene's patches through the four stages.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "device/session.h"
#include "mesh/mesh_plan.h"
#include "mesh/mesh_tables.h"
#include "mesh/mesh_view.h"
#include "surface/patch_stream.h"
#include "tessera/mesh_sink.h"
#include "tessera/tessellator.h"

namespace tessera {

// Functions are Tessellator's of the same name; a scene is set before any other. After an exception forget() must be called.
class MeshJob {
public:
    explicit MeshJob(const RendererSettings& settings);

    [[nodiscard]] const DeviceInfo& device() const { return session_.device.info; }
    [[nodiscard]] const MeshStatistics& statistics() const { return statistics_; }

    void setScene(const Scene& scene, Orientation orientation);
    void replacePoints(std::size_t mesh, std::span<const glm::vec3> points);
    MeshSizes measure(const TessellateOptions& options, const Progress& progress);
    DeviceMesh tessellate(const TessellateOptions& options);
    void stream(const TessellateOptions& options, MeshSink& sink, const Progress& progress);
    // Nothing that was measured holds any more.
    void forget();

private:
    // What was measured, and for what.
    struct Measured {
        bool valid = false;
        bool used = false;  // by a mesh that was made
        mesh_view view{};
        std::uint64_t memoryBytes = 0;
        bool positionsOnly = false;
        MeshPlan plan;
        MeshSizes sizes;
        std::vector<mesh_totals> chunks;
    };
    using Clock = std::chrono::steady_clock;

    // Whether what was measured is for these options; if not, makes room to measure for them.
    bool prepare(const TessellateOptions& options);
    void start();
    void finish(Clock::time_point began);
    // The chunk's patches placed, and both tables made unless they are there.
    const PatchSet& useChunk(std::uint32_t chunk);
    // Measures all chunks, telling of each when its tables are there.
    void measureChunks(const std::function<void(std::uint32_t, const PatchSet&)>& each);
    void addTotals(const PatchSet& patches, const mesh_totals& totals);
    void makeOnDevice();
    void enqueuePiece(const PatchSet& patches, const mesh_piece& piece);
    void allocateMesh(std::uint64_t vertices, std::uint64_t triangles);
    // What tessellate() needs for a mesh of so many bytes, more than there is room for.
    [[nodiscard]] std::uint64_t budgetFor(std::uint64_t meshBytes) const;
    // The chunk's pieces, one after the other; done(triangles) after each.
    void streamChunk(std::uint32_t chunk, std::span<const mesh_pattern> patterns, MeshSink& sink,
                     const std::function<void(std::uint64_t)>& done);
    void handPiece(std::span<const MeshUnit> units, std::uint64_t vertices, std::uint64_t triangles, MeshSink& sink);

    DeviceSession session_;
    PatchStream stream_;
    MeshTables tables_;
    Scene scene_;
    SceneReach reach_;
    std::vector<placed_object> objects_;
    frame_params frame_{};
    Measured measured_;
    std::uint32_t tabled_ = 0;               // 1 + the chunk whose tables are on the device; 0: none
    std::vector<std::uint32_t> turnedBits_;  // orientation.h
    DeviceBuffer turned_;
    DeviceBuffer vertices_;
    DeviceBuffer indices_;
    MeshStatistics statistics_;
};

}  // namespace tessera
