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
    dSoftObserver observer = {};
    observer.struct_size = sizeof observer;
    observer.data = this;
    observer.on_substep = [](void* self, const dSoftSubstep* substep) {
        static_cast<Impacts*>(self)->look(substep->body, substep->time);
    };
    observer.on_modal = [](void* self, const dSoftModalState* state) {
        static_cast<Impacts*>(self)->look(state->body, state->time);
    };
    dSoftWorldAddObserver(world_, &observer);
}

Impacts::~Impacts() { dSoftWorldRemoveObserver(world_, this); }

void Impacts::look(dSoftBodyID body, double time) {
    if (body != body_)
        return;
    dSoftStatus status = {};
    status.struct_size = sizeof status;
    if (!dSoftBodyGetStatus(body_, &status) || status.contact_points == 0)
        return;
    if (time - last_contact_ > flight_ && times_.size() < kMost)
        times_.push_back(time);
    last_contact_ = time;
}

} // namespace softsound
