// What readers of an .mscene file's parts share.
#include "formats/mscene_reading.h"

#include "scene/text.h"
#include "tessera/error.h"

#include <algorithm>

namespace tessera {

namespace {

constexpr std::size_t kMostWarnings = 50;

}  // namespace

MsceneReading::MsceneReading(std::string file, std::size_t fileBytes, std::vector<std::string>* warnings)
    : file_(std::move(file)), fileBytes_(fileBytes), warnings_(warnings), warned_(warnings == nullptr ? 0 : warnings->size()) {}

void MsceneReading::fail(const std::string& what) const { throw Error(file_ + ": " + what); }

void MsceneReading::warn(const std::string& what) const {
    if (warnings_ == nullptr || warnings_->size() > warned_ + kMostWarnings) return;
    const bool last = warnings_->size() == warned_ + kMostWarnings;
    warnings_->push_back(file_ + ": " + (last ? std::string("further oddities are not listed") : what));
}

void MsceneReading::checkItems(std::string_view kind, std::size_t count, std::size_t leastBytes) const {
    if (count <= fileBytes_ / leastBytes) return;
    fail(std::to_string(count) + " items in the list of kind " + std::string(kind) + " are more than the file can hold" +
         std::string(kDamaged));
}

std::string describe(const kj::Exception& exception) {
    const kj::StringPtr description = exception.getDescription();
    std::string text(description.begin(), description.size());
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
    if (const std::size_t condition = text.rfind("; "); condition != std::string::npos) text.erase(0, condition + 2);
    return text.substr(0, text.find(". "));
}

std::string itemText(std::string_view kind, std::size_t index) { return std::string(kind) + " number " + std::to_string(index); }

std::string readName(const MsceneReading& reading, capnp::Text::Reader text, const std::string& item) {
    std::string result(text.begin(), text.size());
    if (!isUtf8(result) || result.find('\0') != std::string::npos) {
        reading.fail(item + ": name " + quotedName(result) + " is no UTF-8 text; rename it");
    }
    return result;
}

}  // namespace tessera
