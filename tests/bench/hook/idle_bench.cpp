// What the library costs a program that has no soft body: boxes on a plane under ODE's own
// functions (argument 0), under the interposed ones without a soft world (1), with an empty one
// (2), and with a soft body that is stopped, far away (3). Time: least CPU time of a step of many,
// the kinds taking turns so that they share the machine's moods.
#include <benchmark/benchmark.h>

#include <ode/ode.h>
#include <ode_softbody/softbody.hpp>

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <limits>

namespace {

using namespace ode::soft;

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// ODE's own functions, behind the interposed ones.
struct Functions {
    int (*step)(dWorldID, dReal) = dWorldQuickStep;
    void (*collide)(dSpaceID, void*, dNearCallback*) = dSpaceCollide;

    static Functions bare() {
        void* ode = dlopen("libode.so.8", RTLD_NOW | RTLD_NOLOAD);
        Functions f;
        f.step = reinterpret_cast<int (*)(dWorldID, dReal)>(dlsym(ode, "dWorldQuickStep"));
        f.collide = reinterpret_cast<void (*)(dSpaceID, void*, dNearCallback*)>(
            dlsym(ode, "dSpaceCollide"));
        return f;
    }
};

/// Boxes resting on a plane, the typical small scene.
class Scene {
public:
    Scene(int boxes, int kind) : functions_(kind == 0 ? Functions::bare() : Functions()) {
        world_ = dWorldCreate();
        space_ = dHashSpaceCreate(nullptr);
        contacts_ = dJointGroupCreate(0);
        dWorldSetGravity(world_, 0, 0, -9.81);
        dCreatePlane(space_, 0, 0, 1, 0);
        for (int i = 0; i < boxes; ++i) {
            const dBodyID body = dBodyCreate(world_);
            const dGeomID box = dCreateBox(space_, 0.2, 0.2, 0.2);
            dGeomSetBody(box, body);
            dBodySetPosition(body, 0.5 * (i % 10), 0.5 * (i / 10), 0.1);
        }
        if (kind >= 2)
            soft_.reset(dSoftWorldCreate(world_, space_));
        if (kind >= 3)
            add_stopped_body();
    }
    ~Scene() {
        dJointGroupDestroy(contacts_);
        soft_.reset();
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    void step() {
        functions_.collide(space_, this, &Scene::near);
        functions_.step(world_, 1.0 / 240);
        dJointGroupEmpty(contacts_);
    }

private:
    /// Far away, and stopped by an impossible blow.
    void add_stopped_body() {
        dSoftSolid solid = dSoftSolidDefault();
        solid.young = 1e6;
        const MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 3, 3, 3));
        const dSoftBodyID body = dSoftBodyCreate(soft_, mesh, &solid);
        dSoftBodySetPosition(body, 100, 0, 50);
        dSoftBodyAddForceAtNode(body, 0, 1e12, 0, 0);
        dSetMessageHandler([](int, const char*, va_list) {});
        for (int i = 0; i < 3; ++i)
            step();
        dSetMessageHandler(nullptr);
    }

    static void near(void* data, dGeomID a, dGeomID b) {
        Scene& scene = *static_cast<Scene*>(data);
        dContact contact[4] = {};
        const int n = dCollide(a, b, 4, &contact[0].geom, sizeof(dContact));
        for (int i = 0; i < n; ++i) {
            contact[i].surface.mu = 0.5;
            dJointAttach(dJointCreateContact(scene.world_, scene.contacts_, &contact[i]),
                         dGeomGetBody(a), dGeomGetBody(b));
        }
    }

    Functions functions_;
    dWorldID world_;
    dSpaceID space_;
    dJointGroupID contacts_;
    WorldHandle soft_;
};

constexpr std::array kKinds{"bare ODE", "interposed", "empty soft world", "stopped soft body"};

/// @param arg 0: boxes
void BM_Idle(benchmark::State& state) {
    const int boxes = static_cast<int>(state.range(0));
    std::array<Scene, kKinds.size()> scene{Scene(boxes, 0), Scene(boxes, 1), Scene(boxes, 2),
                                           Scene(boxes, 3)};
    std::array<double, kKinds.size()> least;
    least.fill(std::numeric_limits<double>::infinity());
    for (auto _ : state)
        for (std::size_t kind = 0; kind < scene.size(); ++kind) {
            const double start = cpu_seconds();
            scene[kind].step();
            least[kind] = std::min(least[kind], cpu_seconds() - start);
        }
    state.counters["bare_us"] = 1e6 * least[0];
    for (std::size_t kind = 1; kind < least.size(); ++kind)
        state.counters[kKinds[kind]] = least[kind] / least[0] - 1;
}
BENCHMARK(BM_Idle)->Arg(1)->Arg(10)->Arg(100)->Iterations(3000)->Unit(benchmark::kMicrosecond);

} // namespace

int main(int count, char** argument) {
    dInitODE2(0);
    benchmark::Initialize(&count, argument);
    benchmark::RunSpecifiedBenchmarks();
    dCloseODE();
    return 0;
}
