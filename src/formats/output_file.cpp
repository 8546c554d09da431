// Writing through a temporary name. POSIX calls rather than streams: every step's error is known and can be told.
#include "formats/output_file.h"

#include "tessera/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <system_error>

namespace tessera {
namespace {

namespace fs = std::filesystem;

std::string advice(int error) {
    switch (error) {
        case ENOSPC:
        case EDQUOT:
            return "free some space or choose another folder";
        case EFBIG:
            return "write a smaller file or raise the limit on file sizes";
        case ENAMETOOLONG:
            return "choose a shorter name";
        default:
            return "choose another folder";
    }
}

[[noreturn]] void fail(const fs::path& path, int error) {
    throw Error("cannot write '" + path.string() + "': " + std::generic_category().message(error) + "; " + advice(error));
}

fs::path folderOf(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// A new file in a folder, removed again unless it was given its name.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& target) : target_(target), temporary_(folderOf(target) / randomName()) {
        // Not mkstemp: the file keeps its permissions when it is renamed, and these are the umask's business.
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0) fail(target_, errno);
    }
    ~TemporaryFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!named_) ::unlink(temporary_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    TemporaryFile(TemporaryFile&&) = delete;
    TemporaryFile& operator=(TemporaryFile&&) = delete;

    void write(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno != EINTR) fail(target_, errno);
            if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
        }
    }

    void giveName() {
        // Errors of delayed writes show here, and a crash after the rename leaves no empty file.
        if (::fsync(descriptor_) != 0 && errno != EINVAL) fail(target_, errno);
        const int descriptor = descriptor_;
        descriptor_ = -1;
        if (::close(descriptor) != 0) fail(target_, errno);
        if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(target_, errno);
        named_ = true;
    }

private:
    static std::string randomName() {
        std::random_device source;
        std::array<char, 48> text{};
        std::snprintf(text.data(), text.size(), ".tessera-%08x%08x.tmp", source(), source());
        return text.data();
    }

    fs::path target_;
    fs::path temporary_;
    int descriptor_ = -1;
    bool named_ = false;
};

}  // namespace

void checkOutputFile(const fs::path& path) {
    const fs::path folder = folderOf(path);
    std::error_code error;
    if (!path.has_filename() || fs::is_directory(path, error)) {
        throw Error("cannot write '" + path.string() + "': it is a folder; name a file");
    }
    const fs::file_status folderStatus = fs::status(folder, error);
    if (!fs::exists(folderStatus)) throw Error("cannot write '" + path.string() + "': no such folder; make it first");
    if (!fs::is_directory(folderStatus)) {
        throw Error("cannot write '" + path.string() + "': '" + folder.string() + "' is not a folder; choose another one");
    }
    const fs::file_status status = fs::status(path, error);
    if (!fs::status_known(status)) fail(path, error.value());
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        throw Error("cannot write '" + path.string() + "': it exists and is no ordinary file; choose another name");
    }
    const TemporaryFile probe(path);
}

void writeOutputFile(const fs::path& path, std::span<const std::byte> bytes) {
    checkOutputFile(path);
    TemporaryFile file(path);
    file.write(bytes);
    file.giveName();
}

}  // namespace tessera
