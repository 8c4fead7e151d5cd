#include "api/guard.h"
#include "api/ids.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace ode::sound {
namespace {

/// Which listener has a sink. Worlds may be stepped by different threads; sinks may be handed
/// about.
struct Owners {
    std::mutex mutex;
    std::unordered_map<const Sink*, Listener*> of;
};

Owners& owners() {
    static Owners all;
    return all;
}

Vec3 from_c(const dReal* v) { return {v[0], v[1], v[2]}; }

} // namespace

void let_go(Sink& sink) noexcept {
    const std::lock_guard lock(owners().mutex);
    const auto at = owners().of.find(&sink);
    if (at == owners().of.end())
        return;
    at->second->remove_sink(sink);
    owners().of.erase(at);
}

} // namespace ode::sound

using namespace ode::sound;

dxSoundListener::~dxSoundListener() {
    const std::lock_guard lock(owners().mutex);
    std::erase_if(owners().of, [this](const auto& pair) { return pair.second == listener; });
}

dSoundListenerID dSoundListenerCreate(dSoundWorldID world) {
    require_id(world, "dSoundListenerCreate");
    return guarded("dSoundListenerCreate", dSoundListenerID{}, [&] {
        auto id = std::make_unique<dxSoundListener>();
        world->listeners.reserve(world->listeners.size() + 1);
        id->owner = world;
        id->listener = &world->world.add_listener();
        world->listeners.push_back(id.get());
        return id.release();
    });
}

void dSoundListenerDestroy(dSoundListenerID listener) {
    require_id(listener, "dSoundListenerDestroy");
    dSoundWorldID world = listener->owner;
    std::erase(world->listeners, listener);
    Listener* own = listener->listener;
    delete listener; // lets sinks go, which still name the listener
    world->world.remove_listener(*own);
}

int dSoundListenerSetPosition(dSoundListenerID listener, dReal x, dReal y, dReal z) {
    require_id(listener, "dSoundListenerSetPosition");
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
        dMessage(0, "dSoundListenerSetPosition: (%g, %g, %g) is no place; it stays where it is", x,
                 y, z);
        return 0;
    }
    listener->listener->pose.centre = {x, y, z};
    return 1;
}

int dSoundListenerSetOrientation(dSoundListenerID listener, const dVector3 at, const dVector3 up) {
    require_id(listener, "dSoundListenerSetOrientation");
    if (!listener->listener->pose.orient(from_c(at), from_c(up))) {
        dMessage(0,
                 "dSoundListenerSetOrientation: at (%g, %g, %g) and up (%g, %g, %g) span no plane; "
                 "give two directions that are not parallel",
                 at[0], at[1], at[2], up[0], up[1], up[2]);
        return 0;
    }
    return 1;
}

int dSoundListenerSetEarDistance(dSoundListenerID listener, dReal distance) {
    require_id(listener, "dSoundListenerSetEarDistance");
    if (!std::isfinite(distance) || distance < 0.0) {
        dMessage(0, "dSoundListenerSetEarDistance: distance is %g m; it must be 0 or more",
                 distance);
        return 0;
    }
    listener->listener->pose.ear_distance = distance;
    return 1;
}

int dSoundListenerAddSink(dSoundListenerID listener, dSoundSinkID sink) {
    require_id(listener, "dSoundListenerAddSink");
    require_id(sink, "dSoundListenerAddSink");
    return guarded("dSoundListenerAddSink", 0, [&] {
        Sink& own = sink_of(sink);
        {
            const std::lock_guard lock(owners().mutex);
            const auto at = owners().of.find(&own);
            if (at != owners().of.end() && at->second != listener->listener) {
                dMessage(0, "dSoundListenerAddSink: the sink serves another listener; one sink "
                            "serves one listener");
                return 0;
            }
            owners().of.emplace(&own, listener->listener);
        }
        if (listener->listener->add_sink(own))
            return 1;
        let_go(own);
        dMessage(0, "dSoundListenerAddSink: %s", own.error());
        return 0;
    });
}

int dSoundListenerSetSink(dSoundListenerID listener, dSoundSinkID sink) {
    require_id(listener, "dSoundListenerSetSink");
    return guarded("dSoundListenerSetSink", 0, [&] {
        const std::vector<Sink*> had = listener->listener->sinks();
        for (Sink* old : had)
            if (!sink || old != &sink_of(sink))
                let_go(*old);
        return sink ? dSoundListenerAddSink(listener, sink) : 1;
    });
}
