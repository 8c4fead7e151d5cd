#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace ode::soft {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// Hands out storage on 64-byte boundaries: one cache line, one AVX-512 register.
template <class T>
struct AlignedAllocator {
    using value_type = T;
    static constexpr std::align_val_t kAlignment{64};

    AlignedAllocator() = default;
    template <class U>
    AlignedAllocator(const AlignedAllocator<U>&) noexcept {}

    T* allocate(std::size_t n) {
        return static_cast<T*>(::operator new(n * sizeof(T), kAlignment));
    }
    void deallocate(T* p, std::size_t) noexcept { ::operator delete(p, kAlignment); }
    template <class U>
    bool operator==(const AlignedAllocator<U>&) const noexcept {
        return true;
    }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// One 3-vector per node, stored x y z 0, so that a node is one 32-byte register load. The fourth
/// number stays zero: kernels rely on it.
class NodeArray {
public:
    static constexpr int kStride = 4; ///< doubles from node to node

    NodeArray() = default;
    explicit NodeArray(std::size_t nodes) : value_(nodes * kStride, 0.0) {}

    std::size_t size() const noexcept { return value_.size() / kStride; }
    double* data() noexcept { return value_.data(); }
    const double* data() const noexcept { return value_.data(); }
    Eigen::Map<Vec3> operator[](std::size_t node) noexcept {
        return Eigen::Map<Vec3>(value_.data() + kStride * node);
    }
    Eigen::Map<const Vec3> operator[](std::size_t node) const noexcept {
        return Eigen::Map<const Vec3>(value_.data() + kStride * node);
    }
    void set_zero() noexcept { std::fill(value_.begin(), value_.end(), 0.0); }

private:
    AlignedVector<double> value_;
};

} // namespace ode::soft
