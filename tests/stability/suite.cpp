#include "stability/suite.h"

#include "base/error.h"

namespace ode::test {

using soft::format;

std::vector<StressCase> stress_cases() {
    std::vector<StressCase> cases;
    add_integrator_cases(cases);
    add_critical_step_cases(cases);
    add_deformation_cases(cases);
    add_mesh_cases(cases);
    add_world_cases(cases);
    return cases;
}

StressResult judged(const Scene& scene, bool good, std::string figure) {
    const Verdict& v = scene.verdict();
    if (figure.empty())
        figure = format("least J %.2g, energy / due %.2g", v.least_jacobian, v.energy_share);
    return {v.outcome(), good && v.is_honest(), figure};
}

} // namespace ode::test
