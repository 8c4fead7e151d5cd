#pragma once

#include "integrate/node_state.h"
#include "model/elastic_model.h"

#include <limits>
#include <memory>
#include <span>
#include <string_view>

namespace ode::soft {

/// One way to step the nodes of a body. One object serves one body: scratch is made once, so that a
/// step of an explicit method allocates nothing.
///
/// A substep has two halves. The world puts gravity and the application's forces into each body's
/// force array and calls evaluate(), which adds the material's; then contacts between all bodies,
/// which see everything else that acts, add theirs; then step() moves the body. What is not the
/// material's is constant over the substep. Methods with several stages keep a copy of what
/// evaluate() added and evaluate the material anew at each later stage; those with one stage cost
/// one evaluation and no copy.
class Integrator {
public:
    virtual ~Integrator() = default;

    /// Adds the material's force [N] at the state as it stands.
    /// @return the worst strain there.
    virtual StrainExtremes evaluate(const ElasticModel& model, const NodeState& state,
                                    NodeArray& force) noexcept = 0;

    /// Advances by h [s].
    /// @param force  in: all force at the state as it stands [N]; out: spent, its content is the
    ///               method's affair.
    /// @return the worst strain that was met on the way, besides that of evaluate(). A step that
    /// failed (a non-linear solution that wasn't found) is told by kFailedStep.
    virtual StrainExtremes step(const ElasticModel& model, const NodeInertia& inertia, double h,
                                NodeState& state, NodeArray& force) noexcept = 0;

    /// Turns the velocity at the time of the positions into the one that the method keeps between
    /// steps of h, and back: for initial states, hand-over between tiers, changes of h and output
    /// that must be exact. `force` as for evaluate(). Most methods keep the former: nothing to do.
    virtual void begin(const ElasticModel&, const NodeInertia&, double /*h*/, NodeState&,
                       NodeArray& /*force*/) noexcept {}
    virtual void end(const ElasticModel&, const NodeInertia&, double /*h*/, NodeState&,
                     NodeArray& /*force*/) noexcept {}
};

/// No strain is this bad: the watch over stability takes the body back.
inline constexpr StrainExtremes kFailedStep{-std::numeric_limits<double>::infinity(),
                                            std::numeric_limits<double>::infinity(), 0};

/// What is known of a method by its name.
struct IntegratorKind {
    std::string_view name;
    int order;     ///< of convergence
    bool implicit; ///< solves for the new state: no step is too long for a linear body
    bool lags;     ///< keeps the velocity of half a step ago
    int forces;    ///< evaluations of the material a step; of an implicit method an iteration
    std::unique_ptr<Integrator> (*make)(std::size_t nodes);
};

/// All methods, the default first.
std::span<const IntegratorKind> integrator_kinds() noexcept;

/// "verlet" is understood as "central-difference".
/// @throws InputError for an unknown name, listing the known ones.
const IntegratorKind& integrator_kind(std::string_view name);

} // namespace ode::soft
