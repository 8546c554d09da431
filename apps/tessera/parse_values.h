// Values of the command line that are more than a single number or name. All throw Error, without the option's name.
#pragma once

#include "tessera/cage.h"
#include "tessera/options.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::program {

struct Size {
    int width = 0;  // pixels
    int height = 0;
};

constexpr int kLargestSide = 65536;  // pixels, as RenderOptions allows

constexpr int kSmallestBucketSide = 8;

// "1280x720": two whole numbers from `least` to kLargestSide and nothing else.
[[nodiscard]] Size parseSize(std::string_view text, int least = 1);

// A finite number and nothing else: "-1.5", "1e3".
[[nodiscard]] float parseNumber(std::string_view text);

// A finite number from 0 to `most` and nothing else: "1e-5".
[[nodiscard]] double parseFraction(std::string_view text, double most);

// A finite number above 0 and nothing else: "0.25".
[[nodiscard]] double parsePositive(std::string_view text);

// A whole number from `least` to `most` and nothing else: "40000".
[[nodiscard]] long long parseWhole(std::string_view text, long long least, long long most);

// "1,0.5,-2": what parseNumbers() reads.
[[nodiscard]] std::string listText(std::span<const float> values);

// `least` to `most` numbers with commas between: "1,0.5,-2".
[[nodiscard]] std::vector<float> parseNumbers(std::string_view text, std::size_t least, std::size_t most);

// "cpu", "breadth", "bounded" or "local".
[[nodiscard]] SplitMethod parseMethod(std::string_view text);

// "watertight" or "classical".
[[nodiscard]] DiceMode parseMode(std::string_view text);

// "catmull-clark", "loop", "bilinear" or "none".
[[nodiscard]] SubdivisionScheme parseScheme(std::string_view text);

// Names with commas between: "Z,N", "all". Errors list the names that are known.
[[nodiscard]] Aov parseAovs(std::string_view text);

// The names that parseAovs() knows: "Z, N, object.id, ...".
[[nodiscard]] std::string aovNames();

// The ending of a file's name in small letters: ".exr" of "a/B.EXR"; empty where there is none.
[[nodiscard]] std::string lowerEnding(const std::string& path);

// Whether both name one file, by whatever path. Empty names do not.
[[nodiscard]] bool sameFile(const std::string& first, const std::string& second);

}  // namespace tessera::program
