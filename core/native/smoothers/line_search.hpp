// When a line search (Algorithm A.5) ends without a step.
#pragma once

#include <limits>

namespace hexmend {

// Less descent than this share of the value cannot be told from rounding; shorter steps descend less.
constexpr double ROUNDING = 4 * std::numeric_limits<double>::epsilon();

// Whether what a step of length alpha is expected to gain is lost in the rounding of the value.
inline bool lost_in_rounding(double alpha, double slope, double value) { return -alpha * slope < ROUNDING * value; }

}  // namespace hexmend
