// Vector registers whose lanes hold one number of each of several hexes.
//
// Formulas are templates over T: `Lanes` for several hexes at once, `double` for one. Vectors are the extension of GCC
// and Clang, as wide as the registers of the processor that the module is compiled for.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#if defined(__AVX__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__ARM_NEON)
#include <arm_neon.h>
#endif

namespace hexmend {

#if defined(__AVX512F__)
constexpr int LANES = 8;
#elif defined(__AVX__)
constexpr int LANES = 4;
#else
constexpr int LANES = 2;
#endif

typedef double Lanes __attribute__((vector_size(8 * LANES)));
typedef std::int64_t Bits __attribute__((vector_size(8 * LANES)));

template <class T> constexpr int width = sizeof(T) / sizeof(double);
template <class T> using bits_of = std::conditional_t<std::is_same_v<T, double>, std::int64_t, Bits>;

constexpr double INF = std::numeric_limits<double>::infinity();

// A vector with x in each lane.
template <class T> inline T broadcast(double x) {
    if constexpr (width<T> == 1) return x;
    else return x - Lanes{};
}

template <class T> inline double lane(const T &x, int i) {
    if constexpr (width<T> == 1) return x;
    else return x[i];
}

template <class T> inline void set_lane(T &x, int i, double value) {
    if constexpr (width<T> == 1) x = value;
    else x[i] = value;
}

inline double sqrt(double x) { return __builtin_sqrt(x); }

inline Lanes sqrt(Lanes x) {
#if defined(__AVX512F__)
    return _mm512_sqrt_pd(x);
#elif defined(__AVX__)
    return _mm256_sqrt_pd(x);
#elif defined(__SSE2__)
    return _mm_sqrt_pd(x);
#elif defined(__ARM_NEON)
    return vsqrtq_f64(x);
#else
    for (int i = 0; i < LANES; ++i) x[i] = __builtin_sqrt(x[i]);
    return x;
#endif
}

// Sum of the lanes in a fixed order, so that it does not depend on the compiler: halves, then their halves.
inline double sum_of_lanes(const Lanes &x) {
#if defined(__AVX512F__)
    auto four = __builtin_shufflevector(x, x, 0, 1, 2, 3) + __builtin_shufflevector(x, x, 4, 5, 6, 7);
    auto two = __builtin_shufflevector(four, four, 0, 1) + __builtin_shufflevector(four, four, 2, 3);
    return two[0] + two[1];
#elif defined(__AVX__)
    auto two = __builtin_shufflevector(x, x, 0, 1) + __builtin_shufflevector(x, x, 2, 3);
    return two[0] + two[1];
#else
    return x[0] + x[1];
#endif
}

// Minimum and maximum; b where a or b is NaN, unlike those of the standard library.
template <class T> inline T min(T a, T b) { return a < b ? a : b; }
template <class T> inline T max(T a, T b) { return a > b ? a : b; }
template <class T> inline T abs(T a) { return max(a, -a); }

// Reinterpret the bits of a number or vector; std::bit_cast does not take vectors with all compilers.
template <class To, class From> inline To bit_cast(From x) {
    static_assert(sizeof(To) == sizeof(From));
    To y;
    std::memcpy(&y, &x, sizeof y);
    return y;
}

// Return x such that the compiler cannot contract the product x with a sum to a fused multiply-add: the sum then has
// the same bits in every kernel, on every processor and in NumPy.
template <class Real>
    requires std::is_floating_point_v<Real>
inline Real uncontracted(Real x) {
#if defined(__SSE2__)
    asm("" : "+x"(x));
#elif defined(__ARM_NEON)
    asm("" : "+w"(x));
#else
    volatile Real y = x;
    x = y;
#endif
    return x;
}

inline Lanes uncontracted(Lanes x) {
#if defined(__AVX512F__)
    asm("" : "+v"(x));
#elif defined(__SSE2__)
    asm("" : "+x"(x));
#elif defined(__ARM_NEON)
    asm("" : "+w"(x));
#else
    for (int i = 0; i < LANES; ++i) x[i] = uncontracted(x[i]);
#endif
    return x;
}

}  // namespace hexmend
