#pragma once

#include "base/types.h"
#include "reduced/pair_order.h"

#include <Eigen/Core>

#include <cstdint>
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
/// products (PairOrder), of which one pass makes energy and gradient.
class CubicTerms {
public:
    static constexpr std::size_t kLanes = 16;

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
    std::size_t entries() const noexcept { return coefficient_.size(); } ///< multiplied to look

    /// Scratch of one body.
    struct Work {
        AlignedVector<float> source, answer, sum;
    };
    Work make_work() const;

    /// @param amplitude  of moved() modes.
    /// @param force      minus the gradient [N kg^-1/2].
    /// @return the energy [J].
    double evaluate(std::span<const double> amplitude, std::span<double> force,
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
        std::uint32_t first, rows, registers;
        std::size_t offset; ///< [floats]
    };
    void add_row(std::uint32_t source, std::size_t entries, std::span<const double> row);
    void add_slope(double sign, std::span<double> force, const Work& work) const noexcept;
    void fill(std::span<const double> amplitude, Work& work) const noexcept;

    PairOrder order_;
    std::size_t driven_, pairs_; ///< pairs_: whole lanes
    std::size_t first_pair_;     ///< where products begin in `source`
    double scale_;               ///< one over the unit
    std::vector<Group> group_;
    std::vector<std::uint32_t> row_source_; ///< what each row is multiplied by
    AlignedVector<float> coefficient_;
    std::size_t columns_;
    AlignedVector<float> follow_row_; ///< pairs_ each
    AlignedVector<float> shape_;
    std::vector<double> follow_;
    Sounding sounding_;
};

} // namespace ode::soft
