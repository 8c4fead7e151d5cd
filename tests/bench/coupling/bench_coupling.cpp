// bench_coupling [--brief] [--json FILE]: every table on the screen, and as data. Ends with 1 when
// a number is beyond its mark.
#include "bench/coupling/coupling_table.h"

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

int main(int count, char** argument) {
    CLI::App app("Soft against rigid and soft bodies: impulse, energy, momenta, load, cost. Ends "
                 "with 1 when a number is beyond its mark.");
    bool brief = false;
    std::string json;
    app.add_flag("--brief", brief, "One or two of each kind, some seconds");
    app.add_option("--json", json, "Write the tables as data, - for the screen")->type_name("FILE");
    CLI11_PARSE(app, count, argument);
    const std::vector<ode::soft::Table> tables = ode::soft::coupling_tables(brief);
    const bool to_screen = json == "-";
    if (!json.empty()) {
        std::ofstream file;
        if (!to_screen)
            file.open(json);
        std::ostream& out = to_screen ? std::cout : file;
        out << '{';
        for (std::size_t i = 0; i < tables.size(); ++i) {
            out << (i == 0 ? "\n" : ",\n");
            tables[i].print_json(out);
        }
        out << "\n}\n" << std::flush;
        if (!out) {
            std::cerr << "bench_coupling: " << json << " can't be written\n";
            return 2;
        }
    }
    int missed = 0;
    for (const ode::soft::Table& table : tables) {
        if (!to_screen) {
            table.print(std::cout);
            std::cout << '\n';
        }
        for (const std::string& miss : table.misses()) {
            std::cerr << "mark missed: " << miss << '\n';
            ++missed;
        }
    }
    return missed == 0 ? 0 : 1;
}
