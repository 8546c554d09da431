// Writes the seeds of the .mscene fuzzer into a folder: what the writer makes of some small scenes.
#include "../mscene_samples.h"
#include "formats/mscene.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <string>

int main(int count, char** arguments) {
    if (count != 2) {
        std::fputs("usage: mscene_seeds FOLDER\n", stderr);
        return 2;
    }
    try {
        const std::filesystem::path folder = arguments[1];
        std::filesystem::create_directories(folder);
        tessera::Scene broken = tessera::richScene();
        broken.objects[0].mesh = "nowhere";
        // Small ones, so that mutations meet the weights and the normals often.
        tessera::Scene rational;
        rational.meshes.push_back(tessera::rationalMesh("r", 1));
        tessera::Scene weightless = rational;
        weightless.meshes[0].weights[0] = 0.0F;
        tessera::Scene triangle;
        triangle.meshes.push_back(tessera::pnTriangle("t"));
        const std::map<std::string, tessera::Scene> seeds{{"empty", {}},
                                                          {"plain", tessera::plainScene()},
                                                          {"rich", tessera::richScene()},
                                                          {"broken", broken},
                                                          {"rational", rational},
                                                          {"weightless", weightless},
                                                          {"triangle", triangle},
                                                          {"teapot", tessera::builtinScene("teapot")}};
        for (const auto& [name, scene] : seeds) tessera::writeMscene(scene, folder / (name + ".mscene"));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "mscene_seeds: %s\n", error.what());
        return 1;
    }
    return 0;
}
