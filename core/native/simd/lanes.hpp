// Hexes side by side: one number of each in a lane of a vector register.
//
// Formulas are templates over T, which is `Lanes` in the kernels and `double` where one hex is taken at a time. Vectors
// are those of GCC and Clang, as wide as the processor's registers: this file is compiled once for each kind of them.
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

// In one order, whatever the compiler: halves are added to each other, and theirs.
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

// Where one of the two is no number it is the second that counts.
template <class T> inline T min(T a, T b) { return a < b ? a : b; }
template <class T> inline T max(T a, T b) { return a > b ? a : b; }
template <class T> inline T abs(T a) { return max(a, -a); }

// A number or vector as the bits that it is made of, and back.
template <class To, class From> inline To bit_cast(From x) {
    static_assert(sizeof(To) == sizeof(From));
    To y;
    std::memcpy(&y, &x, sizeof y);
    return y;
}

// A product that is rounded on its own: never contracted with the sum that it stands in, so that the sum has the same
// bits wherever it is computed. The compiler may look through anything but this.
inline double uncontracted(double x) {
#if defined(__SSE2__)
    asm("" : "+x"(x));
#elif defined(__ARM_NEON)
    asm("" : "+w"(x));
#else
    volatile double y = x;
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
