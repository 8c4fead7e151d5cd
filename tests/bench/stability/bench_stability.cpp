// softsound bench stability: the stress suite as a table of outcomes.
#include "base/error.h"
#include "stability/suite.h"

#include <CLI/CLI.hpp>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

namespace {

using ode::soft::format;
using ode::test::StressCase;
using ode::test::StressResult;

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

struct Row {
    StressCase of;
    StressResult result;
    double seconds;
};

struct Options {
    std::string json, csv, group;
    bool is_short = false, all = false, quiet = false;
};

std::string quoted(std::string text) {
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2)
        text.insert(at, 1, '"');
    return '"' + text + '"';
}

void write_csv(const std::string& path, const std::vector<Row>& rows) {
    std::ofstream file(path);
    file << "group,case,good,outcome,figure,cpu_seconds\n";
    for (const Row& r : rows)
        file << quoted(r.of.group) << ',' << quoted(r.of.name) << ',' << r.result.good << ','
             << quoted(r.result.outcome) << ',' << quoted(r.result.figure) << ',' << r.seconds
             << '\n';
    if (!file.flush())
        throw std::runtime_error(path + " cannot be written: check the folder and free space");
}

void write_json(const std::string& path, const std::vector<Row>& rows) {
    nlohmann::ordered_json out = nlohmann::ordered_json::array();
    for (const Row& r : rows)
        out.push_back({{"group", r.of.group},
                       {"case", r.of.name},
                       {"good", r.result.good},
                       {"outcome", r.result.outcome},
                       {"figure", r.result.figure},
                       {"cpu_seconds", r.seconds}});
    if (path == "-") {
        std::cout << out.dump(2) << std::endl;
        return;
    }
    std::ofstream file(path);
    if (!(file << out.dump(2) << std::endl))
        throw std::runtime_error(path + " cannot be written: check the folder and free space");
}

void print_rows(const std::vector<Row>& rows) {
    std::cout << "| group | case | outcome | as asked | figure | CPU s |\n"
              << "|---|---|---|---|---|---|\n";
    for (const Row& r : rows)
        std::cout << format("| %s | %s | %s | %s | %s | %.2f |\n", r.of.group.c_str(),
                            r.of.name.c_str(), r.result.outcome.c_str(),
                            r.result.good ? "yes" : "NO", r.result.figure.c_str(), r.seconds);
}

/// How often each outcome came about in each group, and every case that missed.
void print_summary(const std::vector<Row>& rows) {
    std::vector<std::string> groups;
    std::map<std::string, std::map<std::string, int>> count;
    std::map<std::string, int> good, all;
    std::map<std::string, double> seconds;
    for (const Row& r : rows) {
        if (groups.empty() || groups.back() != r.of.group)
            groups.push_back(r.of.group);
        const std::string word = r.result.outcome.substr(0, r.result.outcome.find(", redone"));
        const bool redone = word.size() < r.result.outcome.size();
        ++count[r.of.group][redone ? word + " after a step was redone" : word];
        good[r.of.group] += r.result.good;
        ++all[r.of.group];
        seconds[r.of.group] += r.seconds;
    }
    std::cout << "| group | as asked | outcomes | CPU s |\n|---|---|---|---|\n";
    for (const std::string& group : groups) {
        std::string outcomes;
        for (const auto& [word, times] : count[group])
            outcomes += format("%s%d %s", outcomes.empty() ? "" : "; ", times, word.c_str());
        std::cout << format("| %s | %d of %d | %s | %.1f |\n", group.c_str(), good[group],
                            all[group], outcomes.c_str(), seconds[group]);
    }
    std::cout << '\n';
    for (const Row& r : rows)
        if (!r.result.good)
            std::cout << format("missed: %s, %s: %s; %s\n", r.of.group.c_str(), r.of.name.c_str(),
                                r.result.outcome.c_str(), r.result.figure.c_str());
}

} // namespace

int main(int argc, char** argv) {
    Options o;
    CLI::App app("The stress suite: what recovers, what is told, what is refused");
    app.name("softsound bench stability");
    app.add_option("--json", o.json, "Write every case as data ('-': standard output)")
        ->type_name("FILE");
    app.add_option("--csv", o.csv, "Write every case as a table")->type_name("FILE");
    app.add_option("--group", o.group, "Only the cases of this group")->type_name("NAME");
    app.add_flag("--short", o.is_short, "Only the quick cases, which are tests too; a minute");
    app.add_flag("--all", o.all, "Print every case, not a line a group");
    app.add_flag("--quiet", o.quiet, "Print nothing");
    CLI11_PARSE(app, argc, argv);
    std::vector<Row> rows;
    for (const StressCase& c : ode::test::stress_cases()) {
        if ((o.is_short && !c.quick) || (!o.group.empty() && o.group != c.group))
            continue;
        const double start = cpu_seconds();
        const StressResult result = c.run();
        rows.push_back({c, result, cpu_seconds() - start});
    }
    if (rows.empty()) {
        std::cerr << "there is no group '" << o.group << "'; leave --group out to see all\n";
        return 2;
    }
    try {
        if (!o.csv.empty())
            write_csv(o.csv, rows);
        if (!o.json.empty())
            write_json(o.json, rows);
    } catch (const std::exception& e) {
        std::cerr << e.what() << '\n';
        return 1;
    }
    if (!o.quiet && o.json != "-")
        o.all ? print_rows(rows) : print_summary(rows);
    for (const Row& r : rows)
        if (!r.result.good)
            return 1;
    return 0;
}
