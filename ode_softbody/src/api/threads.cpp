#include <ode_softbody/threads.h>

#include "api/boundary.h"
#include "api/editing.h"
#include "api/handles.h"
#include "base/thread_pool.h"
#include "world/soft_world.h"

#include <algorithm>
#include <memory>

using namespace ode::soft;

namespace {

constexpr int kMostThreads = 64;

/// Those of the application.
class AppTasks final : public Tasks {
public:
    AppTasks(dSoftEnqueueTasks* enqueue, dSoftFinishTasks* finish, void* data)
        : enqueue_(enqueue), finish_(finish), data_(data) {}

    void run(Piece piece, void* context, std::size_t count) noexcept override {
        Job job{piece, context};
        finish_(enqueue_(
                    [](void* given, int i) {
                        const Job& j = *static_cast<Job*>(given);
                        j.piece(j.context, static_cast<std::size_t>(i));
                    },
                    &job, static_cast<int>(count), data_),
                data_);
    }
    int threads() const noexcept override { return 0; }

private:
    struct Job {
        Piece piece;
        void* context;
    };
    dSoftEnqueueTasks* enqueue_;
    dSoftFinishTasks* finish_;
    void* data_;
};

} // namespace

int dSoftWorldSetThreads(dSoftWorldID id, int threads) {
    SoftWorld* world = live(id, __func__);
    if (!world || !may_edit(*world, __func__))
        return 0;
    return guarded(__func__, 0, [&] {
        if (threads < 0 || threads > kMostThreads)
            throw InputError(format("%d threads can't be had; give 1 to %d, or 0 for one a core",
                                    threads, kMostThreads));
        const auto cores = static_cast<int>(std::thread::hardware_concurrency()); // 0: unknown
        const int wanted = threads != 0 ? threads : std::clamp(cores, 1, kMostThreads);
        world->set_tasks(wanted > 1 ? std::make_unique<ThreadPool>(wanted) : nullptr);
        return 1;
    });
}

int dSoftWorldGetThreads(dSoftWorldID id) {
    const SoftWorld* world = live(id, __func__);
    if (!world)
        return 0;
    return world->tasks() ? world->tasks()->threads() : 1;
}

int dSoftWorldSetTaskCallbacks(dSoftWorldID id, dSoftEnqueueTasks* enqueue,
                               dSoftFinishTasks* finish, void* data) {
    SoftWorld* world = live(id, __func__);
    if (!world || !may_edit(*world, __func__))
        return 0;
    return guarded(__func__, 0, [&] {
        if (!enqueue != !finish)
            throw InputError(format("%s is missing; give both callbacks, or neither",
                                    enqueue ? "finish" : "enqueue"));
        world->set_tasks(enqueue ? std::make_unique<AppTasks>(enqueue, finish, data) : nullptr);
        return 1;
    });
}
