// Tables and JSON of measured tessellations.
#include "mesh/mesh_report.h"

#include "tessera/error.h"
#include "tessera/options.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <utility>

namespace tessera::bench {

namespace {

std::string quoted(const std::string& text) {
    std::string made = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') made += '\\';
        made += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return made + "\"";
}

void writeSizes(std::ostream& out, const MeshSizes& sizes) {
    const std::array<std::pair<const char*, std::uint64_t>, 7> counts{{{"patches", sizes.patches},
                                                                       {"patches_culled", sizes.patchesCulled},
                                                                       {"units", sizes.units},
                                                                       {"vertices", sizes.vertices},
                                                                       {"triangles", sizes.triangles},
                                                                       {"vertex_bytes", sizes.vertexBytes},
                                                                       {"index_bytes", sizes.indexBytes}}};
    for (const auto& [name, count] : counts) out << ", \"" << name << "\": " << count;
}

void writeMeasured(std::ostream& out, const MeshMeasured& measured) {
    out << "  {\"name\": " << quoted(measured.name);
    if (!measured.error.empty()) {
        out << ", \"error\": " << quoted(measured.error) << "}";
        return;
    }
    writeSizes(out, measured.sizes);
    out << ", \"tolerance\": " << measured.tolerance << ", \"distance\": " << measured.distance << ", \"along\": " << measured.along
        << ", \"ms\": {";
    const char* between = "";
    for (const auto& [stage, values] : measured.ms) {
        out << std::exchange(between, ", ") << quoted(stage) << ": [";
        for (std::size_t i = 0; i < values.size(); ++i) out << (i == 0 ? "" : ", ") << values[i];
        out << "]";
    }
    out << "}}";
}

}  // namespace

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

void printHeading(std::ostream& out) {
    out << std::left << std::setw(28) << "" << std::right << std::setw(10) << "triangles" << std::setw(10) << "vertices" << std::setw(10)
        << "factors" << std::setw(10) << "offsets" << std::setw(10) << "vertex" << std::setw(10) << "index" << std::setw(10) << "all ms"
        << std::setw(10) << "frames/s"
        << "\n";
}

void printRow(std::ostream& out, const MeshMeasured& measured) {
    out << std::left << std::setw(28) << measured.name << std::right;
    if (!measured.error.empty()) {
        out << " failed: " << measured.error << "\n";
        return;
    }
    out << std::setw(10) << measured.sizes.triangles << std::setw(10) << measured.sizes.vertices << std::fixed << std::setprecision(3);
    for (const char* const stage : {"factors", "offsets", "vertex", "index", "all"}) out << std::setw(10) << median(measured.ms.at(stage));
    out << std::setprecision(1) << std::setw(10) << 1000.0 / median(measured.ms.at("all")) << std::defaultfloat << "\n";
}

void writeJson(const std::string& path, const std::string& device, int runs, const std::vector<MeshMeasured>& all) {
    std::ofstream out(path);
    out << std::setprecision(9) << "{\"device\": " << quoted(device) << ", \"version\": " << quoted(std::string(versionString()))
        << ", \"runs\": " << runs << ", \"measurements\": [\n";
    for (std::size_t i = 0; i < all.size(); ++i) {
        writeMeasured(out, all[i]);
        out << (i + 1 < all.size() ? ",\n" : "\n");
    }
    out << "]}\n";
    out.close();
    if (!out) throw Error("cannot write '" + path + "'");
}

}  // namespace tessera::bench
