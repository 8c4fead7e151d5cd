#pragma once

#include "integrate/node_state.h"
#include "model/elastic_model.h"

#include <memory>
#include <span>
#include <string_view>

namespace ode::soft {

/// One way to step the nodes of a body. One object serves one body: scratch is made once, so that a
/// step allocates nothing.
///
/// The world first adds gravity and contacts between all bodies to each body's force array, at the
/// positions and velocities as they stand, and then steps the bodies one by one; external force is
/// constant over the substep. Methods with several stages evaluate the material anew at each stage;
/// those with one stage cost one evaluation and no copy.
class Integrator {
public:
    virtual ~Integrator() = default;

    virtual const char* name() const noexcept = 0;

    /// Advances by h [s].
    /// @param force  in: external force [N]; out: spent, its content is the method's affair.
    /// @return the worst strain that was met on the way.
    virtual StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                                NodeState& state, NodeArray& force) noexcept = 0;

    /// Turns the velocity at the time of the positions into the one that the method keeps between
    /// steps of h, and back: for initial states, hand-over between tiers, changes of h and output
    /// that must be exact. `force` as in step(). Most methods keep the former: nothing to do.
    virtual void begin(const ElasticModel&, const NodeInertia&, double /*h*/, NodeState&,
                       NodeArray& /*force*/) noexcept {}
    virtual void end(const ElasticModel&, const NodeInertia&, double /*h*/, NodeState&,
                     NodeArray& /*force*/) noexcept {}
};

/// All names that make_integrator() knows.
std::span<const std::string_view> integrator_names() noexcept;

/// @throws InputError for an unknown name, listing the known ones.
std::unique_ptr<Integrator> make_integrator(std::string_view name, std::size_t nodes);

} // namespace ode::soft
