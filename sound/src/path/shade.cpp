#include "path/shade.h"

#include <algorithm>

namespace ode::sound {

void Shade::advance(std::int64_t sample, double rate, int samples) noexcept {
    if (clear_ || sample == sample_)
        return;
    sample_ = sample;
    const double step =
        samples / (kFade * rate); // a body that slept meanwhile goes on where it was
    bool clear = true;
    for (auto& ear : patch_)
        for (Patch& p : ear) {
            p.now += std::clamp(p.wanted - p.now, -step, step);
            clear = clear && p.now == 1.0 && p.wanted == 1.0;
        }
    clear_ = clear;
}

void Shade::set_patches(int count) noexcept {
    patches_ = count;
    for (auto& ear : patch_)
        std::fill(ear + count, ear + Patches::kMost, Patch{});
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
