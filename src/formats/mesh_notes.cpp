// What is told of a mesh file that is being read.
#include "formats/mesh_notes.h"

#include "scene/text.h"
#include "tessera/error.h"

#include <utility>

namespace tessera {

namespace {

constexpr std::size_t kMostWarnings = 50;
constexpr std::size_t kLongestMessage = 300;

}  // namespace

MeshNotes::MeshNotes(std::string file, std::vector<std::string>* warnings)
    : file_(std::move(file)), warnings_(warnings), warned_(warnings == nullptr ? 0 : warnings->size()) {}

void MeshNotes::fail(const std::string& what) const { throw Error(file_ + ": " + what); }

void MeshNotes::warn(const std::string& what) const {
    if (warnings_ == nullptr || warnings_->size() > warned_ + kMostWarnings) return;
    const bool last = warnings_->size() == warned_ + kMostWarnings;
    warnings_->push_back(file_ + ": " + (last ? std::string("further oddities are not listed") : what));
}

std::string oneLine(std::string_view text) {
    std::string line;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool space = byte <= 0x20 || byte == 0x7F;
        if (!space) line += c;
        if (space && !line.empty() && line.back() != ' ') line += ' ';
        if (line.size() >= kLongestMessage) return line + "...";
    }
    if (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
}

std::string UniqueNames::make(std::string_view wanted) {
    const bool usable = !wanted.empty() && isUtf8(wanted) && wanted.find('\0') == std::string_view::npos;
    const std::string base = usable ? std::string(wanted) : fallback_;
    std::string name = base;
    for (std::size_t& number = next_[base]; !taken_.insert(name).second;) name = base + "." + std::to_string(++number + 1);
    return name;
}

}  // namespace tessera
