#pragma once

#include <array>
#include <atomic>
#include <cstdarg>
#include <cstdio>

namespace ode::sound {

/// Keeps the first failure of a sink, from whichever thread it comes, without allocation. Later
/// failures are consequences and would hide the cause.
class FirstError {
public:
    [[gnu::format(printf, 2, 3)]] void set(const char* sentence, ...) noexcept {
        State none = State::kNone;
        if (!state_.compare_exchange_strong(none, State::kWriting, std::memory_order_relaxed))
            return;
        std::va_list arguments;
        va_start(arguments, sentence);
        std::vsnprintf(text_.data(), text_.size(), sentence, arguments);
        va_end(arguments);
        state_.store(State::kSet, std::memory_order_release);
    }

    bool is_set() const noexcept { return state_.load(std::memory_order_acquire) == State::kSet; }
    const char* text() const noexcept { return is_set() ? text_.data() : ""; }

private:
    enum class State { kNone, kWriting, kSet };
    std::atomic<State> state_{State::kNone};
    std::array<char, 1024> text_{}; // a path may be long; it is cut rather than lost
};

} // namespace ode::sound
