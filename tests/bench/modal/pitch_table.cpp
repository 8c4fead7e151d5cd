#include "bench/modal/pitch_table.h"

#include "base/error.h"
#include "modal/to_tolerance.h"
#include "scenes/timoshenko.h"
#include "support/pitch_cases.h"

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

/// The reference's frequency of each mode [Hz]; 0 where it has no such shape.
std::vector<double> truth_of(const PitchCase& c, const ModalModel& model,
                             const ModalModel& reference) {
    return c.reference.element.empty() ? matched_frequencies(model, reference)
                                       : reference.frequency; // by rank on a mesh of its own
}

void print_row(std::ostream& out, const PitchCase& c, const char* mesh, const char* element,
               std::size_t nodes, double seconds, const ModalModel& model,
               const ModalModel& reference) {
    out << "| " << c.name << " | " << mesh << " | " << element << " | " << nodes << " | "
        << format("%.2f", seconds) << " |";
    const std::vector<double> truth = truth_of(c, model, reference);
    double worst = 0;
    for (std::size_t k = 0; k < std::min(model.mode_count(), truth.size()); ++k) {
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

void solve_row(std::ostream& out, const PitchCase& c, const char* mesh_name, const TetMesh& mesh,
               const Element& element, const ModalModel& reference) {
    ModalOptions options = options_for(c, mesh);
    options.order = element.order;
    options.mass = element.mass;
    options.max_modes = 8;
    // Linear elements put the partials octaves higher: without this the range would end first.
    options.max_frequency *= element.order == 1 ? 20 : 2;
    const double before = cpu_seconds();
    const ModalModel model = solve_modes(mesh, c.solids, options);
    print_row(out, c, mesh_name, element.name, number_nodes(mesh, element.order).node_count(),
              cpu_seconds() - before, model, reference);
}

/// What a user gets who asks for three cents: as many refinements as that takes, or a refusal.
void tolerance_row(std::ostream& out, const PitchCase& c, const ModalModel& reference) {
    ModalOptions options = options_for(c, c.mesh);
    options.max_modes = 8;
    options.max_frequency *= 2;
    ToleranceOptions wanted;
    wanted.cents = 3;
    wanted.max_nodes = 30000;
    wanted.rebuild_curves = false; // the facets are the geometry here
    const double before = cpu_seconds();
    try {
        const TolerantModes got = modes_to_tolerance(c.mesh, c.solids, options, wanted);
        print_row(out, c, format("%d x refined", got.refinements).c_str(), "default, 3 cents asked",
                  got.nodes, cpu_seconds() - before, got.model, reference);
    } catch (const InputError& refusal) {
        out << "| " << c.name << " | | default, 3 cents asked | | "
            << format("%.2f", cpu_seconds() - before) << " | refused: " << refusal.what()
            << " | | |\n";
    }
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
            solve_row(out, c, "coarse", c.mesh, element, reference);
        solve_row(out, c, "halved", fine, kElements[2], reference);
        tolerance_row(out, c, reference);
    }
}

} // namespace ode::soft
