// The file of a mesh that is made piece by piece, for minutes maybe: complete in the end, or not there.
#pragma once

#include "formats/mesh_writer.h"
#include "interrupt.h"
#include "tessera/mesh_sink.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

namespace tessera::program {

// What was written.
struct WrittenMesh {
    std::uint64_t vertices = 0;  // in the file
    std::uint64_t triangles = 0;
    std::uint64_t quads = 0;  // triangles are not counted among them
    std::uint64_t bytes = 0;
    double writeMs = 0;  // wall clock, of all that the writer did from begin() on
};

// Hands on to a writer of files. An interrupt waits for a piece to be written, never for the device, and leaves nothing of the file.
class MeshOutput : public MeshSink {
public:
    // Throws Error on what makeMeshWriter() refuses. `interrupt` has to outlive it.
    MeshOutput(Interrupt& interrupt, const std::filesystem::path& path, const MeshFileOptions& options);
    ~MeshOutput() override;
    MeshOutput(const MeshOutput&) = delete;
    MeshOutput& operator=(const MeshOutput&) = delete;

    void begin(const MeshOutline& outline) override;
    void take(const MeshPiece& piece) override;

    // Gives the file its name, once all pieces are there. Throws Error.
    [[nodiscard]] WrittenMesh finish();

private:
    void timed(const std::function<void()>& call);

    Interrupt& interrupt_;
    std::unique_ptr<MeshWriter> writer_;  // used with interrupt_.files() locked
    Interrupt::AtEnd removal_;
    double writeMs_ = 0;
};

}  // namespace tessera::program
