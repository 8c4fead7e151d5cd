#include "strike/scrape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ode::sound {

Scrape::Scrape(std::array<std::shared_ptr<const Roughness>, 2> surface, double rate)
    : surface_(std::move(surface)), rate_(rate) {}

void Scrape::aim(const ScrapeAim& aim) noexcept {
    if (!begun_)
        speed_ = aim.speed;
    begun_ = true;
    aim_ = aim;
    // Bilinear, right at the resonance; one that is faster than the rate carries is at its end.
    const double most = 0.9 * std::numbers::pi * rate_;
    const double w = std::min(std::sqrt(aim.stiffness / aim.mass), most);
    const double g = std::tan(0.5 * w / rate_), d = 2.0 * aim.damping * g;
    take_ = 1.0 / (1.0 + d + g * g);
    back_[0] = 2.0 * (g * g - 1.0) * take_;
    back_[1] = (1.0 - d + g * g) * take_;
}

void Scrape::run(int samples, float* force) noexcept {
    const double per = 1.0 / samples, lapse = 1.0 / rate_;
    const double load_step = per * (aim_.load - load_);
    std::array<double, 2> speed_step;
    for (std::size_t s = 0; s < 2; ++s)
        speed_step[s] = per * (aim_.speed[s] - speed_[s]);
    bool stands[2];
    double held[2] = {};
    for (std::size_t s = 0; s < 2; ++s) {
        stands[s] = speed_[s] == 0.0 && aim_.speed[s] == 0.0;
        if (stands[s])
            held[s] = surface_[s]->mean(place_[s], 2.0 * aim_.radius);
    }
    for (int i = 0; i < samples; ++i) {
        double y = 0.0;
        for (std::size_t s = 0; s < 2; ++s) {
            if (stands[s]) { // what doesn't change is filtered away
                y += held[s];
                continue;
            }
            speed_[s] += speed_step[s];
            const double way = lapse * speed_[s];
            place_[s] += way;
            y += surface_[s]->mean(place_[s], std::max(2.0 * aim_.radius, way));
        }
        const double out = take_ * y + kept_[0];
        kept_[0] = -2.0 * take_ * y - back_[0] * out + kept_[1];
        kept_[1] = take_ * y - back_[1] * out;
        load_ += load_step;
        const double u = aim_.stiffness * out, square = load_ * load_ + u * u;
        force[i] = square > 0.0 ? static_cast<float>(load_ * u / std::sqrt(square)) : 0.0f;
    }
    load_ = aim_.load;
    speed_ = aim_.speed;
    for (std::size_t s = 0; s < 2; ++s)
        place_[s] -= surface_[s]->period() * std::floor(place_[s] / surface_[s]->period());
}

} // namespace ode::sound
