// Options whose values are read by parse_values.h.
#include "add_options.h"

#include "tessera/error.h"

#include <utility>

namespace tessera::program {

CLI::Option* addParsed(CLI::App& app, const std::string& optionName, std::function<void(const std::string&)> read,
                       const std::string& description) {
    const auto callback = [optionName, read = std::move(read)](const std::string& text) {
        try {
            read(text);
        } catch (const Error& error) {
            throw CLI::ValidationError(optionName, error.what());
        }
    };
    return app.add_option_function<std::string>(optionName, callback, description);
}

void groupRest(CLI::App& app, const std::string& group) {
    for (CLI::Option* option : app.get_options()) {
        if (option->get_group() == "Options") option->group(group);
    }
}

}  // namespace tessera::program
