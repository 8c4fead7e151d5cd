#pragma once

namespace ode::sound {

/// P01 eq. 9: y_i = (1 - alpha) y_{i-1} + (x_i - x_{i-1}), alpha = 0.1 a sample: a high-pass at
/// about 740 Hz at 44.1 kHz.
class DcBlock {
public:
    static constexpr double kAlpha = 0.1;

    double operator()(double x) noexcept {
        y_ = (1.0 - kAlpha) * y_ + (x - x_);
        x_ = x;
        return y_;
    }

private:
    double x_ = 0.0;
    double y_ = 0.0;
};

} // namespace ode::sound
