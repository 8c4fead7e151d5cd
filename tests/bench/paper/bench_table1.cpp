// softsound bench table1: the source paper's table (P01, table 1) measured again. Each example
// twice: on the paper's own terms (linear elements, node by node) by the twentieth of a second from
// 0.05 s on, which is enough to time it, and by the demo's own defaults, whole. Errors: how far the
// elements are off in pitch, by the lowest mode of the body as it moves against the corrected cubic
// answer on the same shape; and what is heard against the demo's theory where it has one. Runs the
// softsound beside this program.

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace {

struct Example {
    const char* name;
    const char* paper; ///< further options of the paper's terms
    double minutes; ///< CPU minutes a simulated second on a 350 MHz processor, as recalled; 0: none
};
constexpr const char* kNodes = " --tier explicit";
constexpr Example kExamples[] = {{"bowl", kNodes, 91},
                                 {"bar", kNodes, 240},
                                 {"plate-center", " --tier explicit --cells 20", 245},
                                 {"vibraphone", kNodes, 1310},
                                 {"pendulum", "", 88},
                                 {"sheet-stiff", kNodes, 1042},
                                 {"sheet-soft", "", 313},
                                 {"crinkle", "", 0}};

using Json = nlohmann::json;

/// What a demo reports; null when it fails.
Json figures(const std::string& softsound, const std::string& folder, const Example& e,
             const std::string& options) {
    const std::string json = folder + "/" + e.name + ".json";
    const std::string command = softsound + " demo " + e.name + " --quiet --plot '' --out " +
                                folder + "/table1.wav --json " + json + options;
    if (std::system(command.c_str()) != 0)
        return nullptr;
    return Json::parse(std::ifstream(json));
}

/// CPU time of a run, of all and of sound [s].
struct Cost {
    double all, audio;
};

/// Prints a demo's line. @return whether it ran.
bool row(const std::string& softsound, const std::string& folder, const Example& e, bool paper) {
    const auto spent = [](const Json& run) {
        return Cost{run["cpu_seconds"].get<double>(), run["audio_seconds"].get<double>()};
    };
    const std::string terms = paper ? std::string(" --order 1") + e.paper : "";
    const Json r = figures(softsound, folder, e,
                           terms + " --judge-elements" + (paper ? " --seconds 0.1" : ""));
    if (r.is_null())
        return false;
    Cost cost = spent(r);
    double seconds = r["seconds"].get<double>();
    if (paper) { // what is worked out once a body would outweigh so short a run
        const Json half = figures(softsound, folder, e, terms + " --seconds 0.05");
        if (half.is_null())
            return false;
        cost = {cost.all - spent(half).all, cost.audio - spent(half).audio};
        seconds -= half["seconds"].get<double>();
    }
    double cents = 0;
    // A line a tenth of a second long is too broad, and the paper's elements are further off than a
    // theory's line is looked for.
    const bool heard = !paper && r.contains("theory_partials") && !r["theory_partials"].empty();
    if (heard)
        cents = r["theory_partials"][0]["cents"];
    char error[32] = "too short", recalled[32] = "none";
    if (heard)
        std::snprintf(error, sizeof error, "%+.0f", cents);
    else if (!paper)
        std::snprintf(error, sizeof error, "no theory");
    if (e.minutes > 0)
        std::snprintf(recalled, sizeof recalled, "%.0f", e.minutes);
    std::printf("| %s | %s | %.3g | %d / %d | %s | %.1f | %.2f | %.1f %% | %+.0f | %s | %s |\n",
                e.name, paper ? "the paper's" : "ours", 1e6 * r["substep"].get<double>(),
                r["nodes"].get<int>(), r["elements"].get<int>(),
                r["surface_elements"].dump().c_str(), cost.all / seconds, cost.audio / seconds,
                100 * cost.audio / cost.all, r["first_mode_cents"].get<double>(), error, recalled);
    std::fflush(stdout);
    return true;
}

} // namespace

int main(int argc, char**) {
    if (argc > 1) {
        std::printf(
            "softsound bench table1: the source paper's table 1, measured again; minutes\n");
        return 0;
    }
    namespace fs = std::filesystem;
    const std::string softsound =
        (fs::read_symlink("/proc/self/exe").parent_path() / "softsound").string();
    char folder[] = "/tmp/softsound_table1_XXXXXX";
    if (!mkdtemp(folder))
        return 1;
    std::printf("| example | terms | substep [us] | nodes / elements | surface | CPU s/s | audio "
                "CPU s/s | audio share | elements [cents] | heard against theory [cents] | the "
                "paper's CPU min/s, recalled |\n"
                "|---|---|---|---|---|---|---|---|---|---|---|\n");
    bool all = true;
    for (const Example& e : kExamples)
        for (const bool paper : {true, false})
            all = row(softsound, folder, e, paper) && all;
    fs::remove_all(folder);
    return all ? 0 : 1;
}
