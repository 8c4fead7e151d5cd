#include "api/sink.h"
#include "api/guard.h"
#include "api/ids.h"
#include "api/left_open.h"
#include "sink/file_sink.h"
#include "sink/memory_sink.h"
#include "sink/null_sink.h"
#include "sink/openal_sink.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <thread>

using namespace ode::sound;

namespace {

/// A new id around what `make` returns.
template <class Make>
dSoundSinkID create(const char* function, Make&& make) noexcept {
    return guarded(function, dSoundSinkID{}, [&] {
        auto id = std::make_unique<dxSoundSink>(dxSoundSink{make()});
        keep(id.get());
        return id.release();
    });
}

bool is_delay(dReal delay, const char* function) {
    if (std::isfinite(delay) && delay >= 0.0)
        return true;
    dMessage(0, "%s: delay is %g s; it must be 0 or more", function, delay);
    return false;
}

/// Until no more than `delay` [s] is ahead of the loudspeaker. @return [s]
dReal wait_for(const Sink& sink, dReal delay) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const auto allowed = static_cast<std::size_t>(delay * sink.rate());
    while (sink.rate() > 0 && sink.backlog() > allowed) {
        if (Clock::now() - begin > std::chrono::seconds(1)) // a device that takes nothing
            break;
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

} // namespace

dSoundSinkID dSoundSinkCreateNull(void) {
    return create(__func__, [] { return std::make_shared<NullSink>(); });
}

dSoundSinkID dSoundSinkCreateMemory(void) {
    return create(__func__, [] { return std::make_shared<MemorySink>(); });
}

dSoundSinkID dSoundSinkCreateFile(const char* path) {
    require_id(path, __func__);
    return create(__func__, [path] { return std::make_shared<FileSink>(path); });
}

dSoundFile dSoundFileDefault(void) {
    dSoundFile file{};
    file.struct_size = sizeof file;
    return file;
}

dSoundSinkID dSoundSinkCreateFileAs(const char* path, const dSoundFile* file) {
    require_id(path, __func__);
    require_id(file, __func__);
    dSoundFile own = dSoundFileDefault();
    std::memcpy(&own, file, std::min<std::size_t>(file->struct_size, sizeof own));
    return create(__func__, [&] {
        return std::make_shared<FileSink>(path, own.bits, own.note != 0, own.speakers);
    });
}

int dSoundSinkMark(dSoundSinkID sink, const char* text) {
    require_id(sink, __func__);
    require_id(text, __func__);
    const char* const function = __func__;
    return guarded(function, 0, [&] {
        auto* file = dynamic_cast<FileSink*>(sink->sink.get());
        if (file && file->mark(text))
            return 1;
        dMessage(0,
                 "%s: there is no note to this %s sink; make one with dSoundSinkCreateFileAs() "
                 "and note 1",
                 function, sink->sink->kind());
        return 0;
    });
}

dSoundSinkID dSoundSinkCreateOpenAL(void) {
    const char* const function = __func__;
    return create(function, [function]() -> std::shared_ptr<Sink> {
        try {
            return std::make_shared<OpenAlSink>(
                OpenAlDevice::open_default(),
                [](const char* sentence) { dMessage(0, "%s", sentence); });
        } catch (const Refused& e) {
            dMessage(0, "%s: %s (a null sink takes its place)", function, e.what());
            return std::make_shared<NullSink>();
        }
    });
}

dSoundSinkID dSoundSinkCreateOpenALCurrent(void) {
    const char* const function = __func__;
    return guarded(function, dSoundSinkID{}, [function] {
        try {
            auto id = std::make_unique<dxSoundSink>(dxSoundSink{std::make_shared<OpenAlSink>(
                OpenAlDevice::of_application(),
                [](const char* sentence) { dMessage(0, "%s", sentence); },
                []() -> OpenAlDevice { throw Refused("the application's device is gone"); })});
            keep(id.get());
            return id.release();
        } catch (const Refused& e) {
            dMessage(0, "%s: %s", function, e.what());
            return dSoundSinkID{};
        }
    });
}

void dSoundSinkDestroy(dSoundSinkID sink) {
    if (!sink)
        return;
    forget(sink);
    sink->close();
    delete sink;
}

const char* dSoundSinkGetKind(dSoundSinkID sink) {
    require_id(sink, __func__);
    return sink->sink->kind();
}

unsigned long dSoundSinkGetSamples(dSoundSinkID sink, const float** first, int* channels) {
    require_id(sink, __func__);
    require_id(first, __func__);
    require_id(channels, __func__);
    const auto* memory = dynamic_cast<const MemorySink*>(sink->sink.get());
    if (!memory) {
        dMessage(0, "%s: a %s sink keeps no samples; use dSoundSinkCreateMemory()", __func__,
                 sink->sink->kind());
        *first = nullptr;
        *channels = 0;
        return 0;
    }
    *first = memory->samples().data();
    *channels = memory->format().channels;
    return memory->samples().size() / static_cast<unsigned long>(*channels);
}

const char* dSoundSinkGetError(dSoundSinkID sink) {
    require_id(sink, __func__);
    return sink->sink->error();
}

int dSoundGetDeviceRate(void) {
    const char* const function = __func__;
    return guarded(function, 0, [function] {
        try {
            return OpenAlContext(OpenAlDevice::open_default(), 0).rate();
        } catch (const Refused& e) {
            dMessage(0, "%s: %s", function, e.what());
            return 0;
        }
    });
}

dReal dSoundSinkPace(dSoundSinkID sink, dReal delay) {
    require_id(sink, __func__);
    return is_delay(delay, __func__) ? wait_for(*sink->sink, delay) : 0;
}

dReal dSoundPace(dSoundWorldID world, dReal delay) {
    const char* const function = __func__;
    require_id(world, function);
    if (!is_delay(delay, function))
        return 0;
    return guarded(function, dReal{0}, [&] {
        dReal waited = 0;
        for (const auto& listener : world->world.scene().all())
            listener->for_each_sink([&](const Sink& sink) { waited += wait_for(sink, delay); });
        world->world.keep_pace();
        return waited;
    });
}

unsigned long dSoundSinkGetBacklog(dSoundSinkID sink) {
    require_id(sink, __func__);
    return sink->sink->backlog();
}
