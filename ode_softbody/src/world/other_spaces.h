#pragma once

#include <ode/common.h>

#include <vector>

namespace ode::soft {

/// Spaces other than a soft world's own, and geoms without one, that the application has collided
/// its bodies with since the last step. Geoms come and go between collision and step, so what was
/// met is looked up anew before the step; of these ids, which can't be looked up, the end is told
/// by forget_space(). Any thread.
class OtherSpaces {
public:
    OtherSpaces() = default;
    ~OtherSpaces();
    OtherSpaces(const OtherSpaces&) = delete;
    OtherSpaces& operator=(const OtherSpaces&) = delete;

    void add(dGeomID soft, dGeomID space_or_geom);
    void clear() noexcept;
    /// Makes each soft geom meet what was added for it.
    void collide() const noexcept;

private:
    friend void forget_space(dGeomID) noexcept;
    struct Pair {
        dGeomID soft;
        dGeomID other;
    };
    std::vector<Pair> pair_;
};

/// The application destroys a geom or space. Costs one atomic load while nothing is kept.
void forget_space(dGeomID space_or_geom) noexcept;

} // namespace ode::soft
