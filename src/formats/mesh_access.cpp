// What Assimp may open while it reads a mesh file.
#include "formats/mesh_access.h"

#include <assimp/MemoryIOWrapper.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

namespace tessera {

namespace {

constexpr std::size_t kMostRefused = 8;

// Whether `file` is in `folder` or below it; both without links and dots.
bool isBelow(const std::filesystem::path& file, const std::filesystem::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// A stream that ends those who do not see its end: some of Assimp's readers ask for more forever where a file is cut off.
class WatchedStream : public Assimp::IOStream {
public:
    explicit WatchedStream(std::unique_ptr<Assimp::IOStream> stream) : stream_(std::move(stream)) {}

    std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
        const std::size_t read = size == 0 || count == 0 ? 0 : stream_->Read(buffer, size, count);
        emptyReads_ = read == 0 ? emptyReads_ + 1 : 0;
        if (emptyReads_ > kMostEmptyReads) throw std::runtime_error("it ends before what it announces is there");
        return read;
    }
    std::size_t Write(const void* /*buffer*/, std::size_t /*size*/, std::size_t /*count*/) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override { return stream_->Seek(offset, origin); }
    [[nodiscard]] std::size_t Tell() const override { return stream_->Tell(); }
    [[nodiscard]] std::size_t FileSize() const override { return stream_->FileSize(); }
    void Flush() override {}

private:
    static constexpr std::size_t kMostEmptyReads = 10000;
    std::unique_ptr<Assimp::IOStream> stream_;
    std::size_t emptyReads_ = 0;  // one after the other
};

// Assimp's view of a MeshFolder: reads only.
class MeshAccess : public Assimp::IOSystem {
public:
    explicit MeshAccess(MeshFolder& folder) : folder_(folder) {}

    bool Exists(const char* file) const override { return folder_.mayOpen(file); }
    [[nodiscard]] char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* file, const char* mode) override {
        const bool reads = std::string_view(mode).find_first_of("wa+") == std::string_view::npos;
        return reads ? folder_.open(file).release() : nullptr;
    }
    void Close(Assimp::IOStream* stream) override { const std::unique_ptr<Assimp::IOStream> closed(stream); }

private:
    MeshFolder& folder_;
};

}  // namespace

MeshFolder::MeshFolder(const std::filesystem::path& path) : fileName_(path.string()) {
    std::error_code ignored;  // what does not resolve is refused when it is asked for
    file_ = std::filesystem::weakly_canonical(path, ignored);
    folders_ = {std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored).parent_path(), ignored), file_.parent_path()};
    std::erase_if(folders_, [](const std::filesystem::path& folder) { return folder.empty(); });
}

MeshFolder::MeshFolder(std::string fileName, std::span<const std::byte> bytes)
    : fileName_(std::move(fileName)), inMemory_(true), replaced_(true), bytes_(bytes) {}

void MeshFolder::replaceFile(std::span<const std::byte> bytes) {
    bytes_ = bytes;
    replaced_ = true;
}

std::unique_ptr<Assimp::IOSystem> MeshFolder::makeAccess() { return std::make_unique<MeshAccess>(*this); }

bool MeshFolder::mayOpen(const char* file) const {
    if (file == fileName_) return true;
    if (inMemory_) return false;
    std::error_code error;
    const std::filesystem::path real = std::filesystem::weakly_canonical(file, error);
    if (error || !std::filesystem::is_regular_file(real, error)) return false;
    const bool inside =
        real == file_ || std::any_of(folders_.begin(), folders_.end(), [&](const auto& folder) { return isBelow(real, folder); });
    return inside && std::filesystem::file_size(real, error) <= kLargestMeshFile && !error;
}

std::unique_ptr<Assimp::IOStream> MeshFolder::open(const char* file) {
    if (!mayOpen(file)) {
        std::error_code ignored;
        const bool there = !inMemory_ && std::filesystem::exists(file, ignored);
        const bool told = std::find(refused_.begin(), refused_.end(), file) != refused_.end();
        if (there && !told && refused_.size() < kMostRefused) refused_.emplace_back(file);
        return nullptr;
    }
    std::unique_ptr<Assimp::IOStream> stream;
    if (replaced_ && file == fileName_) {
        stream = std::make_unique<Assimp::MemoryIOStream>(reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size());
    } else {
        stream.reset(disk_.Open(file, "rb"));
    }
    if (stream == nullptr) return nullptr;
    return std::make_unique<WatchedStream>(std::move(stream));
}

}  // namespace tessera
