#include "device/kernel_sources.h"

#include <set>
#include <sstream>

#include "tessera/error.h"

namespace tessera {
namespace {

// The name in a line #include "name"; empty for other lines (system headers belong to the host's side).
std::string includedName(const std::string& line) {
    constexpr std::string_view directive = "#include \"";
    if (!line.starts_with(directive)) return {};
    return line.substr(directive.size(), line.rfind('"') - directive.size());
}

void append(const KernelSources& sources, const std::string& file, std::set<std::string>& seen, std::string& text) {
    if (!seen.insert(file).second) return;
    const auto found = sources.find(file);
    if (found == sources.end()) throw Error("kernel source '" + file + "' is not compiled into the library");
    std::istringstream lines(found->second);
    std::string line;
    std::size_t number = 0;
    text += "#line 1 \"" + file + "\"\n";
    while (std::getline(lines, line)) {
        ++number;
        const std::string name = includedName(line);
        if (name.empty()) {
            text += line + "\n";
        } else {
            append(sources, name, seen, text);
            text += "#line " + std::to_string(number + 1) + " \"" + file + "\"\n";
        }
    }
}

}  // namespace

std::string assembleKernels(const KernelSources& sources, const std::vector<std::string>& files) {
    std::string text;
    std::set<std::string> seen;
    for (const std::string& file : files) append(sources, file, seen, text);
    return text;
}

}  // namespace tessera
