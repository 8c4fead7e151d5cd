#pragma once

#include <vector>

namespace ode::sound {

/// Running integral of a Kaiser-windowed sinc: the low-passed unit step, from 0 to 1.
///
/// A velocity held constant over an interval [t0, t1] contributes velocity *
/// (step(t - t0) - step(t - t1)) to the low-passed velocity at t. Summed over touching intervals of
/// any lengths the steps telescope: a constant passes exactly, however the substeps vary. That is
/// why the integral is tabulated and not the kernel.
///
/// The unit of x is one sample of the grid that the low-passed signal is kept on. Pass band up to
/// 0.25 cycles per sample, stop band from 0.75, 100 dB down.
class StepKernel {
public:
    static constexpr double kHalfWidth = 6.5; ///< step is 0 below minus this, 1 above it

    StepKernel();
    double operator()(double x) const noexcept;

private:
    static constexpr int kPerSample = 64; ///< cubic Hermite at this pitch: error below 1e-8
    std::vector<double> value_;
    std::vector<double> slope_; ///< times pitch
};

/// The one table, made at first use.
const StepKernel& step_kernel();

} // namespace ode::sound
