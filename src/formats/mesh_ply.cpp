// What a PLY file announces, checked before Assimp makes room for it.
#include "formats/mesh_ply.h"

#include "scene/text.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>
#include <vector>

namespace tessera {

namespace {

constexpr std::string_view kBlanks = " \t\r";

std::vector<std::string_view> wordsOf(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
        line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
        if (line.empty()) return words;
        words.push_back(line.substr(0, line.find_first_of(kBlanks)));
        line.remove_prefix(words.back().size());
    }
}

// Whether such a line may follow in a header after `element`s have begun or before.
bool isHeaderLine(const std::vector<std::string_view>& words, bool inElement) {
    if (words.empty()) return false;
    const std::string_view keyword = words.front();
    if (keyword == "comment" || keyword == "obj_info") return true;
    if (keyword == "format") return words.size() == 3 && !inElement;
    if (keyword == "element") return words.size() == 3;
    if (keyword != "property" || !inElement || words.size() < 3) return false;
    return words.size() == (words[1] == "list" ? 5U : 3U);
}

void checkCount(std::string_view element, std::string_view count, std::uintmax_t fileBytes, const MeshNotes& notes) {
    std::uintmax_t number = 0;
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), number);
    if (error == std::errc{} && end == count.data() + count.size() && number <= fileBytes) return;
    notes.fail("announces " + quotedName(count) + " of element " + quotedName(element) + ", which its " + std::to_string(fileBytes) +
               " bytes cannot hold; the file is damaged");
}

}  // namespace

void checkPlyHeader(std::string_view head, std::uintmax_t fileBytes, const MeshNotes& notes) {
    bool inElement = false;
    for (std::size_t number = 1; !head.empty(); ++number) {
        const std::size_t length = head.find('\n');
        const std::string_view line = head.substr(0, length);
        const std::vector<std::string_view> words = wordsOf(line);
        head.remove_prefix(std::min(line.size() + 1, head.size()));
        const bool first = number == 1 && line.starts_with("ply") && words.size() == 1 && words[0] == "ply";
        if (length != std::string_view::npos && words.size() == 1 && words[0] == "end_header") return;
        if (!first && !isHeaderLine(words, inElement)) {
            notes.fail("line " + std::to_string(number) + ", " + quotedName(line) + ", is none of a PLY header; the file is damaged");
        }
        if (first || words[0] != "element") continue;
        inElement = true;
        checkCount(words[1], words[2], fileBytes, notes);
    }
    notes.fail("its header has no end; the file is cut off, or no PLY");
}

}  // namespace tessera
