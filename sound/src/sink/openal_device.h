#pragma once

#include <AL/alc.h>

#include <functional>
#include <memory>

namespace ode::sound {

/// An open OpenAL device and how samples leave it.
struct OpenAlDevice {
    struct Closer {
        bool borrowed; ///< not ours to close
        void operator()(ALCdevice* device) const noexcept {
            if (!borrowed)
                alcCloseDevice(device);
        }
    };
    std::unique_ptr<ALCdevice, Closer> handle;
    /// Rendered by alcRenderSamplesSOFT (float stereo) instead of by a sound card.
    bool loopback = false;
    /// Whether it is still there, where OpenAL can't tell; empty: ask OpenAL.
    std::function<bool()> connected;

    /// The application's, to be used as it is; null: one of our own is made.
    ALCcontext* context = nullptr;

    /// What is current for the calling thread. @throws Refused when nothing is
    static OpenAlDevice of_application();
    /// The system's default output. @throws Refused when there is none
    static OpenAlDevice open_default();
};

/// A context of our own on a device, without touching the application's; or the application's own.
/// Either is made current for none but those threads of ours that ask for it
/// (ALC_EXT_thread_local_context).
class OpenAlContext {
public:
    /// @param rate  wished for [Hz]; 0: the device's own.
    /// @throws Refused
    OpenAlContext(OpenAlDevice device, int rate);
    OpenAlContext(const OpenAlContext&) = delete;
    OpenAlContext& operator=(const OpenAlContext&) = delete;
    ~OpenAlContext() {
        if (!is_borrowed())
            alcDestroyContext(context_);
    }

    bool is_borrowed() const noexcept { return device_.context != nullptr; }

    int rate() const noexcept;          ///< the device's own [Hz]
    int period_frames() const noexcept; ///< mixed by the device at a time
    bool connected() const noexcept;    ///< false when the device was unplugged

    /// Makes the context current for the calling thread, and what was so before at its end.
    class Scope {
    public:
        explicit Scope(OpenAlContext& context) noexcept;
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;
        ~Scope();

    private:
        OpenAlContext& context_;
        ALCcontext* before_;
    };

private:
    using SetThreadContext = ALCboolean(ALC_APIENTRY*)(ALCcontext*);
    using GetThreadContext = ALCcontext*(ALC_APIENTRY*)();

    OpenAlDevice device_;
    ALCcontext* context_ = nullptr;
    SetThreadContext set_thread_context_ = nullptr;
    GetThreadContext get_thread_context_ = nullptr;
};

} // namespace ode::sound
