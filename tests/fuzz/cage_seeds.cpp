// Writes the seeds of the cage fuzzer into a folder: a file of each kind behind the byte that chooses it.
#include "../cage_file_samples.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

int main(int count, char** arguments) {
    if (count != 2) {
        std::fputs("usage: cage_seeds FOLDER\n", stderr);
        return 2;
    }
    try {
        const std::filesystem::path folder = arguments[1];
        std::filesystem::create_directories(folder);
        const std::string gltf = tessera::cageGltfText(tessera::cageExtension());
        const std::map<std::string, std::string> seeds{{"tagged", '\0' + tessera::cageObjText()},
                                                       {"plain", '\0' + tessera::objText()},
                                                       {"gltf", '\1' + gltf},
                                                       {"glb", '\1' + tessera::cageGlb(tessera::cageExtension())}};
        for (const auto& [name, text] : seeds) std::ofstream(folder / name, std::ios::binary) << text;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "cage_seeds: %s\n", error.what());
        return 1;
    }
    return 0;
}
