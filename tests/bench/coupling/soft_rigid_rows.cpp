#include "bench/coupling/coupling_table.h"
#include "support/thrown_shapes.h"

#include <cmath>

namespace ode::soft {

Table soft_rigid_table(bool brief) {
    constexpr double kMean = 0.5;      // [%]
    constexpr double kGain = 1;        // [%]
    constexpr double kMomentum = 1e-6; // relative
    Table table("soft and rigid", {"thrown on a free soft plate", "energy, mean %", "worst %",
                                   "highest %", "momentum", "angular", "us/substep, watched"});
    const unsigned throws = brief ? 3 : 12;
    for (const test::Shape shape :
         {test::Shape::sphere, test::Shape::box, test::Shape::capsule, test::Shape::cylinder}) {
        test::ShapeOutcome all{};
        double mean = 0;
        for (unsigned seed = 0; seed < throws; ++seed) {
            const test::ShapeOutcome o = test::throw_shape(shape, seed);
            mean += std::fabs(o.change) / throws;
            all.change = std::fmin(all.change, o.change);
            all.highest = std::fmax(all.highest, o.highest);
            all.momentum = std::fmax(all.momentum, o.momentum);
            all.angular = std::fmax(all.angular, o.angular);
            all.seconds += o.seconds;
            all.substeps += o.substeps;
        }
        table.add({test::name_of(shape),
                   {"%.2f", 100 * mean, kMean},
                   {"%.2f", 100 * all.change},
                   {"%+.2f", 100 * all.highest, kGain},
                   {"%.0e", all.momentum, kMomentum},
                   {"%.0e", all.angular, kMomentum},
                   {"%.1f", 1e6 * all.seconds / all.substeps}});
    }
    return table;
}

} // namespace ode::soft
