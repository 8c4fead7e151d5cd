#pragma once

#include "fingerprint.h"

namespace ode::conformance {

/// What a demo has drawn so far.
class Picture {
public:
    /// Colour and texture of what is drawn next.
    void set_colour(float r, float g, float b, float a) noexcept;
    void set_texture(int number) noexcept { texture_ = number; }
    /// A thing, with all numbers in the call that drew it.
    void draw(Fingerprint thing) noexcept;
    void begin_frame() noexcept;
    void end_frame() noexcept;

    unsigned long things() const noexcept { return things_; }
    /// Of what there was to see in each frame, whatever was drawn first.
    std::uint64_t seen() const noexcept { return seen_.value(); }
    /// Of the calls in their order.
    std::uint64_t sequence() const noexcept { return sequence_.value(); }

private:
    float colour_[4] = {1, 1, 1, 1};
    int texture_ = 0;
    unsigned long things_ = 0;
    std::uint64_t frame_ = 0; ///< sum over its things
    Fingerprint seen_, sequence_;
};
Picture& picture() noexcept;

} // namespace ode::conformance
