#include "softsound/impacts.h"

#include <limits>

namespace softsound {
namespace {
// An observer may not allocate: more impacts than this are counted by nobody.
constexpr std::size_t kMost = 4096;
} // namespace

Impacts::Impacts(dSoftWorldID world, dSoftBodyID body, double flight)
    : world_(world), body_(body), flight_(flight),
      last_contact_(-std::numeric_limits<double>::infinity()) {
    times_.reserve(kMost);
    dSoftWorldAddSubstepObserver(world_, on_substep, this);
}

Impacts::~Impacts() { dSoftWorldRemoveObserver(world_, this); }

void Impacts::on_substep(void* self, const dSoftSubstep* substep) {
    auto& impacts = *static_cast<Impacts*>(self);
    if (substep->body != impacts.body_)
        return;
    dSoftStatus status = {};
    status.struct_size = sizeof status;
    if (!dSoftBodyGetStatus(impacts.body_, &status) || status.contact_points == 0)
        return;
    if (substep->time - impacts.last_contact_ > impacts.flight_ && impacts.times_.size() < kMost)
        impacts.times_.push_back(substep->time);
    impacts.last_contact_ = substep->time;
}

} // namespace softsound
