#include "api/guard.h"
#include "api/ids.h"
#include "api/sink.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

namespace ode::sound {
namespace {

Vec3 from_c(const dReal* v) { return {v[0], v[1], v[2]}; }

} // namespace

} // namespace ode::sound

using namespace ode::sound;

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
    world->world.remove_listener(*listener->listener);
    delete listener;
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

int dSoundListenerSetEars(dSoundListenerID listener, int ears) {
    require_id(listener, "dSoundListenerSetEars");
    return guarded("dSoundListenerSetEars", 0, [&] {
        if (ears != 1 && ears != 2) {
            dMessage(0, "dSoundListenerSetEars: a listener has 1 or 2 ears, not %d", ears);
            return 0;
        }
        if (listener->listener->set_ears(ears))
            return 1;
        dMessage(0,
                 "dSoundListenerSetEars: the listener's sinks have %d channels already; set "
                 "ears before the first sink",
                 listener->listener->ears());
        return 0;
    });
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

int dSoundListenerGetLevel(dSoundListenerID listener, dSoundLevel* level) {
    require_id(listener, "dSoundListenerGetLevel");
    if (!level || level->struct_size < sizeof(unsigned)) {
        dMessage(0,
                 "dSoundListenerGetLevel: set struct_size to sizeof(dSoundLevel) before the call");
        return 0;
    }
    const Listener::Level heard = listener->listener->take_level();
    dSoundLevel all{};
    all.struct_size = level->struct_size;
    for (std::size_t e = 0; e < Listener::kEars; ++e) {
        all.peak[e] = heard.ear[e].peak();
        all.rms[e] = heard.ear[e].rms();
    }
    all.least_gain = heard.least_gain;
    std::memcpy(level, &all, std::min<std::size_t>(level->struct_size, sizeof all));
    return 1;
}

int dSoundListenerSetLimiter(dSoundListenerID listener, dReal ceiling) {
    require_id(listener, "dSoundListenerSetLimiter");
    return guarded("dSoundListenerSetLimiter", 0, [&] {
        if (!std::isfinite(ceiling) || ceiling < 0.0) {
            dMessage(
                0,
                "dSoundListenerSetLimiter: ceiling is %g of full scale; it must be above 0, or "
                "0 for no limiter",
                ceiling);
            return 0;
        }
        listener->listener->set_limiter(ceiling);
        return 1;
    });
}

namespace {

/// Whether nobody but `listener` sends to the sink; else after a message.
bool is_free(dSoundWorldID world, dSoundListenerID listener, dSoundSinkID sink,
             const char* function) {
    bool free = !sink->listeners;
    for (dSoundListenerID other : world->listeners)
        free = free && (other == listener || !other->listener->has_sink(*sink->sink));
    if (!free)
        dMessage(0,
                 "%s: the sink serves another listener; one sink serves one listener, or several "
                 "named at once by dSoundListenersAddSink()",
                 function);
    return free;
}

} // namespace

int dSoundListenerAddSink(dSoundListenerID listener, dSoundSinkID sink) {
    require_id(listener, "dSoundListenerAddSink");
    require_id(sink, "dSoundListenerAddSink");
    return guarded("dSoundListenerAddSink", 0, [&] {
        if (!is_free(listener->owner, listener, sink, "dSoundListenerAddSink"))
            return 0;
        if (listener->listener->add_sink(sink->sink))
            return 1;
        dMessage(0, "dSoundListenerAddSink: %s", sink->sink->error());
        return 0;
    });
}

int dSoundListenersAddSink(const dSoundListenerID* listeners, int count, dSoundSinkID sink) {
    const char* const function = "dSoundListenersAddSink";
    require_id(listeners, function);
    require_id(sink, function);
    return guarded(function, 0, [&] {
        if (count < 1) {
            dMessage(0, "%s: count is %d; name one listener or more", function, count);
            return 0;
        }
        const std::span all(listeners, static_cast<std::size_t>(count));
        std::vector<int> ears;
        for (const dSoundListenerID& listener : all) {
            require_id(listener, function);
            if (listener->owner != all[0]->owner ||
                std::find(all.begin(), all.end(), listener) < all.begin() + (&listener - &all[0])) {
                dMessage(0, "%s: listener %d is %s; name listeners of one world, each once",
                         function, static_cast<int>(&listener - &all[0]),
                         listener->owner != all[0]->owner ? "of another world" : "named twice");
                return 0;
            }
            ears.push_back(listener->listener->ears());
        }
        if (!is_free(all[0]->owner, nullptr, sink, function))
            return 0;
        auto joined = std::make_unique<SideBySide>(sink->sink, ears);
        for (std::size_t i = 0; i < all.size(); ++i)
            if (!all[i]->listener->add_sink(joined->parts()[i])) {
                dMessage(0, "%s: %s", function, sink->sink->error());
                return 0; // the parts end here, and whoever has one lets it go
            }
        sink->listeners = std::move(joined);
        return 1;
    });
}

int dSoundListenerSetSink(dSoundListenerID listener, dSoundSinkID sink) {
    require_id(listener, "dSoundListenerSetSink");
    return guarded("dSoundListenerSetSink", 0, [&] {
        std::vector<const Sink*> had;
        listener->listener->for_each_sink([&](const Sink& own) { had.push_back(&own); });
        for (const Sink* old : had)
            if (!sink || old != sink->sink.get())
                listener->listener->remove_sink(*old);
        return sink ? dSoundListenerAddSink(listener, sink) : 1;
    });
}
