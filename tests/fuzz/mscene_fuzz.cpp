// libFuzzer on the .mscene reader: any bytes give a scene or a one-line Error. What gives a scene must survive being
// written and read again. Half of the mutations are made on the unpacked message, where pointers and lengths are.
#include "formats/mscene.h"
#include "tessera/error.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maximum);

namespace {

constexpr std::size_t kWord = 8;
constexpr std::size_t kLargestMessage = 1U << 16U;

// Undoes Cap'n Proto's packing as far as the bytes go.
std::vector<std::uint8_t> unpack(std::span<const std::uint8_t> packed) {
    std::vector<std::uint8_t> words;
    std::size_t at = 0;
    while (at < packed.size() && words.size() < kLargestMessage) {
        const unsigned tag = packed[at++];
        for (unsigned bit = 0; bit < kWord; ++bit) {
            const bool present = ((tag >> bit) & 1U) != 0 && at < packed.size();
            words.push_back(present ? packed[at++] : std::uint8_t{0});
        }
        if ((tag != 0 && tag != 0xFF) || at >= packed.size()) continue;
        const std::size_t run = packed[at++] * kWord;
        if (tag == 0) {
            words.insert(words.end(), run, 0);
        } else {
            const std::span<const std::uint8_t> literal = packed.subspan(at, std::min(run, packed.size() - at));
            words.insert(words.end(), literal.begin(), literal.end());
            words.resize((words.size() + kWord - 1) / kWord * kWord);
            at += literal.size();
        }
    }
    return words;
}

// Packs whole words, without runs.
std::vector<std::uint8_t> pack(std::span<const std::uint8_t> words) {
    std::vector<std::uint8_t> packed;
    for (std::size_t at = 0; at + kWord <= words.size(); at += kWord) {
        const std::size_t tagAt = packed.size();
        packed.push_back(0);
        for (unsigned bit = 0; bit < kWord; ++bit) {
            if (words[at + bit] == 0) continue;
            packed[tagAt] = static_cast<std::uint8_t>(packed[tagAt] | (1U << bit));
            packed.push_back(words[at + bit]);
        }
        if (packed[tagAt] == 0 || packed[tagAt] == 0xFF) packed.push_back(0);
    }
    return packed;
}

void require(bool condition) {
    if (!condition) std::abort();
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maximum, unsigned seed) {
    if (seed % 2 == 0) return LLVMFuzzerMutate(data, size, maximum);
    std::vector<std::uint8_t> words = unpack({data, size});
    const std::size_t used = words.size();
    words.resize(used + 16 * kWord);
    words.resize(LLVMFuzzerMutate(words.data(), used, words.size()));
    const std::vector<std::uint8_t> packed = pack(words);
    if (packed.empty() || packed.size() > maximum) return LLVMFuzzerMutate(data, size, maximum);
    std::memcpy(data, packed.data(), packed.size());
    return packed.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span<const std::uint8_t> bytes(data, size);
    std::vector<std::string> warnings;
    try {
        const tessera::Scene scene = tessera::parseMscene(std::as_bytes(bytes), "fuzz", &warnings);
        const tessera::Scene again = tessera::parseMscene(tessera::serializeMscene(scene), "again");
        require(again.placedPatchCount() == scene.placedPatchCount() && again.cameras.size() == scene.cameras.size());
        static_cast<void>(tessera::worldBounds(scene));
        static_cast<void>(tessera::framingCamera(scene, 45.0F));
    } catch (const tessera::Error& error) {
        require(std::string_view(error.what()).find('\n') == std::string_view::npos);
        require(std::string_view(error.what()).starts_with("fuzz: "));
    }
    for (const std::string& warning : warnings) require(warning.find('\n') == std::string::npos);
    return 0;
}
