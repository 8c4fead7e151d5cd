#pragma once

#include "dsp/storage.h"

#include <vector>

namespace ode::sound {

/// The last intervals of a surface's motion: volume swept by every node in each.
///
/// Kept as they came, at their own times; low-passing happens when an output is due. That costs
/// one read of the history for four outputs, where pushing every interval into accumulators of 13
/// outputs would read and write all of them each time.
class FlowHistory {
public:
    FlowHistory(int nodes, int intervals);

    int capacity() const noexcept { return static_cast<int>(begin_.size()); }
    void reserve(int intervals); ///< keeps what is there; allocates
    int size() const noexcept { return size_; }
    int nodes() const noexcept { return static_cast<int>(nodes_); }
    void clear() noexcept { size_ = 0; }

    /// Opens an interval [s] in place of the oldest. @return its volumes [m^3], to be filled in.
    double* push(double begin, double end, bool quiet) noexcept;

    /// @param age  0 for the newest.
    double* volume(int age) noexcept { return rows_.data() + slot(age) * nodes_; }
    double duration(int age) const noexcept { return end_[slot(age)] - begin_[slot(age)]; }

    /// Of the four outputs each interval counts by the kernel's integral over it: exact for a flow
    /// that is constant there. Where intervals differ in length, or are long, the flow's slope
    /// counts, too, by the kernel's first moment; it is taken from the intervals on both sides.
    /// Without that uneven substeps would modulate ultrasound into noise, 65 dB down.
    void set_sloped(bool on) noexcept { sloped_ = on; }

    /// Low-passed flow [m^3/s] at `first`, `first + spacing`, ... [s], four of them.
    /// @param stretch  kernel width in units of `spacing`: StepKernel's own at 1.
    /// @return false, and nothing written, where nothing moved.
    bool low_pass(double first, double spacing, double stretch, double* const flow[4]);

private:
    void add_slopes(int rows) noexcept;

    std::size_t slot(int age) const noexcept {
        const std::size_t n = begin_.size();
        return (newest_ + n - static_cast<std::size_t>(age)) % n;
    }

    std::size_t nodes_;
    int size_ = 0;
    std::size_t newest_ = 0;
    AlignedVector rows_;
    std::vector<double> begin_;
    std::vector<double> end_;
    std::vector<char> quiet_;
    bool sloped_ = false;
    std::vector<const double*> row_;
    std::vector<double> weight_;
    std::vector<double> moment_; ///< of the kernel over each row's interval, about its middle
    std::vector<double> middle_; ///< of each row's interval [s]
    std::vector<double> length_; ///< [s]
};

} // namespace ode::sound
