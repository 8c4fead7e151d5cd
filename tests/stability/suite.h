#pragma once

#include "stability/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace ode::test {

/// What became of a case.
struct StressResult {
    std::string outcome; ///< in a few words
    bool good = false;   ///< what the suite asks of it
    std::string figure;  ///< what was measured
};

/// One line of the stress suite.
struct StressCase {
    std::string group, name;
    bool quick; ///< some seconds at most: also a test
    std::function<StressResult()> run;
};

/// All of them, in order of print.
std::vector<StressCase> stress_cases();

// Groups, in files of their own.
void add_integrator_cases(std::vector<StressCase>& cases);
void add_critical_step_cases(std::vector<StressCase>& cases);
void add_deformation_cases(std::vector<StressCase>& cases);
void add_mesh_cases(std::vector<StressCase>& cases);
void add_world_cases(std::vector<StressCase>& cases);

/// @param good  besides being honest.
StressResult judged(const Scene& scene, bool good, std::string figure = {});

} // namespace ode::test
