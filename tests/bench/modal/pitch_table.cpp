#include "bench/modal/pitch_table.h"

#include "base/error.h"
#include "support/pitch_cases.h"
#include "support/timoshenko.h"

#include <algorithm>
#include <ctime>
#include <ostream>

namespace ode::soft {
namespace {

struct Element {
    const char* name;
    int order;
    MassKind mass;
};
constexpr Element kElements[] = {{"linear, lumped (paper)", 1, MassKind::kLumped},
                                 {"quadratic, HRZ", 2, MassKind::kLumped},
                                 {"quadratic", 2, MassKind::kConsistent},
                                 {"cubic, corrected (default)", 3, MassKind::kConsistent}};

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void print_row(std::ostream& out, const PitchCase& c, const char* mesh_name, const TetMesh& mesh,
               const Element& element, const ModalModel& reference) {
    ModalOptions options = options_for(c, mesh);
    options.order = element.order;
    options.mass = element.mass;
    options.max_modes = 8;
    // Linear elements put the partials octaves higher: without this the range would end first.
    options.max_frequency *= element.order == 1 ? 20 : 2;
    const double before = cpu_seconds();
    const ModalModel model = solve_modes(mesh, c.solids, options);
    const double seconds = cpu_seconds() - before;
    const std::vector<double> truth =
        c.reference.element.empty() ? matched_frequencies(model, reference) : reference.frequency;
    out << "| " << c.name << " | " << mesh_name << " | " << element.name << " | "
        << number_nodes(mesh, element.order).node_count() << " | " << format("%.2f", seconds)
        << " |";
    double worst = 0;
    for (std::size_t k = 0; k < model.mode_count(); ++k) {
        if (truth[k] == 0) {
            out << " -";
            continue;
        }
        const double error = cents(model.frequency[k], truth[k]);
        worst = std::max(worst, std::abs(error));
        out << format(" %+.1f", error);
    }
    out << format(" | %.1f | %.1f |\n", worst,
                  *std::max_element(model.error_cents.begin(), model.error_cents.end()));
    out.flush();
}

} // namespace

void print_pitch_table(std::ostream& out) {
    out << "| case | mesh | element | nodes | CPU s | cents of partials 1-8 | worst | widest band "
           "|\n|---|---|---|---|---|---|---|---|\n";
    for (const PitchCase& c : pitch_cases()) {
        const TetMesh fine = refined(c.mesh);
        const TetMesh& judge = c.reference.element.empty() ? fine : c.reference;
        ModalOptions options = options_for(c, judge);
        options.max_modes += 8;
        options.max_frequency *= 1.2;
        options.verify = false;
        const ModalModel reference = solve_modes(judge, c.solids, options);
        for (const Element& element : kElements)
            print_row(out, c, "coarse", c.mesh, element, reference);
        print_row(out, c, "halved", fine, kElements[2], reference);
    }
}

} // namespace ode::soft
