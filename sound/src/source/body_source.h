#pragma once

#include "source/patches.h"
#include "source/rigid_sound.h"
#include "source/surface.h"

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <span>

namespace ode::sound {

struct TransferTable;

/// Air moved by the nodes of a surface at one sample of the oversampled grid. Borrowed.
struct FlowBlock {
    std::int64_t sample;     ///< time * grid rate
    int nodes;               ///< multiple of four
    const double* position;  ///< points [m] at that time
    const double* area;      ///< area vectors, points [m^2], of about that time
    const double* softening; ///< square of each node's least distance [m^2]
    const double* flow;      ///< low-passed area . velocity [m^3/s]
    const double* lean;      ///< points [-]; null: the same all round, see Lean
    const double* lean_flow; ///< [m^3/s]
    const Patches* patches;  ///< of the nodes; null: nobody asked for them
    const void* source;      ///< whose it is: the BodySource
    double gain;             ///< 1, or a part while the source crosses over to another place
};

/// Triangles at one audio sample as P01 3.2 leaves them. Borrowed.
struct FacetBlock {
    std::int64_t sample; ///< time * audio rate
    int facets;
    const double* facet;              ///< kFields doubles each
    const Patches* patches = nullptr; ///< of the facets
    const void* source = nullptr;     ///< whose it is: the BodySource
    double gain = 1.0;                ///< of the body
    /// pressure [Pa], area [m^2], centre x y z [m], unit normal x y z
    static constexpr int kFields = 8;
};

/// Modes of a body at one sample of the oversampled grid. Borrowed.
struct ModalBlock {
    std::int64_t sample;      ///< time * grid rate
    Eigen::Vector3d center;   ///< of the body's frame at that time [m]
    Eigen::Matrix3d rotation; ///< from the frame to the world
    std::span<const float> amplitude, rate;
    const TransferTable* table; ///< how they sound, in the frame
    const void* voice;          ///< tells voices apart
    double gain;
    const void* source = nullptr;      ///< of the body's surface, by which it is known to be hidden
    const RigidSound* rigid = nullptr; ///< null: the body as a whole is silent
    RigidSound::Six velocity = RigidSound::Six::Zero(); ///< of the body, in its frame
    RigidSound::Six slope = RigidSound::Six::Zero();    ///< its derivative
};

/// How a body moves as a whole, told as columns of its own before those of the modes: RigidSound's
/// D V is `share` U + W, U what blows have given, forgotten at the rate `forget`, W what the air
/// round the body makes of it.
struct ClickColumns {
    static constexpr int kCount = 6; ///< W along x y z, then U
    double share = 0.0;              ///< [-]
    double forget = 0.0;             ///< [1/s]
    double radius = 0.0;             ///< of the sphere that the body is likened to [m]
    double speed = 343.0;            ///< of sound [m/s]
    double omega = 0.0, decay = 0.0; ///< of W [rad/s], [1/s]
    /// What a blow of 1 gives W, W' and U that is spread over a sample, half of it before: at the
    /// sample, and beside what goes on from there at the next. Told at once, what the air makes of
    /// it would be sampled where it changes within one, and the sum of samples isn't the integral.
    struct Hold {
        double q = 0.0, v = 0.0, u = 0.0;
    };
    Hold hold[2];
};

/// A struck body at successive samples of the grid. Borrowed. What is the same for all samples of a
/// run is worked out once.
struct ModalRun {
    static constexpr int kMost = 80; ///< samples
    std::int64_t sample;             ///< the first, on the grid
    int samples;
    int columns;                   ///< of the rows: modes, and silent ones up to kModeLanes
    const float *amplitude, *rate; ///< rows, one a sample
    Eigen::Vector3d center, pace;  ///< at the first sample [m], and its change a sample
    Eigen::Matrix3d rotation;      ///< from the frame to the world
    const TransferTable* table;
    const void* voice;
    double gain, gain_step;    ///< at the first sample, and its change a sample
    int every;                 ///< samples of the grid from one to the next
    const ClickColumns* click; ///< the leading columns
};

/// Takes what sources give off, in order of time for each source.
class BlockSink {
public:
    virtual ~BlockSink() = default;
    virtual void on_flow(const FlowBlock& block) noexcept = 0;
    virtual void on_facets(const FacetBlock& block) noexcept = 0;
    virtual void on_modes(const ModalBlock&) noexcept {}
    virtual void on_modal_run(const ModalRun&) noexcept {}
};

/// The sounding surface of one body. Stepping thread; allocates at the first view alone.
class BodySource {
public:
    virtual ~BodySource() = default;

    /// Next substep. A gap in time before it means that the body was asleep.
    /// @return whether the surface was gathered (not every substep need be).
    virtual bool push(const SurfaceView& view, BlockSink& out) = 0;

    /// No substep of this body will come before `time` [s]. A body that has delivered less falls
    /// silent without a click.
    virtual void advance_to(double time, BlockSink& out) = 0;

    /// Groups of what the blocks carry, made at the first call, and their middles as last seen [m].
    /// After the first push().
    virtual const Patches& patches(std::span<std::array<double, 3>> centre) = 0;

    /// Latest that it gives off a sample after the sample's own time; never less than it was
    /// [samples of the grid].
    virtual int lag() const noexcept = 0;

    /// When it last moved as nothing stable does, see GrowthWatch [s]; -HUGE_VAL: never.
    virtual double grown_at() const noexcept { return -HUGE_VAL; }

    /// Nothing more will come of it until the next push().
    virtual bool is_silent() const noexcept = 0;
};

} // namespace ode::sound
