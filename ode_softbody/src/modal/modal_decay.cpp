#include "modal/modal_decay.h"

#include "integrate/rigid_fit.h"
#include "model/make_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ode::soft {
namespace {

using Eigen::VectorXd;

/// Viscous stress for each of elastic stress, if one number tells all of it [s].
bool viscous_time_is_one(std::span<const Solid> solids) {
    return std::all_of(solids.begin(), solids.end(),
                       [](const Solid& s) { return s.phi == 0 && s.psi == 0; });
}

/// E and nu of given Lame parameters.
void set_lame(Solid& s, double lambda, double mu) {
    s.young = mu * (3 * lambda + 2 * mu) / (lambda + mu);
    s.poisson = lambda / (2 * (lambda + mu));
}

/// Shapes of a body under altered constants: how much of the energy is where they were altered.
class Shares {
public:
    Shares(const TetMesh& mesh, std::span<const Solid> solids) : mesh_(mesh), solids_(solids) {
        rest_ = NodeArray(mesh.node.size());
        for (std::size_t i = 0; i < rest_.size(); ++i)
            rest_[i] = mesh.node[i];
    }

    /// Shape^T K shape of solids changed by `alter`.
    template <class Alter>
    VectorXd strain(const ModalModel& modes, Alter alter) const {
        const Eigen::SparseMatrix<double> k = altered(alter)->stiffness(rest_);
        return each(modes, [&](const Eigen::Map<const VectorXd>& u) { return u.dot(k * u); });
    }
    /// Shape^T M shape, each node's mass weighted by `weight` of its solid (0 to 1), of what moves
    /// against the rigid motion that mass-proportional damping spares (damp_deformation). Per mass.
    template <class Weight>
    VectorXd kinetic(const ModalModel& modes, Weight weight) const {
        // From 1 up, because no solid weighs nothing.
        const auto plain = altered([](Solid&) {});
        const auto heavier = altered([&](Solid& s) { s.density *= 1 + weight(s); });
        std::vector<double> m(rest_.size());
        for (std::size_t i = 0; i < m.size(); ++i)
            m[i] = std::max(0.0, heavier->mass()[i] - plain->mass()[i]);
        const std::vector<double> all_free(m.size(), 1.0);
        const RigidMotions rigid([&](std::size_t i) { return m[i]; }, all_free, {}, rest_);
        return each(modes, [&](const Eigen::Map<const VectorXd>& u) {
            const auto at = [&](std::size_t i) {
                return u.segment<3>(static_cast<Eigen::Index>(3 * i));
            };
            Vec3 linear = Vec3::Zero(), angular = linear;
            double whole = 0, sum = 0;
            for (std::size_t i = 0; i < m.size(); ++i) {
                linear += m[i] * at(i);
                angular += m[i] * (rest_[i] - rigid.pivot()).cross(at(i));
                whole += plain->mass()[i] * at(i).squaredNorm();
            }
            const RigidMotions::Motion spared =
                modes.rigid_modes == 6 ? rigid.of(linear, angular) : RigidMotions::Motion{};
            for (std::size_t i = 0; i < m.size(); ++i)
                sum += m[i] * (at(i) - rigid.at(spared, rest_[i])).squaredNorm();
            return sum / whole;
        });
    }

private:
    template <class Alter>
    std::unique_ptr<ElasticModel> altered(Alter alter) const {
        std::vector<Solid> changed(solids_.begin(), solids_.end());
        for (Solid& s : changed)
            alter(s);
        return make_model("stvk", mesh_, changed);
    }
    template <class Of>
    static VectorXd each(const ModalModel& modes, Of of) {
        VectorXd out(static_cast<Eigen::Index>(modes.mode_count()));
        for (std::size_t k = 0; k < modes.mode_count(); ++k) {
            const auto u = modes.shape_of(k);
            out[static_cast<Eigen::Index>(k)] =
                of(Eigen::Map<const VectorXd>(u.data(), static_cast<Eigen::Index>(u.size())));
        }
        return out;
    }

    const TetMesh& mesh_;
    std::span<const Solid> solids_;
    NodeArray rest_;
};

} // namespace

std::vector<double> modal_decays(const TetMesh& mesh, std::span<const Solid> solids,
                                 const ModalModel& modes) {
    const auto most = [&](double Solid::*field) {
        double out = 0;
        for (const Solid& s : solids)
            out = std::max(out, s.*field);
        return out;
    };
    const double alpha = most(&Solid::alpha), eta = most(&Solid::loss_factor);
    double beta = 0;
    for (const Solid& s : solids)
        beta = std::max({beta, s.viscous_lambda() / s.mu(), s.viscous_mu() / s.mu()});

    // How much of the largest constant counts in each mode.
    const auto n = static_cast<Eigen::Index>(modes.mode_count());
    VectorXd mass_share = VectorXd::Ones(n), loss_share = mass_share, viscous_share = mass_share;
    const bool plain = solids.size() == 1 && viscous_time_is_one(solids);
    if (plain) {
        beta = solids[0].beta;
    } else if (n > 0) {
        // Constants grow by 1 to 2 times and are compared with what they were: none may vanish.
        const Shares shares(mesh, solids);
        const VectorXd strain = shares.strain(modes, [](Solid&) {});
        const auto grown = [](const VectorXd& now, const VectorXd& before) {
            return VectorXd(now.cwiseQuotient(before).array() - 1);
        };
        if (alpha > 0)
            mass_share = shares.kinetic(modes, [&](const Solid& s) { return s.alpha / alpha; });
        if (eta > 0)
            loss_share =
                grown(shares.strain(modes, [&](Solid& s) { s.young *= 1 + s.loss_factor / eta; }),
                      strain);
        if (beta > 0)
            viscous_share =
                grown(shares.strain(modes,
                                    [&](Solid& s) {
                                        set_lame(s, s.lambda() + s.viscous_lambda() / beta,
                                                 s.mu() + s.viscous_mu() / beta);
                                    }),
                      strain);
    }
    std::vector<double> out;
    for (Eigen::Index k = 0; k < n; ++k) {
        const double w = 2 * std::numbers::pi * modes.frequency[static_cast<std::size_t>(k)];
        out.push_back(std::max(0.0, 0.5 * (alpha * mass_share[k] + beta * viscous_share[k] * w * w +
                                           eta * loss_share[k] * w)));
    }
    return out;
}

} // namespace ode::soft
