#include "hook/step_length.h"

#include "hook/threading_shim.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace ode::soft {
namespace {

// What is looked through: the context has seven words in version 0.16, and lies on the stack of
// dWorldStep's callee, so that a few more can be read.
constexpr std::size_t kWords = 12;

// No pointer, no count: bit patterns that nothing else on the stack has.
constexpr std::array kLengths{0.0123456789012345, 0.00987654321098765, 0.000314159265358979};

/// Strikes out the places that don't hold the length of the step.
class Search final : public StepListener {
public:
    double length = 0;
    std::array<bool, kWords> possible;
    int steps = 0;

    Search() { possible.fill(true); }

    void on_step_posted(const void* context) noexcept override {
        ++steps;
        for (std::size_t i = 0; i < kWords; ++i)
            possible[i] = possible[i] && read_step_length(context, i * sizeof length) == length;
    }
    void on_step_done() noexcept override {}
    void on_released() noexcept override {}
};

std::optional<std::size_t> measure() {
    Search search;
    ThreadingShim shim(search);
    if (!shim.usable())
        return {};
    const dWorldID world = dWorldCreate();
    shim.give_to(world);
    for (const double length : kLengths) {
        search.length = length;
        dWorldStep(world, length);
        dWorldQuickStep(world, length);
    }
    dWorldDestroy(world);
    if (search.steps != 2 * static_cast<int>(kLengths.size()) ||
        std::count(search.possible.begin(), search.possible.end(), true) != 1)
        return {};
    const auto found = std::find(search.possible.begin(), search.possible.end(), true);
    return static_cast<std::size_t>(found - search.possible.begin()) * sizeof(double);
}

} // namespace

std::optional<std::size_t> step_length_offset() {
    static const std::optional<std::size_t> offset = measure();
    return offset;
}

double read_step_length(const void* context, std::size_t offset) noexcept {
    double length = 0;
    std::memcpy(&length, static_cast<const char*>(context) + offset, sizeof length);
    return length;
}

} // namespace ode::soft
