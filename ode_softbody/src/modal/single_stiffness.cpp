#include "modal/single_stiffness.h"

#include "modal/avx2.h"
#include "modal/block_rows.h"

namespace ode::soft {
namespace {

template <int lanes>
ODE_SOFTBODY_AVX2 void rows_wide(const BlockSystem& s, const float* stiffness, const float* x,
                                 float* y, std::size_t stride) {
    stiffness_rows<float, lanes>(s, stiffness, x, y, stride);
}

} // namespace

SingleStiffness::SingleStiffness(const BlockSystem& system)
    : pattern_(system), stiffness_(system.stiffness.begin(), system.stiffness.end()) {}

void SingleStiffness::multiply(const RowMatrixF& x, RowMatrixF& y) const {
    y.resize(x.rows(), x.cols());
    const auto stride = static_cast<std::size_t>(x.cols());
    in_lanes(stride, [&]<int lanes>(std::integral_constant<int, lanes>, std::size_t v) {
        if (has_avx2())
            rows_wide<lanes>(pattern_, stiffness_.data(), x.data() + v, y.data() + v, stride);
        else
            stiffness_rows<float, lanes>(pattern_, stiffness_.data(), x.data() + v, y.data() + v,
                                         stride);
    });
}

} // namespace ode::soft
