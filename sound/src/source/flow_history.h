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
    void clear() noexcept { size_ = 0; }

    /// Opens an interval [s] in place of the oldest. @return its volumes [m^3], to be filled in.
    double* push(double begin, double end, bool quiet) noexcept;

    /// @param age  0 for the newest.
    double* volume(int age) noexcept { return rows_.data() + slot(age) * nodes_; }
    double duration(int age) const noexcept { return end_[slot(age)] - begin_[slot(age)]; }

    /// Low-passed flow [m^3/s] at `first`, `first + spacing`, ... [s], four of them.
    /// @param stretch  kernel width in units of `spacing`: StepKernel's own at 1.
    /// @return false, and nothing written, where nothing moved.
    bool low_pass(double first, double spacing, double stretch, double* const flow[4]);

private:
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
    std::vector<const double*> row_;
    std::vector<double> weight_;
};

} // namespace ode::sound
