// tessera_table_bench: a cage of 10,000 faces by tables and by OpenSubdiv's evaluators at the same points, in turn in one process: medians.
// --list names what there is; --filter TEXT takes what has TEXT in its name; --runs N; --json FILE.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "table_bench.h"
#include "tessera/error.h"
#include "tessera/subdivision_tables.h"

using namespace tessera;
using bench::Contender;

namespace {

constexpr std::size_t cageFaces = 10'000;
constexpr std::uint64_t budget = std::uint64_t{4} << 30;

struct Arguments {
    bool list = false;
    std::string filter;
    int runs = 9;
    std::string json;
};

Arguments parse(int argc, char** argv) {
    Arguments out;
    for (int k = 1; k < argc; ++k) {
        const std::string name = argv[k];
        const auto value = [&] {
            if (k + 1 >= argc) throw Error(name + " needs a value");
            return std::string(argv[++k]);
        };
        if (name == "--list")
            out.list = true;
        else if (name == "--filter")
            out.filter = value();
        else if (name == "--runs")
            out.runs = std::max(1, std::atoi(value().c_str()));
        else if (name == "--json")
            out.json = value();
        else
            throw Error("there is no option " + name + "; there are --list, --filter, --runs and --json");
    }
    return out;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// A frame each: new control points, and all vertices of them. Tables of other levels are not counted: each scene is set for one alone.
Contender tables(TableTessellator& tessellator, const Cage& cage, int level, bool normals, TableOrder order) {
    TableOptions options;
    options.level = level;
    options.positionsOnly = !normals;
    options.order = order;
    options.memoryBytes = budget;
    Contender c;
    c.name = order == TableOrder::global ? "tables, ordered" : "tables, unordered";
    c.run = [&tessellator, &cage, options] {
        const auto began = std::chrono::steady_clock::now();
        tessellator.replacePoints(0, cage.points);
        (void)tessellator.tessellate(options);
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
    };
    c.run();
    c.run();
    c.vertices = tessellator.statistics().sizes.vertices;
    const TableSizes sizes = tessellator.tables();
    c.memoryBytes = sizes.tableBytes + sizes.indexBytes;
    c.frameBytes = tessellator.statistics().uploadedBytes;
    return c;
}

Scene sceneOf(const Cage& cage) {
    Scene scene;
    scene.name = "bench";
    scene.cages.push_back(cage);
    Object object;
    object.name = "boxes";
    object.mesh = cage.name;
    scene.objects.push_back(object);
    return scene;
}

struct Result {
    int level = 0;
    bool normals = false;
    Contender contender;
    double ms = 0;
    double vertexMs = 0;
};

void measure(const Arguments& arguments, const Cage& cage, int level, bool normals, std::vector<Result>& results) {
    // Devices of their own: each keeps the tables and lists that it needs, and nothing else.
    TableTessellator ordered, unordered;
    std::vector<Contender> contenders;
    const std::string suffix = " level " + std::to_string(level) + (normals ? " normals" : " positions");
    const auto wanted = [&](const std::string& name) { return (name + suffix).find(arguments.filter) != std::string::npos; };
    for (TableTessellator* tessellator : {&ordered, &unordered}) {
        const TableOrder order = tessellator == &ordered ? TableOrder::global : TableOrder::unordered;
        if (!wanted(order == TableOrder::global ? "tables, ordered" : "tables, unordered")) continue;
        tessellator->setScene(sceneOf(cage), 180.0, budget);
        contenders.push_back(tables(*tessellator, cage, level, normals, order));
    }
    if (wanted("limit stencils"))
        for (Contender& c : bench::limitStencils(cage, level, normals)) contenders.push_back(std::move(c));
    if (wanted("patches"))
        for (Contender& c : bench::patchEvaluation(cage, level, normals)) contenders.push_back(std::move(c));
    std::vector<std::vector<double>> times(contenders.size()), vertexTimes(contenders.size());
    for (int run = 0; run < arguments.runs; ++run) {
        for (std::size_t k = 0; k < contenders.size(); ++k) {
            times[k].push_back(contenders[k].run());
            const bool first = contenders[k].name == "tables, ordered", second = contenders[k].name == "tables, unordered";
            vertexTimes[k].push_back(first ? ordered.statistics().vertexMs : second ? unordered.statistics().vertexMs : 0);
        }
    }
    for (std::size_t k = 0; k < contenders.size(); ++k) {
        Result result{level, normals, std::move(contenders[k]), median(times[k]), median(vertexTimes[k])};
        std::printf("%5d %-9s %-30s %10llu %9.2f %9.2f %9.1f %9.2f %10.0f\n", level, normals ? "normals" : "positions",
                    result.contender.name.c_str(), static_cast<unsigned long long>(result.contender.vertices), result.ms, result.vertexMs,
                    static_cast<double>(result.contender.vertices) / result.ms / 1e3,
                    static_cast<double>(result.contender.memoryBytes) / 1e6, static_cast<double>(result.contender.frameBytes));
        std::fflush(stdout);
        result.contender.run = nullptr;
        results.push_back(std::move(result));
    }
}

void writeJson(const std::string& path, const std::vector<Result>& results) {
    std::ofstream file(path);
    file << "{\"faces\": " << cageFaces << ", \"results\": [";
    const char* before = "\n";
    for (const Result& r : results) {
        file << before << R"(  {"name": ")" << r.contender.name << R"(", "level": )" << r.level
             << ", \"normals\": " << (r.normals ? "true" : "false") << ", \"vertices\": " << r.contender.vertices
             << ", \"share\": " << r.contender.share << ", \"ms\": " << r.ms << ", \"vertexMs\": " << r.vertexMs
             << ", \"memoryBytes\": " << r.contender.memoryBytes << ", \"frameBytes\": " << r.contender.frameBytes << "}";
        before = ",\n";
    }
    file << "\n]}\n";
    if (!file.flush()) throw Error(path + " can't be written");
}

int run(int argc, char** argv) {
    const Arguments arguments = parse(argc, argv);
    if (arguments.list) {
        for (const char* name : {"tables, ordered", "tables, unordered", "limit stencils", "patches"})
            for (int level = 1; level <= 5; ++level)
                for (const char* what : {"positions", "normals"}) std::printf("%s level %d %s\n", name, level, what);
        return 0;
    }
    const Cage cage = bench::extrudedBoxes(cageFaces);
    std::printf("%5s %-9s %-30s %10s %9s %9s %9s %9s %10s\n", "level", "", "", "vertices", "ms", "kernel ms", "Mvert/s", "MB", "frame B");
    std::vector<Result> results;
    for (int level = 1; level <= 5; ++level)
        for (const bool normals : {false, true}) measure(arguments, cage, level, normals, results);
    if (!arguments.json.empty()) writeJson(arguments.json, results);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "tessera_table_bench: %s\n", error.what());
        return 1;
    }
}
