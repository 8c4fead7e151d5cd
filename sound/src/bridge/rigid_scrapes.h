#pragma once

#include "bridge/contact_sides.h"
#include "source/struck_voice.h"
#include "strike/scrape.h"

#include <deque>
#include <functional>
#include <span>
#include <vector>

namespace ode::sound {

struct RigidBody;

/// Two bodies that bear on each other in a step, at one place that stands for all they touch at.
struct Bearing {
    RigidBody* side[2];  ///< null: has no voice
    const void* partner; ///< what the first with a voice touches
    RigidTouch touch;    ///< position, normal and impulse those of all together
    double load = 0.0;   ///< along the normal [N]
};

/// Contacts that slide or roll, from step to step: they drive the voices of both bodies.
class RigidScrapes {
public:
    using Voice = std::function<StruckVoice&(RigidBody&)>;

    /// One contact of a step, load and all; those of a pair are added up.
    void bear(const RigidTouch& touch, RigidBody* const side[2], const void* partner, double load);
    /// Voices are driven for the step from `begin` to `end` [s]. Allocates for more contacts, or
    /// longer steps, than ever before.
    void end_step(double begin, double end, double rate, const Geoms& geoms, const Voice& voice);
    void forget(const RigidBody& body) noexcept;

private:
    /// What 1 N s of a contact's force gives a body.
    struct Felt {
        std::vector<float> push;
        RigidSound::Six jerk = RigidSound::Six::Zero();
    };
    struct Contact {
        RigidBody* side[2];
        const void* partner;
        Scrape scrape;
        Felt before[2], now[2]; ///< at the end of the last step, and of this one
        bool seen;
    };
    Contact* find(const Bearing& bearing) noexcept;
    void aim(Contact& contact, const Bearing& bearing, const Travel& travel, const Geoms& geoms);
    /// By so much, since the step before, that the place should not step.
    static bool has_moved(const Contact& contact) noexcept;
    std::span<float> row(std::size_t samples);
    void drive(Contact& contact, bool moved, std::int64_t begin, std::size_t samples, double rate,
               const Voice& voice);

    std::vector<Bearing> bearing_;
    std::vector<Contact> contact_;
    std::deque<std::vector<float>> series_; ///< of this step; the first used_ of them
    std::size_t used_ = 0;
};

} // namespace ode::sound
