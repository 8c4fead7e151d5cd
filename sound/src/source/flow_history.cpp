#include "source/flow_history.h"

#include "dsp/kernels.h"
#include "dsp/step_kernel.h"

#include <algorithm>
#include <utility>

namespace ode::sound {

FlowHistory::FlowHistory(int nodes, int intervals)
    : nodes_(static_cast<std::size_t>(nodes)), rows_(nodes_ * static_cast<std::size_t>(intervals)),
      begin_(static_cast<std::size_t>(intervals)), end_(begin_), quiet_(begin_.size()),
      row_(begin_.size()), weight_(4 * begin_.size()), moment_(weight_.size()),
      middle_(begin_.size()), length_(begin_.size()) {}

void FlowHistory::reserve(int intervals) {
    if (intervals <= capacity())
        return;
    FlowHistory larger(static_cast<int>(nodes_), intervals);
    larger.sloped_ = sloped_;
    for (int age = size_ - 1; age >= 0; --age) {
        const std::size_t i = slot(age);
        std::copy_n(volume(age), nodes_, larger.push(begin_[i], end_[i], quiet_[i] != 0));
    }
    *this = std::move(larger);
}

double* FlowHistory::push(double begin, double end, bool quiet) noexcept {
    newest_ = (newest_ + 1) % begin_.size();
    if (size_ < capacity())
        ++size_;
    begin_[newest_] = begin;
    end_[newest_] = end;
    quiet_[newest_] = quiet;
    return volume(0);
}

bool FlowHistory::low_pass(double first, double spacing, double stretch, double* const flow[4]) {
    const StepKernel& step = step_kernel();
    const double reach = StepKernel::kHalfWidth * stretch * spacing;
    const double per_second = 1.0 / (stretch * spacing);
    double before[4] = {}; // step at the beginning of the interval
    double seam = 0.0;     // where `before` was taken
    int rows = 0;
    bool quiet = true;
    for (int age = size_ - 1; age >= 0; --age) {
        const std::size_t i = slot(age);
        if (end_[i] <= first - reach || begin_[i] >= first + 3.0 * spacing + reach)
            continue;
        quiet = quiet && quiet_[i];
        const bool touching = rows > 0 && begin_[i] == seam;
        const double scale = 1.0 / (end_[i] - begin_[i]);
        double* weight = weight_.data() + 4 * rows;
        for (int j = 0; j < 4; ++j) {
            const double at = first + j * spacing;
            const double old = touching ? before[j] : step((at - begin_[i]) * per_second);
            before[j] = step((at - end_[i]) * per_second);
            weight[j] = (old - before[j]) * scale;
            if (sloped_) { // Simpson's rule for the integral of the step
                const double half = step((at - 0.5 * (begin_[i] + end_[i])) * per_second);
                moment_[static_cast<std::size_t>(4 * rows + j)] =
                    (half - 0.5 * (old + before[j])) * (2.0 / 3.0) / scale;
            }
        }
        middle_[static_cast<std::size_t>(rows)] = 0.5 * (begin_[i] + end_[i]);
        length_[static_cast<std::size_t>(rows)] = end_[i] - begin_[i];
        seam = end_[i];
        row_[static_cast<std::size_t>(rows++)] = rows_.data() + i * nodes_;
    }
    if (quiet)
        return false;
    if (sloped_)
        add_slopes(rows);
    kernels().mix(static_cast<int>(nodes_), rows, row_.data(), weight_.data(), flow);
    return true;
}

void FlowHistory::add_slopes(int rows) noexcept {
    for (std::size_t r = 1; r + 1 < static_cast<std::size_t>(rows); ++r) {
        const double way = middle_[r + 1] - middle_[r - 1];
        const double touching = 0.5 * (length_[r - 1] + length_[r + 1]) + length_[r];
        if (way > 1.001 * touching) // a gap: nothing is known of the slope
            continue;
        for (std::size_t j = 0; j < 4; ++j) {
            const double m = moment_[4 * r + j] / way;
            weight_[4 * (r + 1) + j] += m / length_[r + 1];
            weight_[4 * (r - 1) + j] -= m / length_[r - 1];
        }
    }
}

} // namespace ode::sound
