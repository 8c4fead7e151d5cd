#include "api/left_open.h"

#include "api/ids.h"
#include "api/sink.h"
#include "dsp/splat_table.h"
#include "dsp/step_kernel.h"

#include <mutex>
#include <vector>

namespace ode::sound {
namespace {

class LeftOpen {
public:
    LeftOpen() {
        // Statics end in reverse order: what playing out reads has to be there before.
        splat_table();
        step_kernel();
    }

    ~LeftOpen() {
        for (dSoundWorldID world : worlds_)
            world->world.end();
        for (dSoundSinkID sink : sinks_)
            sink->close();
    }

    void add(dSoundWorldID world) {
        const std::lock_guard guard(lock_);
        worlds_.push_back(world);
    }
    void add(dSoundSinkID sink) {
        const std::lock_guard guard(lock_);
        sinks_.push_back(sink);
    }
    void remove(dSoundWorldID world) noexcept {
        const std::lock_guard guard(lock_);
        std::erase(worlds_, world);
    }
    void remove(dSoundSinkID sink) noexcept {
        const std::lock_guard guard(lock_);
        std::erase(sinks_, sink);
    }

    dSoundWorldID of(dSoftWorldID soft) noexcept {
        const std::lock_guard guard(lock_);
        for (std::size_t i = worlds_.size(); i-- > 0;)
            if (worlds_[i]->world.soft_world() == soft)
                return worlds_[i];
        return nullptr;
    }

private:
    std::mutex lock_;
    std::vector<dSoundWorldID> worlds_;
    std::vector<dSoundSinkID> sinks_;
};

LeftOpen& left_open() {
    static LeftOpen all;
    return all;
}

} // namespace

void keep(dSoundWorldID world) { left_open().add(world); }
void keep(dSoundSinkID sink) { left_open().add(sink); }
void forget(dSoundWorldID world) noexcept { left_open().remove(world); }
dSoundWorldID sound_of(dSoftWorldID world) noexcept { return left_open().of(world); }
void forget(dSoundSinkID sink) noexcept { left_open().remove(sink); }

} // namespace ode::sound
