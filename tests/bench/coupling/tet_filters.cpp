#include "bench/coupling/tet_filters.h"

#include "collide/aabb.h"
#include "couple/tet_overlap.h"

#include <ccd/ccd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>

namespace ode::soft {
namespace {

struct Pair {
    Tet a;
    Tet b;
};

constexpr double kSize = 0.01; ///< [m]

std::vector<Pair> make_pairs(int count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> u(-1, 1);
    const auto tet = [&] {
        for (;;) {
            Tet t;
            for (Vec3& x : t)
                x = kSize * Vec3(u(random), u(random), u(random));
            const double volume = (t[1] - t[0]).cross(t[2] - t[0]).dot(t[3] - t[0]) / 6;
            if (volume > 0.1 * kSize * kSize * kSize)
                return t;
        }
    };
    const auto box = [](const Tet& t) {
        Aabb b;
        for (const Vec3& x : t)
            b.include(x);
        return b;
    };
    std::vector<Pair> pairs;
    while (pairs.size() < static_cast<std::size_t>(count)) {
        Pair p{tet(), tet()};
        const Vec3 by = 2 * kSize * Vec3(u(random), u(random), u(random));
        for (Vec3& x : p.b)
            x += by;
        if (box(p.a).overlaps(box(p.b)))
            pairs.push_back(p);
    }
    return pairs;
}

void support(const void* object, const ccd_vec3_t* way, ccd_vec3_t* out) {
    const Tet& t = *static_cast<const Tet*>(object);
    const Vec3 d(way->v[0], way->v[1], way->v[2]);
    const auto top = std::max_element(
        t.begin(), t.end(), [&](const Vec3& x, const Vec3& y) { return x.dot(d) < y.dot(d); });
    const Vec3 x = *top / kSize; // libccd's tolerances are absolute, for shapes of a metre
    ccdVec3Set(out, x.x(), x.y(), x.z());
}

bool ccd_meets(const Pair& p) {
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = &support;
    ccd.support2 = &support;
    ccd.max_iterations = 50;
    return ccdGJKIntersect(&p.a, &p.b, &ccd) != 0;
}

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Keep>
FilterRow run(const char* name, const std::vector<Pair>& pairs, const std::vector<char>& truth,
              Keep keep) {
    std::vector<char> kept(pairs.size());
    double least = HUGE_VAL;
    for (int turn = 0; turn < 5; ++turn) {
        const double start = cpu_seconds();
        for (std::size_t i = 0; i < pairs.size(); ++i)
            kept[i] = keep(pairs[i]);
        least = std::fmin(least, cpu_seconds() - start);
    }
    double through = 0, right = 0;
    long missed = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        through += kept[i];
        right += kept[i] && truth[i];
        missed += !kept[i] && truth[i];
    }
    const auto count = static_cast<double>(pairs.size());
    return {name, 1e9 * least / count, through / count, right / std::fmax(1, through), missed};
}

} // namespace

std::vector<FilterRow> compare_filters(int count) {
    const std::vector<Pair> pairs = make_pairs(count);
    const auto meets = [](const Pair& p) {
        TetOverlap o{};
        // What two roundings could have made is nobody's miss.
        return overlap_of(p.a, p.b, o) && o.volume > 1e-9 * kSize * kSize * kSize;
    };
    std::vector<char> truth;
    for (const Pair& p : pairs)
        truth.push_back(meets(p));
    return {run("eight face planes (ours)", pairs, truth,
                [](const Pair& p) { return face_gap(p.a, p.b) <= 0; }),
            run("libccd, GJK boolean, scaled", pairs, truth, ccd_meets),
            run("the overlap itself, planes first", pairs, truth, meets)};
}

} // namespace ode::soft
