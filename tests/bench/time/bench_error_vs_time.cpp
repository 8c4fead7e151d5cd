// What an error costs: every integrator on linear and quadratic elements at several steps, on a
// bar, a bowl and a soft block. Prints a Markdown table.
#include "bench/time/error_vs_time.h"
#include "bench/time/front_plot.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <unistd.h>

namespace {

using namespace ode::soft;

std::string shown(double value, const char* form) {
    char text[32];
    std::snprintf(text, sizeof text, form, value);
    return std::isfinite(value) ? text : "-";
}

const char* outcome(const TimeRow& row) {
    if (!row.run.within_budget)
        return "over the budget";
    if (!row.run.stable)
        return "unstable";
    return row.on_front ? (row.is_default() ? "**front, default**" : "**front**")
                        : (row.is_default() ? "default" : "");
}

void print_table(const std::vector<TimeRow>& rows) {
    std::printf("| scene | element | integrator | step, us | CPU s/s | waveform error | of it by "
                "steps | cents | decay error | |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (const TimeRow& row : rows)
        std::printf("| %s | %s | %s | %.3g | %.3g | %s | %s | %s | %s | %s |\n", row.scene.c_str(),
                    row.method.order == 1 ? "linear" : "quadratic", row.method.integrator.c_str(),
                    1e6 * row.run.step, row.run.cpu, shown(100 * row.waveform, "%.3g %%").c_str(),
                    shown(100 * row.steps, "%.2g %%").c_str(), shown(row.cents, "%.2f").c_str(),
                    shown(100 * row.decay, "%.2g %%").c_str(), outcome(row));
}

bool write_csv(const std::vector<TimeRow>& rows, const std::string& path) {
    std::ofstream file(path);
    file.precision(9);
    file << "scene,order,integrator,share_of_critical,step_s,cpu_s_per_s,waveform_error,step_error,"
            "cents,"
            "decay_error,within_budget,stable,on_front\n";
    for (const TimeRow& r : rows)
        file << r.scene << ',' << r.method.order << ',' << r.method.integrator << ','
             << r.method.share << ',' << r.run.step << ',' << r.run.cpu << ',' << r.waveform << ','
             << r.steps << ',' << r.cents << ',' << r.decay << ',' << r.run.within_budget << ','
             << r.run.stable << ',' << r.on_front << '\n';
    return static_cast<bool>(file.flush());
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Waveform, pitch and decay error against run time. The bar's and the bowl's "
                 "reference is a sum of damped modes, the block's a converged run.");
    double budget = 20;
    bool brief = false;
    std::string csv, plot;
    app.add_option("--budget", budget, "CPU seconds that a run may take (default 20)")
        ->check(CLI::PositiveNumber);
    app.add_flag("--brief", brief, "A budget of 1 s: a minute");
    app.add_option("--csv", csv, "File for the table as data");
    app.add_option("--plot", plot, "PNG of error over run time");
    CLI11_PARSE(app, argc, argv);

    const bool tell = isatty(STDERR_FILENO) != 0;
    const std::vector<TimeRow> rows =
        error_vs_time(brief ? 1 : budget, [tell](const std::string& what) {
            if (tell)
                std::fprintf(stderr, "\r\033[K%s", what.c_str());
        });
    if (tell)
        std::fprintf(stderr, "\r\033[K");
    print_table(rows);
    if (!csv.empty() && !write_csv(rows, csv)) {
        std::cerr << csv << " cannot be written: check the folder and free space\n";
        return 1;
    }
    if (const std::string fault = plot.empty() ? "" : plot_front(rows, plot); !fault.empty()) {
        std::cerr << fault << '\n';
        return 1;
    }
    return 0;
}
