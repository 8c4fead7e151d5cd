#pragma once

#include "bench/time/time_scenes.h"

namespace ode::soft {

/// One way to solve a scene.
struct Method {
    std::string integrator;
    int order;    ///< of the elements
    double share; ///< step over the critical one of central difference on the same elements
};

struct TimedRun {
    double step = 0;           ///< [s]
    double cpu = 0;            ///< of this thread, for each second simulated [s/s]
    bool within_budget = true; ///< else nothing more is known
    bool stable = true;        ///< else it blew up, or a solution wasn't found
    Waveform waveform;
};

/// @param budget  CPU time that the run may take, judged from its first steps [s]
TimedRun run(const TimeScene& scene, const Method& method, double budget);

} // namespace ode::soft
