// Stands between a demo and ODE, so as to know the demo's bodies: ODE enumerates them for nobody.

#include "bodies.h"

#include "../preload/program_call.h"

#include <ode/ode.h>

#include <algorithm>
#include <vector>

namespace ode::conformance {
namespace {

std::vector<dBodyID>& bodies() {                 // in order of creation
    static auto* all = new std::vector<dBodyID>; // demos destroy worlds at exit
    return *all;
}

} // namespace

void add_bodies(Fingerprint& state) noexcept {
    for (const dBodyID body : bodies()) {
        state.add(dBodyGetPosition(body), 3 * sizeof(dReal));
        state.add(dBodyGetQuaternion(body), 4 * sizeof(dReal));
        state.add(dBodyGetLinearVel(body), 3 * sizeof(dReal));
        state.add(dBodyGetAngularVel(body), 3 * sizeof(dReal));
    }
}

double energy_of_bodies() noexcept {
    double sum = 0;
    for (const dBodyID body : bodies()) {
        if (dBodyIsKinematic(body))
            continue;
        dMass mass;
        dBodyGetMass(body, &mass);
        dVector3 g, spin, momentum;
        dWorldGetGravity(dBodyGetWorld(body), g);
        dBodyVectorFromWorld(body, dBodyGetAngularVel(body)[0], dBodyGetAngularVel(body)[1],
                             dBodyGetAngularVel(body)[2], spin);
        dMultiply0_331(momentum, mass.I, spin);
        const dReal* v = dBodyGetLinearVel(body);
        sum +=
            mass.mass * (dCalcVectorDot3(v, v) / 2 - dCalcVectorDot3(g, dBodyGetPosition(body))) +
            dCalcVectorDot3(spin, momentum) / 2;
    }
    return sum;
}

void write_bodies(std::FILE* out) noexcept {
    for (const dBodyID body : bodies()) {
        const dReal* x = dBodyGetPosition(body);
        std::fprintf(out, "body %.17g %.17g %.17g\n", x[0], x[1], x[2]);
    }
}

} // namespace ode::conformance

using namespace ode::conformance;

extern "C" {

dBodyID dBodyCreate(dWorldID world) {
    static const auto real = next<dBodyID(dWorldID)>("dBodyCreate");
    const dBodyID body = real(world);
    if (in_program(__builtin_return_address(0)))
        bodies().push_back(body);
    return body;
}

void dBodyDestroy(dBodyID body) {
    static const auto real = next<void(dBodyID)>("dBodyDestroy");
    std::erase(bodies(), body);
    real(body);
}

void dWorldDestroy(dWorldID world) {
    static const auto real = next<void(dWorldID)>("dWorldDestroy");
    std::erase_if(bodies(), [&](dBodyID body) { return dBodyGetWorld(body) == world; });
    real(world);
}

} // extern "C"
