#include "softsound/modes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace softsound {
namespace {

struct HalfSpace {
    int axis;
    bool below;
    double value; ///< [m]

    bool holds(const dReal* x) const { return below ? x[axis] < value : x[axis] > value; }
};

HalfSpace read_condition(const std::string& given) {
    std::string text = given;
    text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
    const auto refuse = [&] {
        throw std::runtime_error("--clamp '" + given +
                                 "' can't be read: write an axis, < or >, and a value in metres, "
                                 "such as 'x<1e-6'");
    };
    if (text.size() < 3 || text[0] < 'x' || text[0] > 'z' || (text[1] != '<' && text[1] != '>'))
        refuse();
    char* end = nullptr;
    const double value = std::strtod(text.c_str() + 2, &end);
    if (*end || std::isnan(value))
        refuse();
    return {text[0] - 'x', text[1] == '<', value};
}

} // namespace

Bounds bounds_of(dSoftMeshID mesh) {
    Bounds b{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    const dReal* x = nullptr;
    for (int i = dSoftMeshGetNodes(mesh, &x); i > 0; --i, x += 3)
        for (int axis = 0; axis < 3; ++axis) {
            b.low[axis] = std::min(b.low[axis], x[axis]);
            b.high[axis] = std::max(b.high[axis], x[axis]);
        }
    return b;
}

std::vector<int> clamped_nodes(dSoftMeshID mesh, const std::vector<std::string>& conditions) {
    const dReal* x = nullptr;
    const int count = dSoftMeshGetNodes(mesh, &x);
    std::vector<char> held(static_cast<std::size_t>(count), 0);
    for (const std::string& text : conditions) {
        const HalfSpace condition = read_condition(text);
        bool any = false;
        for (int i = 0; i < count; ++i)
            if (condition.holds(x + 3 * i))
                held[static_cast<std::size_t>(i)] = any = true;
        if (!any) {
            const Bounds b = bounds_of(mesh);
            char range[80];
            std::snprintf(range, sizeof range, "%c runs from %g to %g m", 'x' + condition.axis,
                          b.low[condition.axis], b.high[condition.axis]);
            throw std::runtime_error("--clamp '" + text + "' catches no node: in this mesh " +
                                     range);
        }
    }
    std::vector<int> nodes;
    for (int i = 0; i < count; ++i)
        if (held[static_cast<std::size_t>(i)])
            nodes.push_back(i);
    return nodes;
}

} // namespace softsound
