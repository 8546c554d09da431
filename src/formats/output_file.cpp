// Writing through a temporary name. POSIX calls rather than streams: every step's error is known and can be told.
#include "formats/output_file.h"

#include "tessera/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <system_error>
#include <utility>

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

std::string randomName() {
    std::random_device source;
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), ".tessera-%08x%08x.tmp", source(), source());
    return text.data();
}

}  // namespace

OutputFile::OutputFile(fs::path path) : target_(std::move(path)), temporary_(folderOf(target_) / randomName()) {
    // Not mkstemp: the file keeps its permissions when it is renamed, and these are the umask's business.
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(target_, errno);
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!named_) ::unlink(temporary_.c_str());
}

void OutputFile::reserve(std::uint64_t bytes) {
    if (bytes == 0) return;
    if (bytes > static_cast<std::uint64_t>(std::numeric_limits<off_t>::max())) fail(target_, EFBIG);
    int error = EINTR;
    while (error == EINTR) error = ::posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
    if (error != 0 && error != EOPNOTSUPP && error != EINVAL) fail(target_, error);
}

void OutputFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0 && errno != EINTR) fail(target_, errno);
        if (written <= 0) continue;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        offset += static_cast<std::uint64_t>(written);
    }
}

void OutputFile::giveName() {
    // Errors of delayed writes show here, and a crash after the rename leaves no empty file.
    if (::fsync(descriptor_) != 0 && errno != EINVAL) fail(target_, errno);
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0) fail(target_, errno);
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(target_, errno);
    named_ = true;
}

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
    const OutputFile probe(path);
}

void writeOutputFile(const fs::path& path, std::span<const std::byte> bytes) {
    checkOutputFile(path);
    OutputFile file(path);
    file.write(0, bytes);
    file.giveName();
}

}  // namespace tessera
