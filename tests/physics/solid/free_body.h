#pragma once

#include "integrate/central_difference.h"
#include "integrate/critical_step.h"
#include "unit/model/specimens.h"

namespace ode::soft {

/// One body under central difference, with no force from outside.
struct FreeBody {
    const ElasticModel& model;
    std::vector<double> inverse_mass;
    NodeInertia inertia;
    NodeState state;
    NodeArray force;
    CentralDifference method;

    FreeBody(const ElasticModel& m, const NodeArray& position)
        : model(m), state{position, NodeArray(position.size())}, force(position.size()) {
        for (const double mass : m.mass())
            inverse_mass.push_back(1 / mass);
        inertia.inverse_mass = inverse_mass;
    }
    FreeBody(const FreeBody&) = delete;
    FreeBody& operator=(const FreeBody&) = delete;

    double critical(double beta = 0) const {
        return critical_step(model, inverse_mass, state.position, beta);
    }
    StrainExtremes step(double h) {
        force.set_zero();
        const StrainExtremes worst = method.evaluate(model, state, force);
        method.step(model, inertia, h, state, force);
        return worst;
    }
};

} // namespace ode::soft
