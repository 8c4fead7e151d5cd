#pragma once

#include "base/types.h"
#include "reduced/cubic_rows.h"
#include "reduced/pair_order.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace ode::soft {

/// What a body's energy has beyond its linear oscillators, as a polynomial of its amplitudes:
///
///     V = sum a_ijk q_i q_j q_k + sum b_ijkl q_i q_j q_k q_l + sum c_ijm q_i q_j r_m,
///
/// q of its first modes, which are kept non-linear; r of further ones, which these drive and which
/// act back. What else answers does so at once, as if it had no mass: its share is in b, and it
/// moves along. (Left out instead, it would make the body stiffer than the linear one is.)
///
/// Monomials of sorted indices, each once: rows of single numbers, each a beginning of the row of
/// products (PairOrder), of which one pass makes energy and gradient. Fewer active modes leave
/// beginnings of these: a, then, has no two indices beyond them and b none, so that the other kept
/// modes are driven like r.
class CubicTerms {
public:
    static constexpr std::size_t kLanes = kRowLanes;

    /// Coefficients, in the order of PairOrder.
    struct Coefficients {
        PairOrder order;
        std::size_t driven = 0;     ///< modes r
        Eigen::MatrixXd cubic;      ///< q_i times the product of a pair, summed over all of them
        Eigen::MatrixXd quartic;    ///< product times product, likewise
        Eigen::MatrixXd driving;    ///< one row a driven mode: r_m times the product of a pair
        Eigen::MatrixXd following;  ///< one row a shape: how far products move it
        std::vector<double> shape;  ///< x y z of each node, shape after shape
        std::vector<double> follow; ///< typical frequency of each shape [rad/s]
    };
    /// What is heard of the body: its audible modes and what follows, by rising frequency. How what
    /// follows decays is of no account, it is told of anew all the time.
    struct Sounding {
        std::vector<int> order;           ///< mode, or number of audible modes plus shape
        std::vector<double> omega, decay; ///< [rad/s], [1/s]
        std::vector<float> shape;         ///< row 3 n + axis of all these
    };
    /// @param unit  amplitude that single precision is scaled by, about a thickness
    ///              [kg^1/2 m].
    CubicTerms(const Coefficients& from, double unit);

    std::size_t kept() const noexcept { return order_.modes; }
    std::size_t moved() const noexcept { return order_.modes + driven_; } ///< kept and driven
    std::size_t following() const noexcept { return follow_.size(); }     ///< shapes
    std::size_t columns() const noexcept { return columns_; } ///< following(), whole lanes
    /// How many modes may be active, rising to kept().
    std::size_t levels() const noexcept { return level_.size(); }
    std::size_t active(std::size_t level) const noexcept { return level_[level].active; }
    std::size_t entries(std::size_t level) const noexcept { return level_[level].entries; }

    /// Scratch of one body.
    struct Work {
        AlignedVector<float> source, by, answer, sum;
    };
    Work make_work() const;

    /// @param level      how many modes are active; the others are driven
    /// @param amplitude  of moved() modes.
    /// @param force      minus the gradient [N kg^-1/2].
    /// @return the energy [J].
    double evaluate(std::size_t level, std::span<const double> amplitude, std::span<double> force,
                    Work& work) const noexcept;

    /// What a push at what follows does to the kept modes: adds it to `force`, in its unit.
    /// @param push  at each shape, columns()
    void add_push(std::span<const double> amplitude, std::span<const double> push,
                  std::span<double> force, Work& work) const noexcept;

    /// How far what follows has moved, and how fast.
    /// @param amplitude, rate  of the kept modes
    /// @param place, speed     columns(), in units of shape
    void follow(std::span<const double> amplitude, std::span<const double> rate,
                std::span<double> place, std::span<double> speed, Work& work) const noexcept;
    /// Row 3 n + axis of columns(), as ModalBasis::shape.
    std::span<const float> shape() const noexcept { return shape_; }
    const float* row(std::size_t node) const noexcept {
        return shape_.data() + 3 * node * columns_;
    }
    std::span<const double> follow_frequency() const noexcept { return follow_; } ///< [rad/s]

    const Sounding& sounding() const noexcept { return sounding_; }
    void set_sounding(Sounding sounding) { sounding_ = std::move(sounding); }

private:
    /// Up to four rows of one length, one after another.
    struct Group {
        std::vector<std::uint32_t> source; ///< what each row is multiplied by
        std::uint32_t registers;
        std::uint32_t greatest; ///< index in the first row, one more in each further one; kNone
        std::size_t offset;     ///< [floats]
    };
    static constexpr std::uint32_t kNone = ~0u; ///< whose rows are used whatever is active
    struct Level {
        std::size_t active;
        std::vector<RowBlock> block;
        std::vector<std::uint32_t> source; ///< of all their rows
        std::size_t single = 0;            ///< of these, the first ones, are amplitudes
        std::size_t entries = 0;           ///< multiplied
    };
    Group add_group(std::uint32_t greatest, std::vector<std::uint32_t> source, std::size_t entries,
                    const std::function<double(std::size_t row, std::size_t entry)>& value);
    void add_level(std::size_t active, std::span<const Group> groups);
    void add_slope(std::size_t active, double sign, std::span<double> force,
                   const Work& work) const noexcept;
    void fill(std::size_t active, std::span<const double> amplitude, Work& work) const noexcept;

    PairOrder order_;
    std::size_t driven_, pairs_; ///< pairs_: whole lanes
    std::size_t first_pair_;     ///< where products begin in `source`
    double scale_;               ///< one over the unit
    std::vector<Level> level_;
    AlignedVector<float> coefficient_;
    AddRows add_rows_;
    std::size_t columns_;
    AlignedVector<float> follow_row_; ///< pairs_ each
    AlignedVector<float> shape_;
    std::vector<double> follow_;
    Sounding sounding_;
};

} // namespace ode::soft
