#include "hook/ode_layout.h"

#include "hook/threading_shim.h"

#include <array>

namespace ode::soft {
namespace {

// How far is looked. The context has seven words in version 0.16 and lies on the stack of
// dWorldStep's callee, so that a few more can be read; a world has over sixty, the threading ones
// first.
constexpr std::size_t kWords = 12;
constexpr std::size_t kWord = sizeof(void*);

// No pointer, no count: bit patterns that nothing else on the stack has.
constexpr std::array kLengths{0.0123456789012345, 0.00987654321098765, 0.000314159265358979};

/// The places that held the value looked for, whenever they were looked at.
class Places {
public:
    template <class Value>
    void look(const void* object, Value value) noexcept {
        for (std::size_t i = 0; i < kWords; ++i)
            strange_[i] = strange_[i] || value_at<Value>(object, i * kWord) != value;
    }
    /// @return kWords unless there is exactly one.
    std::size_t only() const noexcept {
        std::size_t found = kWords;
        for (std::size_t i = 0; i < kWords; ++i)
            if (!strange_[i]) {
                if (found != kWords)
                    return kWords;
                found = i;
            }
        return found;
    }

private:
    std::array<bool, kWords> strange_{};
};

class Search final : public StepListener {
public:
    double length = 0;
    Places places;
    int steps = 0;

    void on_step_posted(const void* context) noexcept override {
        ++steps;
        places.look(context, length);
    }
    void on_step_done() noexcept override {}
    void on_released() noexcept override {}
};

std::optional<OdeLayout> measure() {
    Search search;
    ThreadingShim shim(search);
    if (!shim.usable())
        return {};
    const dWorldID world = dWorldCreate();
    shim.give_to(world);
    Places functions;
    Places implementation;
    functions.look(world, ThreadingShim::functions());
    implementation.look(world, shim.id());
    for (const double length : kLengths) {
        search.length = length;
        dWorldStep(world, length);
        dWorldQuickStep(world, length);
    }
    dWorldDestroy(world);
    const std::array found{search.places.only(), functions.only(), implementation.only()};
    for (const std::size_t place : found)
        if (place == kWords || search.steps != 2 * static_cast<int>(kLengths.size()))
            return {};
    return OdeLayout{kWord * found[0], kWord * found[1], kWord * found[2]};
}

} // namespace

std::optional<OdeLayout> ode_layout() {
    static const std::optional<OdeLayout> layout = measure();
    return layout;
}

} // namespace ode::soft
