#include "sink/prediction.h"

#include "signals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ode::sound {
namespace {

// Four damped partials of a bar, continued for as long as a fade lasts. Floats carry 24 bits; what
// they lose is the noise that the fit sees, and 1e-3 of the peak is the mark for clicks.
TEST(FitPredictor, ContinuesRingingModes) {
    const auto bar = [](std::size_t i) {
        const double t = static_cast<double>(i) / 48000;
        double sum = 0;
        for (const double ratio : {1.0, 2.756, 5.404, 8.933})
            sum += std::exp(-20 * ratio * t) *
                   std::sin(test::omega_of(574 * ratio, 1) * t + ratio) / ratio;
        return sum;
    };
    std::vector<float> heard(1024);
    for (std::size_t i = 0; i < heard.size(); ++i)
        heard[i] = static_cast<float>(bar(i));
    const Predictor a = fit_predictor(heard);
    std::vector<double> x(heard.begin(), heard.end());
    for (std::size_t i = heard.size(); i < heard.size() + 2048; ++i) {
        double next = 0;
        for (std::size_t k = 0; k < a.size(); ++k)
            next += a[k] * x[i - 1 - k];
        x.push_back(next);
        ASSERT_NEAR(next, bar(i), test::kMinus60dB) << i;
    }
}

TEST(FitPredictor, HoldsConstantsAndSilence) {
    EXPECT_THAT(fit_predictor(std::vector<float>(1024, 0.0F)), testing::Each(0.0));
    double sum = 0;
    for (const double a : fit_predictor(std::vector<float>(1024, 0.25F)))
        sum += a;
    EXPECT_NEAR(sum, 1, 1e-10); // the ridge: 1e-11
}

TEST(FitPredictor, ForgetsNoise) {
    double power = 0;
    for (const double a : fit_predictor(test::noise(1024)))
        power += a * a;
    EXPECT_LT(power, 0.1); // white noise: each coefficient has a variance of 1/1024
}

} // namespace
} // namespace ode::sound
