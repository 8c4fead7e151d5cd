// Preloaded: puts a soft body into every space of the program. It is pinned and touches nothing,
// but its box spans the scene, so that it is paired with nearly everything at every step. The
// program must not notice.
//
//   CONFORMANCE_SOFT_REPORT  file to write when the program closes ODE

#include "program_watch.h"

#include <ode/ode.h>
#include <ode_softbody/softbody.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <vector>

namespace ode::conformance {
namespace {

/// Two tetrahedra of 1 m at opposite corners of 2 km by 2 km by 1 km above the ground.
dSoftMeshID far_corners() {
    const dReal at[2][3] = {{-1000, -1000, 0.05}, {999, 999, 999}};
    std::vector<dReal> nodes;
    for (const auto& corner : at)
        for (int node = 0; node < 4; ++node)
            for (int axis = 0; axis < 3; ++axis)
                nodes.push_back(corner[axis] + (node == axis + 1 ? 1 : 0));
    const int tets[] = {0, 1, 2, 3, 4, 5, 6, 7};
    return dSoftMeshCreate(nodes.data(), 8, tets, 2);
}

struct Totals {
    int bodies = 0, stopped = 0, unhooked = 0;
    unsigned long steps = 0, tests = 0, contacts = 0;
};

/// Never destroyed: programs end worlds at exit, too.
struct State {
    std::vector<dWorldID> bare;                     ///< the program's worlds without a soft world
    std::vector<dSpaceID> waiting;                  ///< spaces made before any world
    std::vector<std::pair<dSpaceID, dWorldID>> own; ///< spaces that were given a world of ours
    Totals totals;
};
State& state() {
    static auto* all = new State;
    return *all;
}

void ended(void*, dSoftWorldID world) {
    Totals& t = state().totals;
    dSoftWorldStats stats{};
    stats.struct_size = sizeof stats;
    dSoftWorldGetStats(world, &stats);
    t.steps += stats.steps;
    t.tests += stats.contact_tests;
    t.contacts += stats.contact_points;
}

void body_ended(void*, dSoftBodyID body) {
    dSoftStatus status{};
    status.struct_size = sizeof status;
    dSoftBodyGetStatus(body, &status);
    state().totals.stopped += status.stopped;
}

void put_body(dWorldID world, dSpaceID space) {
    const dSoftWorldID soft = dSoftWorldCreate(world, space);
    const dSoftMeshID mesh = far_corners();
    dSoftSolid rubber = dSoftSolidDefault();
    rubber.young = 1e4; // waves of 3 m/s: a substep of any step
    rubber.density = 1000;
    const dSoftBodyID body = dSoftBodyCreate(soft, mesh, &rubber);
    dSoftMeshDestroy(mesh);
    int all[8];
    std::iota(all, all + 8, 0);
    if (dSoftBodyPinNodes(body, all, 8) != 8)
        std::abort();
    ++state().totals.bodies;
    state().totals.unhooked += dSoftWorldGetHook(soft) != dSoftHookInterposed;
    dSoftObserver watch{};
    watch.struct_size = sizeof watch;
    watch.data = &state();
    watch.on_world_end = &ended;
    watch.on_body_end = &body_ended;
    dSoftWorldAddObserver(soft, &watch);
}

} // namespace

void on_world(dWorldID world) {
    State& s = state();
    if (s.waiting.empty()) {
        s.bare.push_back(world);
        return;
    }
    put_body(world, s.waiting.back());
    s.waiting.pop_back();
}

void on_world_end(dWorldID world) { std::erase(state().bare, world); }

void on_space(dSpaceID space) {
    State& s = state();
    if (s.bare.empty()) {
        s.waiting.push_back(space);
        return;
    }
    put_body(s.bare.back(), space);
    s.bare.pop_back();
}

void on_body_placed(dWorldID world) {
    State& s = state();
    // Spaces that outnumber worlds, and worlds without a space, get one of ours to go with.
    for (const dSpaceID space : s.waiting) {
        s.own.emplace_back(space, dWorldCreate());
        put_body(s.own.back().second, space);
    }
    s.waiting.clear();
    const auto bare = std::find(s.bare.begin(), s.bare.end(), world);
    if (bare == s.bare.end())
        return;
    s.bare.erase(bare);
    put_body(world, dSimpleSpaceCreate(nullptr));
}

void on_collide(dSpaceID space) {
    State& s = state();
    const auto waits = std::find(s.waiting.begin(), s.waiting.end(), space);
    if (waits == s.waiting.end())
        return;
    s.waiting.erase(waits);
    s.own.emplace_back(space, dWorldCreate());
    put_body(s.own.back().second, space);
}

void on_space_end(dSpaceID space) {
    State& s = state();
    std::erase(s.waiting, space);
    const auto with = std::find_if(s.own.begin(), s.own.end(),
                                   [&](const auto& pair) { return pair.first == space; });
    if (with == s.own.end())
        return;
    dWorldDestroy(with->second);
    s.own.erase(with);
}

void on_closed() {
    const Totals& t = state().totals;
    const char* path = std::getenv("CONFORMANCE_SOFT_REPORT");
    std::FILE* out = path ? std::fopen(path, "w") : nullptr;
    if (!out)
        return;
    std::fprintf(out, "bodies %d\nsteps %lu\ntests %lu\ncontacts %lu\nstopped %d\nunhooked %d\n",
                 t.bodies, t.steps, t.tests, t.contacts, t.stopped, t.unhooked);
    std::fclose(out);
}

} // namespace ode::conformance
