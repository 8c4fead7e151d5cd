# Usage requirement "numerics": bits repeat. The compiler may not fuse or reorder arithmetic by
# itself; kernels that want fused multiply-add say so in their SIMD lane. EIGEN_MPL2_ONLY keeps
# Eigen's few LGPL parts out.
add_library(numerics INTERFACE)
target_compile_options(numerics INTERFACE -ffp-contract=off)
target_compile_definitions(numerics INTERFACE EIGEN_MPL2_ONLY)
target_link_libraries(numerics INTERFACE Eigen3::Eigen)
