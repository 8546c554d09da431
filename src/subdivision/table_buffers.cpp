// Uploads, each when it is first wanted.
#include "subdivision/table_buffers.h"

#include "subdivision/table_rows.h"

namespace tessera::subdivision {
namespace {

// The lists of all cages, one after the other.
template <typename T>
std::vector<T> joined(const TableStage& stage, const std::vector<T> TableFaces::*list) {
    std::vector<T> all;
    for (const TableFaces& cage : stage.cages) all.insert(all.end(), (cage.*list).begin(), (cage.*list).end());
    return all;
}

}  // namespace

void Uploads::putAt(const DeviceBuffer& buffer, std::uint64_t offset, const void* data, std::uint64_t bytes) {
    if (bytes > 0) session_.timeline.writeAt(buffer.cl(), offset, data, bytes);
    bytes_ += bytes;
}

std::uint64_t Uploads::take() {
    const std::uint64_t bytes = bytes_;
    bytes_ = 0;
    return bytes;
}

void TableBuffers::begin(Uploads& uploads, const TableStore& store) {
    if (tables_ == store.tables().size() && infos_.bytes() > 0) return;
    *this = TableBuffers();
    tables_ = store.tables().size();
    uploads.put(infos_, Purpose::scene, "the tables' sizes", tableInfos(store.tables()));
    uploads.put(places_, Purpose::scene, "the tables' parameters", placeRows());
}

void TableBuffers::useLevels(Uploads& uploads, const TableStore& store, std::uint32_t least, std::uint32_t most, bool tangents) {
    begin(uploads, store);
    for (std::uint32_t level = least; level <= most; ++level) {
        if (positions_[level].bytes() == 0)
            uploads.put(positions_[level], Purpose::scene, "tables of positions", positionRows(store.tables(), level));
        if (tangents && tangents_[level].bytes() == 0)
            uploads.put(tangents_[level], Purpose::scene, "tables of tangents", tangentRows(store.tables(), level));
    }
}

void TableBuffers::useDeviations(Uploads& uploads, const TableStore& store) {
    begin(uploads, store);
    if (deviations_.bytes() == 0) uploads.put(deviations_, Purpose::scene, "tables of deviations", deviationRows(store.tables()));
}

std::uint64_t TableBuffers::bytes() const {
    std::uint64_t sum = deviations_.bytes() + infos_.bytes() + places_.bytes();
    for (const DeviceBuffer& buffer : positions_) sum += buffer.bytes();
    for (const DeviceBuffer& buffer : tangents_) sum += buffer.bytes();
    return sum;
}

void StageBuffers::set(Uploads& uploads, DeviceSession& session, const TableStage& stage) {
    *this = StageBuffers();
    std::vector<table_face> faces;
    std::uint32_t entries = 0;
    for (const TableFaces& cage : stage.cages) {
        for (table_face face : cage.faces) {
            face.first_entry += entries;
            faces.push_back(face);
        }
        entries += static_cast<std::uint32_t>(cage.byRow.size());
        Stencils& stencils = stencils_.emplace_back();
        if (cage.starts.empty()) continue;
        uploads.put(stencils.starts, Purpose::scene, "coarse steps' stencils", cage.starts);
        uploads.put(stencils.sources, Purpose::scene, "coarse steps' stencils", cage.sources);
        uploads.put(stencils.weights, Purpose::scene, "coarse steps' stencils", cage.weights);
    }
    uploads.put(objects_, Purpose::scene, "the objects", stage.objects);
    uploads.put(faces_, Purpose::scene, "the faces", faces);
    constexpr std::uint64_t each = 3 * sizeof(float);
    stepped_ = session.memory.allocate(Purpose::scene, "control points after coarse steps", stage.points * each);
    placed_ = session.memory.allocate(Purpose::scene, "placed control points", stage.placedPoints * each);
}

void StageBuffers::useRows(Uploads& uploads, const TableStage& stage) {
    if (byRow_.bytes() == 0) uploads.put(byRow_, Purpose::scene, "the faces' control points", joined(stage, &TableFaces::byRow));
}

void StageBuffers::useNumbers(Uploads& uploads, const TableStage& stage) {
    if (byNumber_.bytes() > 0) return;
    uploads.put(byNumber_, Purpose::scene, "the faces' control points in order", joined(stage, &TableFaces::byNumber));
    uploads.put(rowOf_, Purpose::scene, "the control points' rows", joined(stage, &TableFaces::rowOf));
}

void StageBuffers::enqueuePoints(DeviceSession& session, const TableStage& stage, const std::vector<TableCage>& cages,
                                 const cl::Buffer& cagePoints) const {
    for (std::size_t c = 0; c < stage.cages.size(); ++c) {
        const Stencils& stencils = stencils_[c];
        if (stencils.starts.bytes() == 0) continue;
        const cl_uint count = stage.cages[c].points, source = cages[c].firstPoint, to = stage.firstPoint[c];
        session.launch(session.kernels.with("table_stencils", count, source, to, stencils.starts.cl(), stencils.sources.cl(),
                                            stencils.weights.cl(), cagePoints, stepped_.cl()),
                       "table_stencils");
    }
    for (std::size_t o = 0; o < stage.objects.size(); ++o) {
        table_object object = stage.objects[o];
        const std::size_t c = stage.cageOf[o];
        const bool stepped = stencils_[c].starts.bytes() > 0;
        if (!stepped) object.first_source = cages[c].firstPoint;
        session.launch(session.kernels.with("table_place", object, stepped ? stepped_.cl() : cagePoints, placed_.cl()), "table_place");
    }
}

std::uint64_t StageBuffers::indexBytes() const {
    std::uint64_t sum = faces_.bytes() + objects_.bytes();
    for (const DeviceBuffer* buffer : {&byRow_, &byNumber_, &rowOf_}) sum += buffer->bytes();
    return sum;
}

std::uint64_t StageBuffers::stencilBytes() const {
    std::uint64_t sum = 0;
    for (const Stencils& s : stencils_) sum += s.starts.bytes() + s.sources.bytes() + s.weights.bytes();
    return sum;
}

}  // namespace tessera::subdivision
