// The tessellator: calls the stages in order, for all patches or chunk by chunk and piece by piece.
#include "tessera/tessellator.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

#include "device/session.h"
#include "mesh/mesh_job.h"
#include "scene/validate.h"
#include "tessera/error.h"
#include "tessera/mesh_sink.h"

namespace tessera {

static_assert(sizeof(MeshVertex) == sizeof(mesh_vertex));

struct Tessellator::Impl {
    explicit Impl(const RendererSettings& settings) : job(settings) {}

    // Runs `work`, turning what OpenCL throws into an Error.
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

    MeshJob job;
    bool hasScene = false;
};

Tessellator::Tessellator(const RendererSettings& settings) : impl_(std::make_unique<Impl>(settings)) {}
Tessellator::~Tessellator() = default;
Tessellator::Tessellator(Tessellator&&) noexcept = default;
Tessellator& Tessellator::operator=(Tessellator&&) noexcept = default;

const DeviceInfo& Tessellator::device() const { return impl_->job.device(); }

void Tessellator::setScene(const Scene& scene, Orientation orientation) {
    impl_->hasScene = false;
    scene.validate();
    requireMeshes(scene);
    impl_->job.setScene(scene, orientation);
    impl_->hasScene = true;
}

void Tessellator::replacePoints(std::size_t mesh, std::span<const glm::vec3> points) {
    impl_->guarded([&] { impl_->job.replacePoints(mesh, points); });
}

MeshSizes Tessellator::measure(const TessellateOptions& options) {
    return impl_->guarded([&] { return impl_->job.measure(options, {}); });
}

DeviceMesh Tessellator::tessellate(const TessellateOptions& options) {
    return impl_->guarded([&] { return impl_->job.tessellate(options); });
}

void Tessellator::stream(const TessellateOptions& options, MeshSink& sink, const Progress& progress) {
    impl_->guarded([&] { impl_->job.stream(options, sink, progress); });
}

const MeshStatistics& Tessellator::statistics() const { return impl_->job.statistics(); }

}  // namespace tessera
