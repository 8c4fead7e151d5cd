// bench_coupling [--brief] [--json FILE]: every table on the screen, and as data. Ends with 1 when
// a number is beyond its mark.
#include "bench/coupling/coupling_table.h"

#include <cstring>
#include <fstream>
#include <iostream>

int main(int count, char** argument) {
    bool brief = false;
    const char* json = nullptr;
    for (int i = 1; i < count; ++i) {
        if (std::strcmp(argument[i], "--brief") == 0) {
            brief = true;
        } else if (std::strcmp(argument[i], "--json") == 0 && i + 1 < count) {
            json = argument[++i];
        } else {
            std::cerr << "bench_coupling: '" << argument[i]
                      << "' is not understood; usage: bench_coupling [--brief] [--json FILE|-]\n";
            return 2;
        }
    }
    const std::vector<ode::soft::Table> tables = ode::soft::coupling_tables(brief);
    const bool to_screen = json && std::strcmp(json, "-") == 0;
    if (json) {
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
