// What the library costs a program of boxes on a plane: with no soft world, with an empty one, and
// with a soft body far away that is stopped, or asleep. ODE's own functions and the interposed ones
// take turns on the same scene, a few steps each from the same state on, since a resting box knows
// quicker and slower steps. What counts is the median of the differences: a core shares its units
// with another, which makes two kinds of least times.
#include <benchmark/benchmark.h>

#include <ode/ode.h>
#include <ode_softbody/softbody.hpp>

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <vector>

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
    Scene(int boxes, int kind) {
        world_ = dWorldCreate();
        space_ = dHashSpaceCreate(nullptr);
        contacts_ = dJointGroupCreate(0);
        dWorldSetGravity(world_, 0, 0, -9.81);
        dCreatePlane(space_, 0, 0, 1, 0);
        for (int i = 0; i < boxes; ++i) {
            const dBodyID body = dBodyCreate(world_);
            const dGeomID box = dCreateBox(space_, 0.2, 0.2, 0.2);
            dGeomSetBody(box, body);
            body_.push_back(body);
        }
        reset();
        if (kind >= 1)
            soft_.reset(dSoftWorldCreate(world_, space_));
        if (kind == 2)
            add_stopped_body();
        if (kind == 3)
            add_sleeper();
    }
    ~Scene() {
        dJointGroupDestroy(contacts_);
        soft_.reset();
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    /// All boxes lie as at first, and QuickStep's order of rows begins anew.
    void reset() {
        dRandSetSeed(1);
        const dQuaternion upright = {1, 0, 0, 0};
        for (std::size_t i = 0; i < body_.size(); ++i) {
            dBodySetPosition(body_[i], 0.5 * static_cast<double>(i % 10),
                             0.5 * static_cast<double>(i / 10), 0.1);
            dBodySetQuaternion(body_[i], upright);
            dBodySetLinearVel(body_[i], 0, 0, 0);
            dBodySetAngularVel(body_[i], 0, 0, 0);
        }
    }

    void step(const Functions& functions) {
        functions.collide(space_, this, &Scene::near);
        functions.step(world_, 1.0 / 240);
        dJointGroupEmpty(contacts_);
    }

private:
    dSoftBodyID add_far_body() {
        dSoftSolid solid = dSoftSolidDefault();
        solid.young = 1e6;
        const MeshHandle mesh(dSoftMeshCreateBox(0.1, 0.1, 0.1, 3, 3, 3));
        const dSoftBodyID body = dSoftBodyCreate(soft_, mesh, &solid);
        dSoftBodySetPosition(body, 100, 0, 50);
        return body;
    }
    void add_sleeper() { dSoftBodyDisable(add_far_body()); }
    /// By an impossible blow.
    void add_stopped_body() {
        const dSoftBodyID body = add_far_body();
        dSoftBodyAddForceAtNode(body, 0, 1e12, 0, 0);
        dSetMessageHandler([](int, const char*, va_list) {});
        for (int i = 0; i < 3; ++i)
            step(Functions());
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

    dWorldID world_;
    dSpaceID space_;
    dJointGroupID contacts_;
    WorldHandle soft_;
    std::vector<dBodyID> body_;
};

constexpr std::array kKinds{"no soft world", "empty soft world", "stopped soft body",
                            "sleeping soft body"};

double median(std::vector<double> of) {
    const auto middle = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
    std::nth_element(of.begin(), middle, of.end());
    return *middle;
}

/// @param arg 0: boxes, 1: index into kKinds
void BM_Idle(benchmark::State& state) {
    Scene scene(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    const std::array functions{Functions::bare(), Functions()};
    std::vector<double> ode;
    std::vector<double> more;
    constexpr int kSteps = 20; // in one measurement: the clock costs as much as the hooks do
    bool swapped = false;
    for (auto _ : state) {
        std::array<double, 2> spent{};
        for (const std::size_t turn : {0, 1}) {
            const std::size_t i = swapped ? 1 - turn : turn;
            scene.reset();
            scene.step(functions[i]);
            const double start = cpu_seconds();
            for (int step = 0; step < kSteps; ++step)
                scene.step(functions[i]);
            spent[i] = (cpu_seconds() - start) / kSteps;
        }
        swapped = !swapped;
        ode.push_back(spent[0]);
        more.push_back(spent[1] - spent[0]);
    }
    state.SetLabel(kKinds[static_cast<std::size_t>(state.range(1))]);
    state.counters["ode_us"] = 1e6 * median(ode);
    state.counters["cost_ns"] = 1e9 * median(more);
    state.counters["share"] = median(more) / median(ode);
}
BENCHMARK(BM_Idle)->ArgsProduct({{1, 10, 100}, {0, 1, 2, 3}})->MinTime(1);

} // namespace

int main(int count, char** argument) {
    dInitODE2(0);
    benchmark::Initialize(&count, argument);
    benchmark::RunSpecifiedBenchmarks();
    dCloseODE();
    return 0;
}
