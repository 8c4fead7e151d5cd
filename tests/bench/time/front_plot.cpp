#include "bench/time/front_plot.h"

#include "integrate/integrator.h"
#include "plots/gnuplot.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ode::soft {
namespace {

constexpr const char* kColours[] = {"#d0202e", "#f0a020", "#3a3a98", "#80c060", "#107040",
                                    "#8fb8de", "#b060c0", "#202020", "#a08060", "#20b0b0"};

using Error = double TimeRow::*;

void say_points(std::ostringstream& say, const std::vector<TimeRow>& rows, Error error) {
    say << "1 NaN\n"; // gnuplot minds a curve without any line
    for (const TimeRow& row : rows)
        if (std::isfinite(row.*error))
            say << row.run.cpu << ' ' << row.*error << "\n";
    say << "e\n";
}

template <class Chosen>
std::vector<TimeRow> chosen(const std::vector<TimeRow>& rows, Chosen is) {
    std::vector<TimeRow> out;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(out), is);
    return out;
}

void say_panel(std::ostringstream& say, const std::vector<TimeRow>& rows, Error error) {
    say << "set title " << plots::quoted(rows[0].scene) << "\nplot '-' using 1:2 with lines lw 1.5 "
        << "lc rgb '#909090' title 'Pareto front'";
    const auto kinds = integrator_kinds();
    for (std::size_t i = 0; i < kinds.size(); ++i)
        for (const int order : {1, 2})
            say << ", '-' using 1:2 with points ps 1.3 pt " << (order == 1 ? 6 : 7) << " lc rgb '"
                << kColours[i % std::size(kColours)] << "' "
                << (order == 1 ? "notitle" : "title " + plots::quoted(std::string(kinds[i].name)))
                << " noenhanced";
    say << "\n";
    std::vector<TimeRow> front =
        chosen(rows, [&](const TimeRow& r) { return r.on_front && error == &TimeRow::waveform; });
    std::sort(front.begin(), front.end(),
              [](const TimeRow& a, const TimeRow& b) { return a.run.cpu < b.run.cpu; });
    say_points(say, front, error);
    for (const IntegratorKind& kind : kinds)
        for (const int order : {1, 2}) {
            const auto mine = chosen(rows, [&](const TimeRow& r) {
                return r.method.integrator == kind.name && r.method.order == order &&
                       std::isfinite(r.*error);
            });
            say_points(say, mine, error);
        }
}

} // namespace

std::string plot_front(const std::vector<TimeRow>& rows, const std::string& path) {
    std::ostringstream say;
    say << "set terminal pngcairo size 1500,1000 font 'sans,10' background '#ffffff'\nset output "
        << plots::quoted(path)
        << "\nset multiplot layout 2,3 title "
           "'Waveform error against run time (circles: linear elements, dots: quadratic)'\n"
           "set logscale xy\nset format x '10^{%T}'\nset format y '10^{%T}'\nset grid\n"
           "set xlabel 'CPU seconds a simulated second'\n"
           "set key top right font ',8'\n";
    for (const Error error : {&TimeRow::waveform, &TimeRow::steps}) {
        say << "set ylabel "
            << (error == &TimeRow::waveform ? "'relative error of the surface velocity'"
                                            : "'of it by steps'")
            << "\n";
        for (std::size_t first = 0; first < rows.size();) {
            const auto panel =
                chosen(rows, [&](const TimeRow& r) { return r.scene == rows[first].scene; });
            say_panel(say, panel, error);
            say << "unset key\n";
            first += panel.size();
        }
    }
    say << "unset multiplot\n";
    plots::Gnuplot gnuplot;
    gnuplot.say(say.str());
    return gnuplot.finish();
}

} // namespace ode::soft
