// Renders small pictures and prints a hash of each plane, a line a plane: run under several work-group methods, whose lines must agree.
#include "closed_models.h"
#include "frames.h"
#include "picture_scenes.h"

#include "tessera/weld.h"

#include <array>
#include <bit>
#include <cstdint>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::test {
namespace {

// FNV-1a (Fowler, Noll and Vo, 1991), 64 bits.
std::uint64_t hash(const std::vector<float>& values) {
    std::uint64_t result = 0xcbf29ce484222325U;
    for (const float value : values) {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        for (unsigned shift = 0; shift < 32; shift += 8) result = (result ^ ((bits >> shift) & 0xffU)) * 0x100000001b3U;
    }
    return result;
}

// Few samples with many at once, small batches, few levels and odd rates: `variant` is 0 to 2.
RenderOptions optionsOf(DiceMode mode, int variant, bool emulated) {
    constexpr std::array samples{1, 3, 4};
    RenderOptions options = pictureOptions(160, 90, samples[static_cast<std::size_t>(variant)]);
    options.mode = mode;
    options.emulateAtomics = emulated;
    options.batch = emulated ? 500 : 40000;
    options.diceRate = variant == 1 ? 5 : 8;
    options.maxDepth = variant == 1 ? 2 : 23;
    options.gridSize = variant == 1 ? 4 : 16;
    options.shadingRate = variant == 2 ? 4.0F : 1.0F;
    return options;
}

void print(Renderer& renderer, const Scene& scene, const Camera& camera, DiceMode mode) {
    renderer.setScene(scene);
    for (const int variant : {0, 1, 2}) {
        for (const bool emulated : {false, true}) {
            const Kept picture = draw(renderer, camera, optionsOf(mode, variant, emulated));
            const std::string title =
                scene.name + ' ' + std::string(name(mode)) + ' ' + std::to_string(variant) + (emulated ? " emulated " : " ");
            for (const auto& [plane, content] : picture.planes()) std::cout << title << plane << ' ' << hash(content.values) << '\n';
            std::cout << title << "covered " << picture.coveredPixels() << '\n';
        }
    }
}

void printAll() {
    Renderer renderer(testSettings());
    Scene mixed = mixedScene();
    mixed.name = "mixed";
    Camera within = reference::cameraAt({0.3, 0.3, 1.2}, {0, 0, -0.2}, 70);
    within.near = 0.3F;
    for (const DiceMode mode : {DiceMode::classical, DiceMode::watertight}) {
        const Scene teapot = builtinScene("teapot");
        print(renderer, teapot, teapot.cameras.front(), mode);
        print(renderer, mixed, mixed.cameras.front(), mode);
        Scene inside = mixed;
        inside.name = "within";
        print(renderer, inside, within, mode);
    }
    // What watertight mode alone draws: rational patches, triangles, and edges by record.
    for (const std::string_view builtin : {"quadrics", "nurbs", "pn"}) {
        const Scene scene = builtinScene(builtin);
        print(renderer, scene, scene.cameras.front(), DiceMode::watertight);
    }
    Scene records = placedAnyhow(mixedSolid(10, 2, {PatchKind::bezier, PatchKind::gregory, PatchKind::rational, PatchKind::pn}), 11);
    records.name = "records";
    weld(records);
    print(renderer, records, framingCamera(records, 40.0F), DiceMode::watertight);
}

}  // namespace
}  // namespace tessera::test

int main() {
    try {
        tessera::test::printAll();
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
    return 0;
}
