// Scenes and views for tests of frames under budgets, in buckets and with culling, and what their pictures must have in common.
#pragma once

#include "closed_models.h"
#include "frames.h"

#include "tessera/options.h"
#include "tessera/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tessera::test {

inline constexpr std::array everyMethod{SplitMethod::bounded, SplitMethod::cpu, SplitMethod::breadth, SplitMethod::local};
inline constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;

// Open and closed, curved and thin, one patch and hundreds, of every kind of patches.
[[nodiscard]] std::vector<ClosedModel> boundedScenes();

// Copies of a scene, each a share smaller than the one before, all around the middle of its box: one in another.
[[nodiscard]] Scene nested(const Scene& scene, int copies);

// From outside of the scene's box towards its middle, or from within the box any way. Requires a scene with points.
[[nodiscard]] Camera viewFrom(const Scene& scene, bool inside, std::uint64_t seed);

// Classical mode knows Bezier and Gregory patches alone.
[[nodiscard]] bool canDraw(DiceMode mode, const Scene& scene);

// Expects the same bits but for at most `ties` pixels, at which only surfaces at the same depth may have changed places.
void expectSameButTies(const Kept& whole, const Kept& part, std::size_t ties);

// The MiB that an error says would do; none where it names none.
[[nodiscard]] std::optional<std::uint64_t> memoryNamed(const std::string& error);

// For SCOPED_TRACE.
[[nodiscard]] std::string textOf(const RenderOptions& options);

}  // namespace tessera::test
