// softsound integrators: what each integrator makes of a vibration, as a table and a plot.
//
// A mode x'' + 2 zeta w x' + w^2 x = 0 is stepped by the integrator's own code; the eigenvalue
// z = exp((-zeta' + i sqrt(1 - zeta'^2)) w' h) of a step tells
//   amplification      |z|, above 1 unstable
//   artificial damping zeta' - zeta
//   period error       T'/T - 1, in cents of pitch the other way round
// all as functions of w h and zeta.

#include "plots/gnuplot.h"
#include "softsound/command.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <ode_softbody/softbody.h>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace softsound {
namespace {

struct Options {
    std::string plot, csv;
    double damping_ratio = 0;
};

constexpr double kLow = 0.01, kHigh = 10; // of w h
constexpr int kPoints = 241;
constexpr double kShown[] = {0.1, 0.5, 1.0, 1.9, 3.0}; // columns of the table

struct Point {
    double omega_h;
    dSoftIntegratorResponse response;
};

struct Curve {
    std::string name;
    dSoftIntegratorInfo info;
    std::vector<Point> point;
};

Point at(const char* name, double omega_h, double damping_ratio) {
    Point p{omega_h, {}};
    p.response.struct_size = sizeof p.response;
    dSoftIntegratorGetResponse(name, omega_h, damping_ratio, &p.response);
    return p;
}

Curve curve_of(const char* name, double damping_ratio) {
    Curve curve{name, {}, {}};
    curve.info.struct_size = sizeof curve.info;
    dSoftIntegratorGetInfo(name, &curve.info);
    for (int i = 0; i < kPoints; ++i)
        curve.point.push_back(
            at(name, kLow * std::pow(kHigh / kLow, i / (kPoints - 1.0)), damping_ratio));
    return curve;
}

void print_table(const std::vector<Curve>& curves, double damping_ratio) {
    std::printf("amplification a step / period error, damping ratio %g\n\n", damping_ratio);
    std::printf("| integrator | order | forces |");
    for (const double omega_h : kShown)
        std::printf(" w h = %g |", omega_h);
    std::printf("\n|---|---|---|");
    for (std::size_t i = 0; i < std::size(kShown); ++i)
        std::printf("---|");
    std::printf("\n");
    for (const Curve& c : curves) {
        std::printf("| %s | %d | %s%d%s |", c.name.c_str(), c.info.order,
                    c.info.implicit ? "solve, " : "", c.info.forces,
                    c.info.implicit ? " an iteration" : "");
        for (const double omega_h : kShown) {
            const dSoftIntegratorResponse r = at(c.name.c_str(), omega_h, damping_ratio).response;
            if (std::isfinite(r.period_error))
                std::printf(" %.4f / %+.2f %% |", r.amplification, 100 * r.period_error);
            else
                std::printf(" %.4f / - |", r.amplification);
        }
        std::printf("\n");
    }
}

void write_csv(const std::string& path, const std::vector<Curve>& curves, double damping_ratio) {
    std::ofstream file(path);
    file.precision(17);
    file << "integrator,omega_h,damping_ratio,amplification,artificial_damping,period_error\n";
    for (const Curve& c : curves)
        for (const Point& p : c.point)
            file << c.name << ',' << p.omega_h << ',' << damping_ratio << ','
                 << p.response.amplification << ',' << p.response.artificial_damping << ','
                 << p.response.period_error << '\n';
    if (!file.flush())
        throw std::runtime_error(path + " cannot be written: check the folder and free space");
}

constexpr const char* kColours[] = {"#d0202e", "#f0a020", "#3a3a98", "#80c060", "#107040",
                                    "#8fb8de", "#b060c0", "#202020", "#a08060", "#20b0b0"};

/// One panel: a value of every integrator over w h. Where `value` is not a number the line breaks.
template <class Value>
void say_panel(std::ostringstream& say, const std::vector<Curve>& curves, Value value) {
    say << "plot ";
    for (std::size_t i = 0; i < curves.size(); ++i)
        // Ever thinner, so that curves which coincide show beside each other.
        say << (i ? ", " : "") << "'-' using 1:2 with lines lw " << curves.size() - i << " lc rgb '"
            << kColours[i % std::size(kColours)] << "' title " << plots::quoted(curves[i].name)
            << " noenhanced";
    say << "\n";
    for (const Curve& c : curves) {
        for (const Point& p : c.point) {
            const double y = value(p.response);
            if (std::isfinite(y))
                say << p.omega_h << ' ' << y << "\n";
            else
                say << "\n";
        }
        say << "e\n";
    }
}

void draw(const std::string& path, const std::vector<Curve>& curves, double damping_ratio) {
    plots::Gnuplot gnuplot;
    std::ostringstream say;
    say << "set terminal png size 900,1000 font 'sans,11'\nset output " << plots::quoted(path)
        << "\nset multiplot layout 3,1 title 'a mode of damping ratio " << damping_ratio
        << " in a step of h'\nset logscale x; set xrange [" << kLow << ':' << kHigh
        << "]; set grid; set key outside right\n"
        << "set ylabel 'amplification a step'; set yrange [0:1.5]\n";
    say_panel(say, curves, [](const auto& r) { return r.amplification; });
    say << "set ylabel 'artificial damping ratio'; set yrange [-0.5:1]\n";
    say_panel(say, curves, [](const auto& r) { return r.artificial_damping; });
    say << "set xlabel 'omega h'; set ylabel 'period error'; set yrange [-0.5:1]\n";
    say_panel(say, curves, [](const auto& r) { return r.period_error; });
    say << "unset multiplot\n";
    gnuplot.say(say.str());
    if (const std::string trouble = gnuplot.finish(); !trouble.empty())
        throw std::runtime_error(trouble);
}

int run(const Options& o, const Common& common) {
    std::vector<Curve> curves;
    for (int i = 0; const char* name = dSoftIntegratorName(i); ++i)
        curves.push_back(curve_of(name, o.damping_ratio));
    if (common.summarises())
        print_table(curves, o.damping_ratio);
    if (!o.csv.empty())
        write_csv(o.csv, curves, o.damping_ratio);
    if (!o.plot.empty())
        draw(o.plot, curves, o.damping_ratio);
    nlohmann::ordered_json results = {{"damping_ratio", o.damping_ratio}};
    for (const Curve& c : curves) {
        nlohmann::ordered_json& out = results["integrators"][c.name];
        out = {{"order", c.info.order}, {"implicit", c.info.implicit}, {"forces", c.info.forces}};
        for (const Point& p : c.point) {
            out["omega_h"].push_back(p.omega_h);
            out["amplification"].push_back(p.response.amplification);
            out["artificial_damping"].push_back(p.response.artificial_damping);
            out["period_error"].push_back(p.response.period_error); // null where nothing swings
        }
    }
    write_json(common, results);
    return 0;
}

} // namespace

void add_integrators(CLI::App& app, Common& common) {
    auto options = std::make_shared<Options>();
    CLI::App& integrators = *app.add_subcommand(
        "integrators", "What each integrator makes of a vibration: growth, damping, pitch");
    integrators.add_option("--damping-ratio", options->damping_ratio, "Of the mode, 0 to 1")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    integrators.add_option("--plot", options->plot, "Picture of the three curves (PNG)")
        ->type_name("FILE");
    integrators.add_option("--csv", options->csv, "The curves as a table")->type_name("FILE");
    add_common(integrators, common);
    integrators.callback([options, &common] {
        common.action = [options, &common] { return run(*options, common); };
    });
}

} // namespace softsound
