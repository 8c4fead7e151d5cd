#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

/// softsound, the command line. Each subcommand registers itself with the parser; what it does runs
/// after parsing, and its result is the program's exit status.
namespace softsound {

/// Options of every subcommand.
struct Common {
    std::string json;   ///< file for the results as data, "-" for standard output
    bool quiet = false; ///< no progress, no summary
    std::function<int()> action;

    /// Whether standard output is for reading: not when it carries the data.
    bool summarises() const { return !quiet && json != "-"; }
};

/// Longest side of what sounds, in metres: beyond, the mesh is likely one of millimetres.
constexpr double kSuspiciousLength = 5;

/// A finite number above 0: CLI11's own check lets NaN through.
CLI::Validator positive_number();

/// Adds --json and --quiet.
void add_common(CLI::App& command, Common& common);

/// Writes results where --json asks for them; nothing when it doesn't.
/// @throws std::runtime_error naming the file that cannot be written
void write_json(const Common& common, const nlohmann::ordered_json& results);

/// Adds --json and --quiet, and what is to be done after parsing. Results go to NAME.json unless
/// told otherwise.
void add_action(CLI::App& command, Common& common, const std::string& name,
                std::function<int()> action);

// One function a subcommand, in the file of its name.
void add_demo(CLI::App& app, Common& common);
void add_inspect(CLI::App& app, Common& common);
void add_integrators(CLI::App& app, Common& common);
void add_modes(CLI::App& app, Common& common);
void add_strike(CLI::App& app, Common& common);
void add_bench(CLI::App& app, Common& common);

} // namespace softsound
