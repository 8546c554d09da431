// A TableTessellator's buffers: what has been uploaded is kept while it is what is wanted.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "device/session.h"
#include "subdivision/table_build.h"
#include "subdivision/table_stage.h"

namespace tessera::subdivision {

// Uploads and their bytes.
class Uploads {
public:
    explicit Uploads(DeviceSession& session) : session_(session) {}
    // `buffer` holds these and nothing else then.
    template <typename T>
    void put(DeviceBuffer& buffer, Purpose purpose, const char* name, const std::vector<T>& values) {
        const std::size_t bytes = values.size() * sizeof(T);
        buffer = DeviceBuffer();
        buffer = session_.memory.allocate(purpose, name, bytes);
        if (bytes > 0) session_.timeline.write(buffer.cl(), values.data(), bytes);
        bytes_ += bytes;
    }
    void putAt(const DeviceBuffer& buffer, std::uint64_t offset, const void* data, std::uint64_t bytes);
    // Since the last time.
    [[nodiscard]] std::uint64_t take();

private:
    DeviceSession& session_;
    std::uint64_t bytes_ = 0;
};

// Coefficients of the levels that have been used.
class TableBuffers {
public:
    // Levels [least, most] of all of the store's tables, and deviations, where they are not there.
    void useLevels(Uploads& uploads, const TableStore& store, std::uint32_t least, std::uint32_t most, bool tangents);
    void useDeviations(Uploads& uploads, const TableStore& store);
    [[nodiscard]] std::uint64_t bytes() const;

    [[nodiscard]] const cl::Buffer& positions(std::uint32_t level) const { return orEmpty(positions_[level]); }
    [[nodiscard]] const cl::Buffer& tangents(std::uint32_t level) const { return orEmpty(tangents_[level]); }
    [[nodiscard]] const cl::Buffer& deviations() const { return deviations_.cl(); }
    [[nodiscard]] const cl::Buffer& infos() const { return infos_.cl(); }
    [[nodiscard]] const cl::Buffer& places() const { return places_.cl(); }

private:
    // A kernel's argument must be a buffer, though levels that nothing has are never read.
    [[nodiscard]] const cl::Buffer& orEmpty(const DeviceBuffer& buffer) const { return buffer.bytes() > 0 ? buffer.cl() : infos_.cl(); }
    void begin(Uploads& uploads, const TableStore& store);

    std::size_t tables_ = 0;  // that the buffers are of
    std::array<DeviceBuffer, TABLE_LEVELS> positions_;
    std::array<DeviceBuffer, TABLE_LEVELS> tangents_;
    DeviceBuffer deviations_;
    DeviceBuffer infos_;
    DeviceBuffer places_;
};

// One stage's faces and points.
class StageBuffers {
public:
    // Of another stage, which replaces what was there.
    void set(Uploads& uploads, DeviceSession& session, const TableStage& stage);
    // Lists of control points in either order, where they are not there.
    void useRows(Uploads& uploads, const TableStage& stage);
    void useNumbers(Uploads& uploads, const TableStage& stage);
    // From the cages' points to placed ones.
    void enqueuePoints(DeviceSession& session, const TableStage& stage, const std::vector<TableCage>& cages,
                       const cl::Buffer& cagePoints) const;
    [[nodiscard]] std::uint64_t indexBytes() const;
    [[nodiscard]] std::uint64_t stencilBytes() const;

    [[nodiscard]] const cl::Buffer& objects() const { return objects_.cl(); }
    [[nodiscard]] const cl::Buffer& faces() const { return faces_.cl(); }
    [[nodiscard]] const cl::Buffer& byRow() const { return byRow_.cl(); }
    [[nodiscard]] const cl::Buffer& byNumber() const { return byNumber_.cl(); }
    [[nodiscard]] const cl::Buffer& rowOf() const { return rowOf_.cl(); }
    [[nodiscard]] const cl::Buffer& placed() const { return placed_.cl(); }

private:
    struct Stencils {
        DeviceBuffer starts, sources, weights;
    };
    DeviceBuffer objects_, faces_, byRow_, byNumber_, rowOf_;
    std::vector<Stencils> stencils_;  // of each cage
    DeviceBuffer stepped_;            // points after the steps
    DeviceBuffer placed_;
};

}  // namespace tessera::subdivision
