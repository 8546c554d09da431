// The file of a mesh that is made piece by piece: every call of the writer with the lock that an interrupt waits for.
#include "mesh_output.h"

#include <chrono>

namespace tessera::program {

// An unfinished writer removes what it wrote.
MeshOutput::MeshOutput(Interrupt& interrupt, const std::filesystem::path& path, const MeshFileOptions& options)
    : interrupt_(interrupt), removal_(interrupt, [this] { writer_.reset(); }) {
    const auto whole = interrupt_.files();
    writer_ = makeMeshWriter(path, options);
}

// Here and not later, when an interrupt would no longer remove it.
MeshOutput::~MeshOutput() {
    const auto whole = interrupt_.files();
    writer_.reset();
}

void MeshOutput::begin(const MeshOutline& outline) {
    timed([&] { writer_->begin(outline); });
}

void MeshOutput::take(const MeshPiece& piece) {
    timed([&] { writer_->take(piece); });
}

WrittenMesh MeshOutput::finish() {
    timed([&] { writer_->finish(); });
    return {writer_->vertices(), writer_->triangles(), writer_->quads(), writer_->bytes(), writeMs_};
}

void MeshOutput::timed(const std::function<void()>& call) {
    const auto whole = interrupt_.files();
    const auto start = std::chrono::steady_clock::now();
    call();
    writeMs_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace tessera::program
