#pragma once

#include "base/lane.h"

namespace ode::soft {

/// A number that counts the operations done with it; a fused multiply-add is two.
struct Counted {
    double value = 0;
    static inline long operations = 0;

    Counted() = default;
    Counted(double v) : value(v) {}
    Counted operator-() const { return Counted(-value); } // folded into the multiply-add
    friend Counted operator+(Counted a, Counted b) { return tick(a.value + b.value); }
    friend Counted operator-(Counted a, Counted b) { return tick(a.value - b.value); }
    friend Counted operator*(Counted a, Counted b) { return tick(a.value * b.value); }
    friend Counted operator/(Counted a, Counted b) { return tick(a.value / b.value); }
    static Counted tick(double v, int n = 1) {
        operations += n;
        return Counted(v);
    }
};

/// Runs a kernel one element at a time and counts its floating-point operations.
struct CountingLane {
    static constexpr int kWidth = 1;
    using Value = Counted;
    struct Points {
        Value at[3];
    };

    static Value load(const double* p) { return *p; }
    static Value fma(Value a, Value b, Value c) {
        return Counted::tick(a.value * b.value + c.value, 2);
    }
    static Value min(Value a, Value b) {
        return Counted::tick(a.value < b.value ? a.value : b.value);
    }
    static Value max(Value a, Value b) {
        return Counted::tick(a.value > b.value ? a.value : b.value);
    }
    static Points gather(const double* base, const unsigned* at) {
        return {{base[*at], base[*at + 1], base[*at + 2]}};
    }
    static Points sum(const Points& a, const Points& b) {
        return {{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2]}};
    }
    static Points difference(const Points& a, const Points& b) {
        return {{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]}};
    }
    static void to_lanes(const Points& p, Value out[3]) {
        for (int i = 0; i < 3; ++i)
            out[i] = p.at[i];
    }
    static Points to_points(const Value in[3]) { return {{in[0], in[1], in[2]}}; }
    template <int kWhich>
    static void add(double* node, const Points& p) {
        for (int i = 0; i < 3; ++i)
            node[i] = (node[i] + p.at[i]).value;
    }
    template <int kWhich>
    static void subtract(double* node, const Points& p) {
        for (int i = 0; i < 3; ++i)
            node[i] = (node[i] - p.at[i]).value;
    }
};

} // namespace ode::soft
