#include "source/growth_watch.h"

#include "dsp/kernels.h"
#include "source/flow_history.h"

#include <algorithm>
#include <cmath>

namespace ode::sound {
namespace {

// What alternates may do so up to 2; the rest is for rounding.
constexpr double kAlternating = 2.002;
// Beyond 1.12 of the critical step energy grows sevenfold a substep and more: each quotient waited
// for costs as much. A single push makes one of up to 4, and then one below 2.
constexpr double kFast = 3.0;
// Pushes that set in grow in one direction, but not so fast for so long.
constexpr double kSwelling = 6.0;
constexpr double kEven = 0.02; // intervals are of equal length

} // namespace

bool GrowthWatch::look(FlowHistory& history, bool like) noexcept {
    const double length = history.duration(0);
    since_ += length;
    known_ = like ? std::min(known_ + 1, kRows) : 1;
    if (known_ < kRows || history.size() < kRows || since_ < kPitch)
        return false;
    const double* row[kRows];
    for (int age = 0; age < kRows; ++age) {
        if (std::abs(history.duration(age) - length) > kEven * length)
            return false;
        row[age] = history.volume(age);
    }
    since_ = 0.0;
    double own[4], next[4]; // a_i . a_i, a_i . a_(i+1); a_0 is the newest
    kernels().differences(history.nodes(), row, own, next);
    if (!(own[3] > floor_))
        return false;
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (int i = 0; i < 3; ++i) {
        if (!(own[i] > own[i + 1]))
            return false;
        const double quotient = -(next[i] + next[i + 1]) / own[i + 1];
        least = std::min(least, quotient);
        most = std::max(most, quotient);
        if (i == 1 && least > kFast)
            return true;
    }
    return least > kAlternating || most < -kSwelling;
}

} // namespace ode::sound
