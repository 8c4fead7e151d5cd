#pragma once

#include <ode_softbody/softbody.h>
#include <vector>

namespace softsound {

/// Times at which a body lands: a contact that bears force after a stretch of free flight. Watches
/// every substep, because a hard landing is over within less than a step of ODE.
class Impacts {
public:
    /// @param flight  shortest free flight that makes the next contact a new impact [s]
    Impacts(dSoftWorldID world, dSoftBodyID body, double flight);
    ~Impacts();
    Impacts(const Impacts&) = delete;
    Impacts& operator=(const Impacts&) = delete;

    const std::vector<double>& times() const { return times_; } ///< [s] since the world's creation

private:
    void look(dSoftBodyID body, double time);

    dSoftWorldID world_;
    dSoftBodyID body_;
    double flight_;
    double last_contact_;
    std::vector<double> times_;
};

} // namespace softsound
