// Harmonics of spherical waves: a part of kernel_bodies.h, which includes it once for each
// instruction set.

namespace ode::sound::ODE_SOUND_ISA_NAMESPACE {
namespace {

/// The last of a register's lanes: ones() + n has n ones at its end.
inline const float* ones() {
    alignas(64) static constexpr auto kSteps = [] {
        struct {
            float value[2 * kFloats];
        } out{};
        for (int i = kFloats; i < 2 * kFloats; ++i)
            out.value[i] = 1.0f;
        return out;
    }();
    return kSteps.value;
}

void by_degree(int order, const float* coefficient, const float* harmonic, float* sum) {
    using Pair [[gnu::vector_size(8)]] = float;
    const float* const last = ones();
    for (int l = 0; l <= order; ++l) {
        const int count = 2 * (2 * l + 1);
        const float *a = coefficient + 2 * l * l, *y = harmonic + 2 * l * l;
        Pair all{};
        if (count < kFloats) {
            for (int i = 0; i < count; i += 2) {
                all[0] += a[i] * y[i];
                all[1] += a[i + 1] * y[i + 1];
            }
        } else {
            Floats part{};
            int i = 0;
            for (; i + kFloats <= count; i += kFloats)
                part += load_floats(a + i) * load_floats(y + i);
            // What is left, from behind: nothing is read beyond the coefficients' end.
            const int end = count - kFloats;
            part += load_floats(last + (count - i)) * load_floats(a + end) * load_floats(y + end);
            for (int k = 0; k < kFloats; k += 2) {
                Pair two;
                __builtin_memcpy(&two, reinterpret_cast<const char*>(&part) + 4 * k, sizeof two);
                all += two;
            }
        }
        sum[2 * l] = all[0];
        sum[2 * l + 1] = all[1];
    }
}

} // namespace
} // namespace ode::sound::ODE_SOUND_ISA_NAMESPACE
