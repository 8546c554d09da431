// What readers of an .mscene file's parts share: messages that name file and item, names, lists.
#pragma once

#include <capnp/blob.h>
#include <capnp/common.h>
#include <kj/exception.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tessera {

// One file being read: what messages begin with, and where its oddities are told.
class MsceneReading {
public:
    MsceneReading(std::string file, std::size_t fileBytes, std::vector<std::string>* warnings);

    [[nodiscard]] const std::string& file() const { return file_; }
    [[nodiscard]] std::size_t fileBytes() const { return fileBytes_; }
    [[noreturn]] void fail(const std::string& what) const;  // throws Error
    void warn(const std::string& what) const;               // the first fifty

    // Fails where the file cannot hold a list of so many items of `leastBytes` each: those with pointers take some bytes for them. Without
    // this a list of empty items would cost many times the file.
    void checkItems(std::string_view kind, std::size_t count, std::size_t leastBytes) const;

private:
    std::string file_;
    std::size_t fileBytes_;
    std::vector<std::string>* warnings_;
    std::size_t warned_;  // lines that were there before
};

// Cap'n Proto's own words for what is wrong, as one line, without the condition of its code that failed before
// them and the advice to programmers behind.
[[nodiscard]] std::string describe(const kj::Exception& exception);

inline constexpr std::string_view kDamaged = "; the file is damaged, or no packed Cap'n Proto scene";

// "mesh number 3".
[[nodiscard]] std::string itemText(std::string_view kind, std::size_t index);

// Fails on what is no text.
[[nodiscard]] std::string readName(const MsceneReading& reading, capnp::Text::Reader text, const std::string& item);

// `items` through `readItem`, with the item's number in what Cap'n Proto has to say.
template <typename Item, typename List, typename ReadItem>
std::vector<Item> readList(const MsceneReading& reading, std::string_view kind, List items, ReadItem readItem) {
    reading.checkItems(kind, items.size(), 4);
    std::vector<Item> result;
    result.reserve(items.size());
    for (std::uint32_t i = 0; i < items.size(); ++i) {
        try {
            result.push_back(readItem(reading, items[i], i));
        } catch (const kj::Exception& exception) {
            reading.fail(itemText(kind, i) + ": " + describe(exception) + std::string(kDamaged));
        }
    }
    return result;
}

}  // namespace tessera
