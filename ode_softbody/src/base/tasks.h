#pragma once

#include "base/float_mode.h"

#include <algorithm>
#include <cstddef>

namespace ode::soft {

/// Whoever runs pieces of work side by side: a pool of threads, or the application's own.
class Tasks {
public:
    using Piece = void (*)(void* context, std::size_t index) noexcept;

    virtual ~Tasks() = default;
    /// piece(context, i) for every i < count, in any order, on any threads; returns when all are
    /// done. Called by one thread at a time, never from within a piece.
    virtual void run(Piece piece, void* context, std::size_t count) noexcept = 0;
    virtual int threads() const noexcept = 0; ///< the caller's included; 0: not known

    /// Of the calling thread; nullptr: it works alone.
    static Tasks* current() noexcept { return current_; }

private:
    friend class TasksScope;
    static inline thread_local Tasks* current_ = nullptr;
};

/// Makes `tasks` the calling thread's while it lives.
class TasksScope {
public:
    explicit TasksScope(Tasks* tasks) noexcept : before_(Tasks::current_) {
        Tasks::current_ = tasks;
    }
    ~TasksScope() { Tasks::current_ = before_; }
    TasksScope(const TasksScope&) = delete;
    TasksScope& operator=(const TasksScope&) = delete;

private:
    Tasks* before_;
};

/// do_piece(i) for every i < count. What pieces share they only read, and each is the same wherever
/// it runs: so is the result. A piece that has pieces of its own does them alone.
template <class DoPiece>
void in_pieces(std::size_t count, DoPiece&& do_piece) noexcept {
    Tasks* const tasks = Tasks::current();
    if (!tasks || count < 2) {
        for (std::size_t i = 0; i < count; ++i)
            do_piece(i);
        return;
    }
    struct Work {
        DoPiece& do_piece;
        FloatMode mode;
    } work{do_piece, FloatMode::of_this_thread()};
    tasks->run(
        [](void* context, std::size_t i) noexcept {
            const Work& w = *static_cast<Work*>(context);
            const FloatMode before = w.mode.apply();
            const TasksScope alone(nullptr);
            w.do_piece(i);
            before.apply();
        },
        &work, count);
}

/// Of a range of nodes that one pass goes through: some microseconds.
inline constexpr std::size_t kLeastNodes = 2000;

/// How many ranges [0, size) is cut in, none shorter than `least` unless it is the only one.
inline constexpr std::size_t kMostRanges = 16;
inline std::size_t range_count(std::size_t size, std::size_t least) noexcept {
    return std::clamp(size / least, std::size_t{1}, kMostRanges);
}

/// do_range(first, last) that cover [0, size) so. For work whose result doesn't depend on where
/// ranges end.
template <class DoRange>
void in_ranges(std::size_t size, std::size_t least, DoRange&& do_range) noexcept {
    const std::size_t pieces = range_count(size, least);
    in_pieces(pieces, [&](std::size_t i) { do_range(size * i / pieces, size * (i + 1) / pieces); });
}

} // namespace ode::soft
