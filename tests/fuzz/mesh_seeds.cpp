// Writes the seeds of the mesh fuzzer into a folder: a small file of each format.
#include "../mesh_file_samples.h"
#include "mesh_formats.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

int main(int count, char** arguments) {
    if (count != 2) {
        std::fputs("usage: mesh_seeds FOLDER\n", stderr);
        return 2;
    }
    try {
        const std::filesystem::path folder = arguments[1];
        std::filesystem::create_directories(folder);
        for (const auto& [name, text] : tessera::meshFileSamples()) {
            const std::string format = std::filesystem::path(name).extension().string().substr(1);
            const auto* const found = std::find(tessera::kFuzzedFormats.begin(), tessera::kFuzzedFormats.end(), format);
            if (found == tessera::kFuzzedFormats.end()) continue;
            std::ofstream(folder / name, std::ios::binary) << static_cast<char>(found - tessera::kFuzzedFormats.begin()) << text;
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "mesh_seeds: %s\n", error.what());
        return 1;
    }
    return 0;
}
