#include "softsound/command.h"

#include <cmath>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace softsound {

CLI::Validator positive_number() {
    return {[](std::string& text) {
                double value = 0;
                return CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value)
                           ? std::string()
                           : "'" + text + "' must be a finite number above 0";
            },
            "POSITIVE"};
}

void add_common(CLI::App& command, Common& common) {
    command.add_option("--json", common.json, "Write the results as data ('-': standard output)")
        ->type_name("FILE");
    command.add_flag("--quiet", common.quiet, "No progress, no summary");
}

void add_action(CLI::App& command, Common& common, const std::string& name,
                std::function<int()> action) {
    add_common(command, common);
    command.callback([&common, name, action = std::move(action)] {
        if (common.json.empty())
            common.json = name + ".json";
        common.action = action;
    });
}

void write_json(const Common& common, const nlohmann::ordered_json& results) {
    if (common.json.empty())
        return;
    if (common.json == "-") {
        std::cout << results.dump(2) << std::endl;
        return;
    }
    std::ofstream file(common.json);
    file << results.dump(2) << '\n';
    file.close();
    if (!file)
        throw std::runtime_error(common.json + ": cannot be written; is the folder there?");
}

} // namespace softsound
