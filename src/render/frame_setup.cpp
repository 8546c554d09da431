#include "render/frame_setup.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "split/quad_shared.h"

namespace tessera {
namespace {

// The original's constants: ranges wholly beyond this depth, or this far outside the picture, are culled (DESIGN.md).
constexpr float farCull = 1000.0F;
constexpr float ribbonPixels = 32.0F;

// Of the full picture, whatever the bucket: nine points do not bound a range, so against a smaller window other ranges would be
// culled, and its pixels would not be the full picture's.
void setBounds(frame_params& frame, const RenderOptions& options) {
    frame.cull_left = -ribbonPixels;
    frame.cull_right = static_cast<float>(options.width - 1) + ribbonPixels;
    frame.cull_bottom = -ribbonPixels;
    frame.cull_top = static_cast<float>(options.height - 1) + ribbonPixels;
}

// The bucket itself, for hulls cull nothing that could be seen; a pixel more for what rounding may have moved.
constexpr int hullMargin = 1;

void setHullBounds(frame_params& frame, const RenderOptions& options, const FilmLayout& film) {
    frame.cull_left = static_cast<float>(film.x0 - hullMargin);
    frame.cull_right = static_cast<float>(film.x0 + film.width + hullMargin);
    frame.cull_bottom = static_cast<float>(options.height - film.y0 - film.height - hullMargin);
    frame.cull_top = static_cast<float>(options.height - film.y0 + hullMargin);
}

double focalLength(const Camera& camera, const RenderOptions& options) {
    const double halfAngle = static_cast<double>(camera.fovy) * std::numbers::pi / 360.0;
    return options.height / 2.0 / std::tan(halfAngle);
}

void setWatertight(frame_params& frame, const Camera& camera, const RenderOptions& options, const FilmLayout& film) {
    const Camera& dicing = options.dicingCamera ? *options.dicingCamera : camera;
    frame.watertight = 1;
    frame.dicing_focal = static_cast<float>(focalLength(dicing, options));
    frame.dicing_near = dicing.near;
    frame.dicing_across = frame.dicing_focal / static_cast<float>(options.width);
    frame.dicing_up = frame.dicing_focal / static_cast<float>(options.height);
    frame.dicing_length = std::sqrt(options.shadingRate);
    frame.grid_bits = rateBits(options.gridSize);
    frame.level_most = QUAD_LEVEL_MOST;
    frame.dicing_apart = options.dicingCamera ? 1 : 0;
    frame.rate_bits = frame.grid_bits;
    // breadth and cpu draw in the order in which they split, so that nothing is known when most is bounded.
    const bool ahead = options.method == SplitMethod::bounded || options.method == SplitMethod::local;
    frame.occlusion = options.occlusion && ahead ? 1 : 0;
    setHullBounds(frame, options, film);
}

void setFilm(frame_params& frame, const FilmLayout& film) {
    frame.pixel_samples = film.pixelSamples;
    frame.cells_x = film.width * film.pixelSamples;
    frame.cells_y = film.height * film.pixelSamples;
    frame.cell_x0 = film.x0 * film.pixelSamples;
    frame.cell_y0 = film.y0 * film.pixelSamples;
    frame.tile_cells = film.tileCells;
    frame.tile_inverse = 1.0F / static_cast<float>(film.tileCells);
    frame.tiles_x = film.tilesX;
    frame.tiles = film.tiles;
    frame.width = film.width;
    frame.height = film.height;
    const int unit = film.pixelSamples * 256;
    frame.raster_scale = frame.focal * static_cast<float>(unit);
    frame.raster_x = frame.centre_x * static_cast<float>(unit);
    frame.raster_y = frame.centre_y * static_cast<float>(unit);
    frame.raster_x0 = film.x0 * unit;
    frame.raster_y0 = film.y0 * unit;
    constexpr int boxTile = 8;  // pixels along a side of patch_box's tiles
    frame.box_x0 = film.x0 / boxTile;
    frame.box_x1 = (film.x0 + film.width - 1) / boxTile;
    frame.box_y0 = film.y0 / boxTile;
    frame.box_y1 = (film.y0 + film.height - 1) / boxTile;
}

float shininess(const Material& material) {
    // The usual match of Blinn-Phong's exponent to a microfacet roughness.
    const float r = std::max(material.roughness, 0.01F);
    return std::clamp(2.0F / (r * r) - 2.0F, 1.0F, 10000.0F);
}

void setVector(float* to, const glm::dvec3& from) {
    for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(from[k]);
}

}  // namespace

std::uint32_t rateBits(int diceRate) { return static_cast<std::uint32_t>(std::bit_width(static_cast<unsigned>(diceRate - 1))); }

glm::dmat4 eyeFromWorld(const Camera& camera) {
    glm::dmat4 view = glm::inverse(matrix(camera.transform));
    for (int column = 0; column < 4; ++column) view[column][2] = -view[column][2];
    return view;
}

frame_params setUpFrame(const Camera& camera, const RenderOptions& options, const FilmLayout& film, bool boxes) {
    frame_params frame{};
    frame.focal = static_cast<float>(focalLength(camera, options));
    frame.centre_x = static_cast<float>(options.width) * 0.5F;
    frame.centre_y = static_cast<float>(options.height) * 0.5F;
    frame.near_plane = camera.near;
    frame.far_cull = farCull;
    setBounds(frame, options);
    frame.split_bound = options.splitBound;
    frame.max_depth = static_cast<std::uint32_t>(options.maxDepth);
    frame.dice_rate = static_cast<std::uint32_t>(options.diceRate);
    frame.rate_bits = rateBits(options.diceRate);
    if (options.mode == DiceMode::watertight) setWatertight(frame, camera, options, film);
    setFilm(frame, film);
    // The cpu method, the reference, looks at all.
    frame.feed_boxes = options.method != SplitMethod::cpu && boxes ? 1 : 0;
    frame.cull_backfaces = options.cullBackfaces ? 1 : 0;
    const std::array<float, 4>& background = options.background;
    frame.background_r = background[0] * background[3];
    frame.background_g = background[1] * background[3];
    frame.background_b = background[2] * background[3];
    frame.background_a = background[3];
    const glm::dmat3 rotation = rotationMatrix(camera.transform);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            frame.world_from_eye[3 * row + column] = static_cast<float>(rotation[column][row] * (column == 2 ? -1.0 : 1.0));
        }
    }
    return frame;
}

std::vector<placed_object> placeObjects(const Scene& scene, const glm::dmat4& eyeFromWorld) {
    std::vector<placed_object> placed;
    for (const Object& object : scene.objects) {
        const glm::dmat4 eyeFromObject = eyeFromWorld * matrix(object.transform);
        placed_object& out = placed.emplace_back();
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column)
                out.eye_from_object[4 * row + column] = static_cast<float>(eyeFromObject[column][row]);
        setVector(out.color, object.color);
        out.specular = object.material.kind == MaterialKind::plastic ? object.material.specular : 0.0F;
        out.shininess = shininess(object.material);
        out.id = static_cast<uint>(placed.size() - 1);
    }
    return placed;
}

std::vector<eye_light> placeLights(const Scene& scene, const glm::dmat4& eyeFromWorld, bool headlight) {
    const eye_light atCamera{{0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F}, LIGHT_HEAD};
    if (headlight || scene.lights.empty()) return {atCamera};
    std::vector<eye_light> placed;
    for (const Light& light : scene.lights) {
        eye_light& out = placed.emplace_back();
        // Directional light shines along -z, so it comes from +z; the sky of a hemi light lies around +z.
        const glm::dvec3 axis = glm::dmat3(eyeFromWorld) * rotationMatrix(light.transform)[2];
        const glm::dvec3 position = glm::dvec3(eyeFromWorld * glm::dvec4(glm::dvec3(light.transform.translation), 1.0));
        setVector(out.place, light.kind == LightKind::point ? position : axis);
        setVector(out.radiance, glm::dvec3(light.color) * static_cast<double>(light.intensity));
        out.kind = static_cast<std::uint32_t>(light.kind);
    }
    return placed;
}

}  // namespace tessera
