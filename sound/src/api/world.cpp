#include "api/guard.h"
#include "api/ids.h"
#include "api/left_open.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

namespace ode::sound {
namespace {

constexpr int kLowestRate = 8000;
constexpr int kHighestRate = 192000;

/// "a, b, c" of a numbered list that ends with an empty name.
std::string join(std::string_view (*name)(int) noexcept) {
    std::string all;
    for (int i = 0; !name(i).empty(); ++i)
        all.append(i > 0 ? ", " : "").append(name(i));
    return all;
}

bool is_positive(dReal value) { return std::isfinite(value) && value > 0.0; }

} // namespace
} // namespace ode::sound

using namespace ode::sound;

dSoundWorldID dSoundWorldCreate(dSoftWorldID world) {
    require_id(world, "dSoundWorldCreate");
    return guarded("dSoundWorldCreate", dSoundWorldID{}, [&] {
        auto id = std::make_unique<dxSoundWorld>(world);
        keep(id.get());
        return id.release();
    });
}

void dSoundWorldDestroy(dSoundWorldID world) {
    require_id(world, "dSoundWorldDestroy");
    forget(world);
    for (dSoundListenerID listener : world->listeners)
        delete listener;
    for (dSoundModalID modal : world->modals)
        delete modal;
    delete world;
}

int dSoundSetRadiation(dSoundWorldID world, const char* name) {
    require_id(world, "dSoundSetRadiation");
    return guarded("dSoundSetRadiation", 0, [&] {
        Settings settings = world->world.scene().settings();
        if (!name || !find_radiation(name, settings.radiation)) {
            dMessage(0, "dSoundSetRadiation: no radiation model \"%s\"; there are: %s",
                     name ? name : "(null)", join(radiation_name).c_str());
            return 0;
        }
        world->world.set(settings);
        return 1;
    });
}

int dSoundSetSampling(dSoundWorldID world, const char* name) {
    require_id(world, "dSoundSetSampling");
    return guarded("dSoundSetSampling", 0, [&] {
        Settings settings = world->world.scene().settings();
        if (!name || !find_sampling(name, settings.sampling)) {
            dMessage(0, "dSoundSetSampling: no sampling \"%s\"; there are: %s",
                     name ? name : "(null)", join(sampling_name).c_str());
            return 0;
        }
        world->world.set(settings);
        return 1;
    });
}

int dSoundSetOcclusion(dSoundWorldID world, dSpaceID space, unsigned long category_bits) {
    require_id(world, "dSoundSetOcclusion");
    return guarded("dSoundSetOcclusion", 0, [&] {
        world->world.occlusion().set(space, category_bits);
        return 1;
    });
}

int dSoundSetAir(dSoundWorldID world, dReal density, dReal speed) {
    require_id(world, "dSoundSetAir");
    return guarded("dSoundSetAir", 0, [&] {
        if (!is_positive(density) || !is_positive(speed)) {
            dMessage(0, "dSoundSetAir: density %g kg/m^3 and speed %g m/s must both be positive",
                     density, speed);
            return 0;
        }
        Settings settings = world->world.scene().settings();
        settings.air = {density, speed};
        world->world.set(settings);
        return 1;
    });
}

int dSoundSetBodyGain(dSoundWorldID world, dSoftBodyID body, dReal gain) {
    require_id(world, "dSoundSetBodyGain");
    require_id(body, "dSoundSetBodyGain");
    return guarded("dSoundSetBodyGain", 0, [&] {
        if (!std::isfinite(gain) || gain < 0.0) {
            dMessage(0, "dSoundSetBodyGain: gain is %g; it must be 0 (mute) or more", gain);
            return 0;
        }
        world->world.scene().set_gain(body, gain);
        return 1;
    });
}

dReal dSoundGetBodyGain(dSoundWorldID world, dSoftBodyID body) {
    require_id(world, "dSoundGetBodyGain");
    require_id(body, "dSoundGetBodyGain");
    return world->world.scene().gain(body);
}

int dSoundSetFullScale(dSoundWorldID world, dReal pressure) {
    require_id(world, "dSoundSetFullScale");
    return guarded("dSoundSetFullScale", 0, [&] {
        if (!is_positive(pressure)) {
            dMessage(0, "dSoundSetFullScale: full scale is %g Pa; it must be positive", pressure);
            return 0;
        }
        Settings settings = world->world.scene().settings();
        settings.full_scale = pressure;
        world->world.set(settings);
        return 1;
    });
}

int dSoundSetRate(dSoundWorldID world, int rate) {
    require_id(world, "dSoundSetRate");
    return guarded("dSoundSetRate", 0, [&] {
        if (rate < kLowestRate || rate > kHighestRate) {
            dMessage(0, "dSoundSetRate: rate is %d Hz; choose %d to %d", rate, kLowestRate,
                     kHighestRate);
            return 0;
        }
        if (world->world.scene().listeners() > 0) {
            dMessage(0,
                     "dSoundSetRate: there are listeners already; set the rate before the first");
            return 0;
        }
        Settings settings = world->world.scene().settings();
        settings.rate = rate;
        world->world.set(settings);
        return 1;
    });
}

int dSoundSetPacePolicy(dSoundWorldID world, const char* name) {
    require_id(world, "dSoundSetPacePolicy");
    return guarded("dSoundSetPacePolicy", 0, [&] {
        for (int i = 0; name && !Pace::name(i).empty(); ++i)
            if (Pace::name(i) == name) {
                world->world.pace().set(static_cast<Pace::Policy>(i));
                return 1;
            }
        dMessage(0, "dSoundSetPacePolicy: no policy \"%s\"; there are: %s", name ? name : "(null)",
                 join(Pace::name).c_str());
        return 0;
    });
}

const char* dSoundGetPacePolicy(dSoundWorldID world) {
    require_id(world, "dSoundGetPacePolicy");
    return Pace::name(static_cast<int>(world->world.pace().policy())).data();
}

int dSoundSetAlarm(dSoundWorldID world, dSoundAlarmCallback* callback, void* data) {
    require_id(world, "dSoundSetAlarm");
    return guarded("dSoundSetAlarm", 0, [&] {
        if (callback)
            world->world.set_alarm(
                [=](dSoftBodyID body, double time) { callback(data, body, time); });
        else
            world->world.set_alarm({});
        return 1;
    });
}

int dSoundGetStats(dSoundWorldID world, dSoundStats* stats) {
    require_id(world, "dSoundGetStats");
    return guarded("dSoundGetStats", 0, [&] {
        if (!stats || stats->struct_size < sizeof(unsigned)) {
            dMessage(0, "dSoundGetStats: set struct_size to sizeof(dSoundStats) before the call");
            return 0;
        }
        const Scene& scene = world->world.scene();
        const Scene::Count count = scene.count();
        dSoundStats all{};
        all.struct_size = stats->struct_size;
        all.observed_substeps = count.substeps;
        all.gathers = count.gathers;
        all.frames = count.frames;
        for (const auto& listener : scene.all())
            listener->for_each_sink(
                [&](const Sink& sink) { all.latency = std::max(all.latency, sink.latency()); });
        all.underruns = world->world.underruns();
        all.seconds = world->world.seconds();
        all.peak = count.peak;
        all.rms = count.rms;
        all.alarms = world->world.alarm().count();
        all.alarm_time = world->world.alarm().last();
        all.mode_samples = count.mode_samples;
        all.inaudible_samples = count.inaudible_samples;
        all.rays = world->world.occlusion().rays();
        // An app built against an older header gets the fields that it knows.
        std::memcpy(stats, &all, std::min<std::size_t>(stats->struct_size, sizeof all));
        return 1;
    });
}
