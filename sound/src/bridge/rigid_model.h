#pragma once

#include "mix/settings.h"
#include "source/struck_voice.h"
#include "strike/hertz.h"
#include "strike/struck_surface.h"

#include <ode_softbody/softbody.h>

#include <memory>
#include <vector>

namespace ode::sound {

/// What rigid bodies of one shape and material share of their sound.
struct RigidModel {
    std::vector<double> omega;       ///< undamped [rad/s], ascending
    std::vector<float> omega_floats; ///< the same
    std::vector<double> decay;       ///< [1/s]
    StruckSurface surface;           ///< centre of mass at the origin, axes of the mesh
    std::vector<double> shape;       ///< x y z of the surface's nodes, mode after mode [kg^-1/2]
    Elastic elastic;
    double mass = 0.0;                                 ///< of the mesh [kg]
    double volume = 0.0;                               ///< [m^3]
    Vec3 centre = Vec3::Zero();                        ///< of mass, in the mesh's frame [m]
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero(); ///< about it [kg m^2]
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();      ///< of its box, about the centre [m]
};

/// Models in use, so that like bodies share one. Modes are found by dSoftModesCompute(), which
/// keeps them on disk.
class RigidModels {
public:
    /// @return null when the modes can't be had, after a message.
    std::shared_ptr<const RigidModel> find(dSoftMeshID mesh, const dSoftSolid& solid);

    /// How a model sounds as is set; made at the first call.
    std::shared_ptr<const StruckVoiceModel> voice(const std::shared_ptr<const RigidModel>& model,
                                                  const Settings& settings);
    void forget_voices() noexcept; ///< the air has changed

private:
    struct Entry {
        std::vector<double> node;
        std::vector<int> element;
        dSoftSolid solid;
        std::weak_ptr<const RigidModel> model;
        std::shared_ptr<const StruckVoiceModel> voice;
    };
    std::vector<Entry> entry_;
};

} // namespace ode::sound
