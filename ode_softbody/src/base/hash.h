#pragma once

#include "base/error.h"

#include <bit>
#include <cstdint>
#include <span>
#include <string>

namespace ode::soft {

/// Two FNV-1a hashes of 64 bits with different offsets, each stirred at the end (SplitMix64).
class Hash {
public:
    void bytes(const void* data, std::size_t size) {
        const auto* p = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) {
            a_ = (a_ ^ p[i]) * 0x100000001B3u;
            b_ = (b_ ^ p[i]) * 0x100000001B3u + 0x9E3779B97F4A7C15u;
        }
    }
    void number(std::uint64_t v) { bytes(&v, sizeof v); }
    void number(double v) { number(std::bit_cast<std::uint64_t>(v == 0 ? 0.0 : v)); } // -0 is 0
    void indices(std::span<const int> v) {
        number(std::uint64_t{v.size()});
        bytes(v.data(), v.size_bytes());
    }
    std::uint64_t first() const { return stir(a_); }
    std::string text() const {
        return format("%016llx%016llx", static_cast<unsigned long long>(stir(a_)),
                      static_cast<unsigned long long>(stir(b_)));
    }

private:
    static std::uint64_t stir(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    std::uint64_t a_ = 0xCBF29CE484222325u, b_ = 0x84222325CBF29CE4u;
};

} // namespace ode::soft
