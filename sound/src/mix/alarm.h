#pragma once

#include <functional>
#include <vector>

namespace ode::sound {

class Scene;

/// Tells of bodies that have gone unstable: by what is heard of them (GrowthWatch), and by what
/// their world did about it.
class Alarm {
public:
    static constexpr double kQuiet = 1.0; ///< of one body, after an alarm [s]

    enum class Cause {
        kHeard,   ///< it vibrates as nothing stable does
        kRedone,  ///< a step of it was taken back
        kStopped, ///< its world has given it up
    };
    /// What the world of a body says of it.
    struct Fare {
        int rollbacks;
        bool stopped;
    };
    using Ask = Fare (*)(const void* body);
    using Tell = std::function<void(const void* body, double time, Cause cause)>;

    /// After a step that ends at `time` [s].
    /// @param tell  called once for each body that has just gone unstable.
    void update(Scene& scene, double time, Ask ask, const Tell& tell);
    void forget(const void* body) noexcept;

    unsigned long count() const noexcept { return count_; }
    double last() const noexcept { return last_; } ///< when it was last raised [s]; 0: never

private:
    struct Watched {
        const void* body;
        Fare fare;
        double heard;  ///< [s]
        double raised; ///< [s]
    };
    Watched& find(const void* body);

    std::vector<Watched> watched_;
    unsigned long count_ = 0;
    double last_ = 0.0;
};

} // namespace ode::sound
