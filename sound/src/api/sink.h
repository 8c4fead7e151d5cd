#pragma once

#include "sink/side_by_side.h"
#include "sink/sink.h"

#include <ode_sound/sound.h>

#include <memory>

/// The id owns its sink; a listener observes it (std::weak_ptr), so that whichever ends first, the
/// other lets go. A sink that is written to after its id is gone takes the samples and forgets
/// them.
struct dxSoundSink {
    std::shared_ptr<ode::sound::Sink> sink;
    std::unique_ptr<ode::sound::SideBySide> listeners{}; ///< where it serves several

    void close() {
        if (listeners)
            listeners->finish();
        sink->close();
    }
};
