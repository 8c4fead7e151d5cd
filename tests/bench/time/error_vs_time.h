#pragma once

#include "bench/time/timed_run.h"
#include "bench/time/waveform_error.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace ode::soft {

/// One method on one scene, and what came of it.
struct TimeRow {
    std::string scene;
    Method method;
    TimedRun run;                                              ///< without its waveform
    double waveform = std::numeric_limits<double>::infinity(); ///< error [-]
    double steps = std::numeric_limits<double>::quiet_NaN(); ///< share of the steps in it: against
                                                             ///< fine steps, the same elements
    double cents = std::numeric_limits<double>::quiet_NaN(); ///< NaN: not told by the scene
    double decay = std::numeric_limits<double>::quiet_NaN(); ///< relative
    bool on_front = false; ///< nothing on the same scene is truer and clearly faster

    bool is_default() const {
        return method.integrator == "central-difference" && method.share == 0.9;
    }
};

/// Every integrator, order of element and step on every scene.
/// @param budget    CPU time that a run may take [s]; longer ones are told by their price only
/// @param progress  called before each run
std::vector<TimeRow> error_vs_time(double budget,
                                   const std::function<void(const std::string&)>& progress);

} // namespace ode::soft
