// What a TableTessellator does: cages' points to vertices, by tables.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/mesh_pieces.h"
#include "subdivision/table_buffers.h"
#include "tessera/subdivision_tables.h"

namespace tessera::subdivision {

// Functions are TableTessellator's of the same name; a scene is set before any other. After an exception forget() must be called.
class TableJob {
public:
    explicit TableJob(const RendererSettings& settings);

    [[nodiscard]] const DeviceInfo& device() const { return session_.device.info; }
    [[nodiscard]] const TableStatistics& statistics() const { return statistics_; }

    void setScene(const Scene& scene, double creaseAngle, std::uint64_t memoryBytes);
    void replacePoints(std::size_t cage, std::span<const glm::vec3> points);
    [[nodiscard]] TableSizes tables() const;
    MeshSizes measure(const TableOptions& options);
    DeviceMesh tessellate(const TableOptions& options);
    void stream(const TableOptions& options, MeshSink& sink, const Progress& progress);
    // Nothing that was measured holds any more.
    void forget();

private:
    using Clock = std::chrono::steady_clock;

    void setBudget(const TableOptions& options);
    // Stage, tables and points as the level, or most faces, want them.
    void useStage(int more);
    void usePoints();
    void useLevels(std::uint32_t least, std::uint32_t most, const TableOptions& options);
    void reservePatches();
    // Levels of all faces; the greatest, which may be beyond the tables'.
    std::uint32_t chooseLevels(const TableOptions& options);
    [[nodiscard]] double greatestCoordinate() const;
    void makePatterns();
    [[nodiscard]] table_run runOf(const TableOptions& options) const;
    void enqueueVertices(table_run run, std::uint64_t firstVertex, const TableOptions& options);
    void enqueueIndices(const mesh_piece& piece);
    void makeMesh(std::uint64_t vertices, std::uint64_t triangles, const TableOptions& options);
    void finish(Clock::time_point began);

    DeviceSession session_;
    Uploads uploads_;
    TableStore store_;
    Scene scene_;
    std::vector<TableCage> cages_;
    std::vector<glm::vec3> points_;                    // of all cages, as they are now
    std::vector<std::size_t> pointCounts_;             // of the scene's own cages
    std::array<std::optional<TableStage>, 4> stages_;  // by steps beyond the cages' own
    int more_ = 0;
    bool staged_ = false;  // whether stageBuffers_ are of stages_[more_]
    bool placed_ = false;  // whether points on the device are placed for this stage
    TableBuffers tableBuffers_;
    StageBuffers stageBuffers_;
    DeviceBuffer cagePoints_, levels_, graded_, patterns_, sums_, offsets_, totals_, vertices_, indices_;

    bool measured_ = false;
    bool indexed_ = false;  // whether the indices on the device are those of what was measured
    TableOptions measuredOptions_;
    MeshSizes sizes_;
    double buildMs_ = 0;
    TableStatistics statistics_;
};

}  // namespace tessera::subdivision
