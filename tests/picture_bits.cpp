// Renders small pictures and prints a hash of each plane, a line a plane: run under several work-group methods, whose lines must agree.
#include "frames.h"
#include "picture_scenes.h"

#include "tessera/error.h"

#include <bit>
#include <cstdint>
#include <exception>
#include <iostream>
#include <string>
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

void print(Renderer& renderer, const Scene& scene, const Camera& camera) {
    renderer.setScene(scene);
    for (const int samples : {1, 3, 4}) {
        for (const bool emulated : {false, true}) {
            RenderOptions options = pictureOptions(160, 90, samples);
            options.mode = DiceMode::classical;
            options.emulateAtomics = emulated;
            options.batch = emulated ? 500 : 40000;
            options.diceRate = samples == 3 ? 5 : 8;
            options.maxDepth = samples == 3 ? 2 : 23;
            const Kept picture = draw(renderer, camera, options);
            for (const auto& [name, plane] : picture.planes()) {
                std::cout << scene.name << ' ' << samples << (emulated ? " emulated " : " ") << name << ' ' << hash(plane.values) << '\n';
            }
            std::cout << scene.name << ' ' << samples << " covered " << picture.coveredPixels() << '\n';
        }
    }
}

void printAll() {
    Renderer renderer(testSettings());
    const Scene teapot = builtinScene("teapot");
    print(renderer, teapot, teapot.cameras.front());
    Scene mixed = mixedScene();
    mixed.name = "mixed";
    print(renderer, mixed, mixed.cameras.front());
    mixed.name = "within";
    Camera within = reference::cameraAt({0.3, 0.3, 1.2}, {0, 0, -0.2}, 70);
    within.near = 0.3F;
    print(renderer, mixed, within);
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
