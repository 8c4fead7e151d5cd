#include "path/shade.h"

#include <algorithm>

namespace ode::sound {

void Shade::advance(std::int64_t sample, double rate) noexcept {
    if (clear_ || sample == sample_)
        return;
    const double passed =
        sample_ == INT64_MIN || sample < sample_ ? 1.0 : static_cast<double>(sample - sample_);
    sample_ = sample;
    const double step = passed / (kFade * rate);
    bool clear = true;
    for (auto& ear : patch_)
        for (Patch& p : ear) {
            p.now += std::clamp(p.wanted - p.now, -step, step);
            clear = clear && p.now == 1.0 && p.wanted == 1.0;
        }
    clear_ = clear;
}

double Shade::share(int ear) const noexcept {
    double sum = 0.0;
    for (int p = 0; p < patches_; ++p)
        sum += patch_[ear][p].now;
    return sum / patches_;
}

const double* Shade::scaled(int ear, const Patches& patches, const double* from) {
    scaled_.resize(patches.of.size());
    for (std::size_t i = 0; i < scaled_.size(); ++i)
        scaled_[i] = from[i] * patch_[ear][patches.of[i]].now;
    return scaled_.data();
}

} // namespace ode::sound
