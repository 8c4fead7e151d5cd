#pragma once

#include "source/patches.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ode::sound {

/// Which patches of one body the two ears of one listener see (delta of P01 eq. 10), faded.
class Shade {
public:
    static constexpr int kEars = 2;
    static constexpr double kFade = 0.02; ///< [s] from seen to hidden

    /// What a ray found. Two in a row that say the same are believed: an edge that trembles before
    /// an ear doesn't flutter.
    void see(int ear, int patch, bool visible) noexcept {
        Patch& p = patch_[ear][patch];
        if (visible == p.last)
            p.wanted = visible ? 1.0 : 0.0;
        p.last = visible;
        clear_ = clear_ && p.wanted == 1.0;
    }

    /// Goes to a sample; asking for one twice is harmless. @param rate  of samples [Hz].
    /// @param samples  since the last.
    void advance(std::int64_t sample, double rate, int samples = 1) noexcept;

    /// Whether everything is seen.
    bool is_clear() const noexcept { return clear_; }
    /// Part of the patches that an ear sees. For rules that count all faces: to hide some of them
    /// would undo that front and back cancel, and a body in flight would thump.
    double share(int ear) const noexcept;
    void set_patches(int count) noexcept; ///< that are looked at
    double gain(int ear, int patch) const noexcept { return patch_[ear][patch].now; }

    /// `from` as the ear gets it: times its patch's gain. Allocates at the first call.
    const double* scaled(int ear, const Patches& patches, const double* from);

private:
    struct Patch {
        double wanted = 1.0;
        double now = 1.0;
        bool last = true;
    };
    Patch patch_[kEars][Patches::kMost];
    bool clear_ = true;
    int patches_ = Patches::kMost;
    std::int64_t sample_ = INT64_MIN;
    std::vector<double> scaled_;
};

} // namespace ode::sound
