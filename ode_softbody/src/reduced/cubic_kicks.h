#pragma once

#include "reduced/cubic_terms.h"

#include <memory>
#include <span>

namespace ode::soft {

/// What isn't linear of a body's modes, between the exact steps of its oscillators: impulses at the
/// ends of intervals, half of one's own at either end (Strang's splitting, symplectic for intervals
/// of one length). Substeps of contact are shorter: several share an interval.
///
/// Impulses at distance T move an oscillator that they only carry along by (w T / 2) cot(w T / 2)
/// of the way that a steady force would. So each mode's coordinate and its force are multiplied by
/// the root of its inverse (a mollified impulse: Garcia-Archilla, Sanz-Serna and Skeel, SIAM J.
/// Sci. Comput. 20, 1998, doi:10.1137/S1064827596313851): both are derivatives of one energy still,
/// and what a driven mode gives back to those that drive it is what it would at rest.
class CubicKicks {
public:
    /// @param omega  of the modes that the terms move [rad/s].
    CubicKicks(std::shared_ptr<const CubicTerms> terms, std::span<const double> omega);

    const CubicTerms& terms() const noexcept { return *terms_; }
    const std::shared_ptr<const CubicTerms>& shared_terms() const noexcept { return terms_; }
    /// No longer interval, and so no longer substep [s].
    double longest() const noexcept { return longest_; }

    /// Amplitudes were put somewhere else: nothing is known of them.
    void restart() noexcept {
        length_ = 0;
        known_ = false;
        widen();
    }
    /// All kept modes are active again: a push may move any. Left alone, the first few that make
    /// the force to within two hundredths are found out by looks, and the others are driven.
    void widen() noexcept;
    /// A steady load on what follows. @param push  at each shape, terms().columns(); copied
    void set_load(std::span<const double> push) noexcept;
    /// Before a substep. @param rate  gains the impulse where an interval begins.
    void begin(double dt, std::span<const double> amplitude, std::span<double> rate) noexcept;
    /// After it. @param rate  gains the impulse where one ends.
    void end(double dt, std::span<const double> amplitude, std::span<double> rate) noexcept;
    /// Ends an interval early, so that rates are those of this moment.
    void close(std::span<const double> amplitude, std::span<double> rate) noexcept;
    /// Within an interval rates are those of this moment less this time of force() [s].
    double lag() const noexcept { return length_ > 0 ? done_ - length_ / 2 : 0; }
    std::span<const double> force() const noexcept { return force_; } ///< when last looked at

    std::size_t entries() const noexcept { return terms_->entries(level_); } ///< of a look
    double energy() const noexcept { return energy_; } ///< when last looked at [J]

    void keep() noexcept;
    void take_back() noexcept;

private:
    void look(std::span<const double> amplitude) noexcept;
    void choose_level() noexcept;
    /// Of the force, by as much as that would move. Spoils force_.
    double left_out(std::size_t level) noexcept;
    void set_length(double length) noexcept;

    std::shared_ptr<const CubicTerms> terms_;
    CubicTerms::Work work_;
    std::size_t level_;          ///< of active modes
    int unasked_ = 0, calm_ = 0; ///< looks without a question; answers for fewer
    std::vector<double> whole_;  ///< force_ of all kept modes
    std::vector<double> load_;
    bool loaded_ = false;
    std::vector<double> omega_, filter_, filtered_, force_;
    double longest_;
    double filter_length_ = 0; ///< that filter_ is of [s]
    double length_ = 0;        ///< of the interval; 0: between two [s]
    double done_ = 0;          ///< of it [s]
    double energy_ = 0;
    bool known_ = false; ///< force_ is that of the present amplitudes
    struct Kept {
        std::vector<double> force;
        double filter_length = 0, length = 0, done = 0, energy = 0;
        bool known = false;
        std::size_t level = 0;
        int unasked = 0, calm = 0;
    } kept_;
};

} // namespace ode::soft
