// The table tessellator: checks what it is given, and turns what OpenCL throws into Errors.
#include "tessera/subdivision_tables.h"

#include <cmath>
#include <utility>

#include "scene/text.h"
#include "subdivision/table_job.h"
#include "tessera/error.h"

namespace tessera {

void TableOptions::validate() const {
    const int given = (level != -1 ? 1 : 0) + (tolerance != 0 ? 1 : 0) + (pixelError != 0 ? 1 : 0);
    if (given != 1) throw Error("just one of level, tolerance and pixelError must be given, but " + std::to_string(given) + " are");
    if (level != -1 && (level < 0 || level > 8)) throw Error("level is " + std::to_string(level) + ", but must be 0 to 8");
    if (level != -1) return;
    TessellateOptions same;
    same.tolerance = tolerance;
    same.pixelError = pixelError;
    same.camera = camera;
    same.width = width;
    same.height = height;
    same.validate();
}

struct TableTessellator::Impl {
    explicit Impl(const RendererSettings& settings) : job(settings) {}

    template <typename Work>
    auto guarded(const Work& work) {
        if (!hasScene) throw Error("no scene is set; call setScene() first");
        try {
            return work();
        } catch (const cl::Error& error) {
            job.forget();
            throw Error("the tessellation failed on " + job.device().name + ": " + error.what() + " gave " + clErrorName(error.err()));
        } catch (...) {
            job.forget();
            throw;
        }
    }

    subdivision::TableJob job;
    bool hasScene = false;
};

TableTessellator::TableTessellator(const RendererSettings& settings) : impl_(std::make_unique<Impl>(settings)) {}
TableTessellator::~TableTessellator() = default;
TableTessellator::TableTessellator(TableTessellator&&) noexcept = default;
TableTessellator& TableTessellator::operator=(TableTessellator&&) noexcept = default;

const DeviceInfo& TableTessellator::device() const { return impl_->job.device(); }

void TableTessellator::setScene(const Scene& scene, double creaseAngle, std::uint64_t memoryBytes) {
    impl_->hasScene = false;
    scene.validate();
    if (!scene.meshes.empty())
        throw Error(scene.name + ": mesh " + quotedName(scene.meshes.front().name) + " is no cage; tables are of cages alone");
    for (const Cage& cage : scene.cages) {
        if (cage.scheme == SubdivisionScheme::catmullClark) continue;
        throw Error(scene.name + ": cage " + quotedName(cage.name) + " is of scheme " + std::string(name(cage.scheme)) +
                    "; tables are of catmull-clark alone");
    }
    impl_->job.setScene(scene, creaseAngle, memoryBytes);
    impl_->hasScene = true;
}

void TableTessellator::replacePoints(std::size_t cage, std::span<const glm::vec3> points) {
    impl_->guarded([&] { impl_->job.replacePoints(cage, points); });
}

TableSizes TableTessellator::tables() const { return impl_->hasScene ? impl_->job.tables() : TableSizes(); }

MeshSizes TableTessellator::measure(const TableOptions& options) {
    return impl_->guarded([&] { return impl_->job.measure(options); });
}

DeviceMesh TableTessellator::tessellate(const TableOptions& options) {
    return impl_->guarded([&] { return impl_->job.tessellate(options); });
}

void TableTessellator::stream(const TableOptions& options, MeshSink& sink, const Progress& progress) {
    impl_->guarded([&] { impl_->job.stream(options, sink, progress); });
}

const TableStatistics& TableTessellator::statistics() const { return impl_->job.statistics(); }

}  // namespace tessera
