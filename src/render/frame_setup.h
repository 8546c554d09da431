// Turns camera, options and scene into what the kernels take.
#pragma once

#include <cstdint>
#include <vector>

#include "core/frame_shared.h"
#include "film/film_layout.h"
#include "shade/light_shared.h"
#include "surface/patch_shared.h"
#include "tessera/options.h"
#include "tessera/scene.h"

namespace tessera {

// All but the patches (PatchStream::use) and the lights' number. `boxes`: whether patches are fed by their boxes
// (split/feed.cl).
[[nodiscard]] frame_params setUpFrame(const Camera& camera, const RenderOptions& options, const FilmLayout& film, bool boxes);

// Bits that number a range's rows or columns of micropolygons: the least b with 2^b >= diceRate.
[[nodiscard]] std::uint32_t rateBits(int diceRate);
// Ranges at once whose micropolygons 32 bits can number (film/batch.clh).
[[nodiscard]] constexpr std::uint64_t mostNumbered(std::uint32_t bits) { return (std::uint64_t{1} << (32 - 2 * bits)) - 2; }

// World to eye space (x right, y up, z the depth); its third row is the camera's -z axis.
[[nodiscard]] glm::dmat4 eyeFromWorld(const Camera& camera);

[[nodiscard]] std::vector<placed_object> placeObjects(const Scene& scene, const glm::dmat4& eyeFromWorld);

// The scene's lights in eye space; a head-light of radiance 1 instead where it has none or one is asked for.
[[nodiscard]] std::vector<eye_light> placeLights(const Scene& scene, const glm::dmat4& eyeFromWorld, bool headlight);

}  // namespace tessera
