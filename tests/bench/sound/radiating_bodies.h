#pragma once

#include "transfer/transfer_table.h"

#include <string>
#include <vector>

namespace ode::sound::test {

/// A body that vibrates in one shape at any frequency, and where it is listened to.
struct RadiatingBody {
    std::string name;
    double size;               ///< a of ka [m]
    BoundaryMesh mesh;         ///< [m]
    std::vector<double> shape; ///< x y z of every node; amplitude [-]
    Vec3 ear;                  ///< [m]
    bool compact;              ///< the cheap rule is held to its mark
    /// |p| at the ear for unit acceleration of the shape, by closed form or by finer elements.
    double (*reference)(const RadiatingBody& body, double ka);
    std::string source; ///< of the reference
};

/// Pulsating sphere, sphere shaking towards the ear, piston in a baffle on its axis and at 30
/// degrees, free bar bent in its first and second shape. All 3 m away.
std::vector<RadiatingBody> radiating_bodies();

} // namespace ode::sound::test
