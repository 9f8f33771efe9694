// Backtracking line search with the Armijo condition: Algorithm A.5.
#pragma once

#include <cmath>
#include <limits>

namespace hexmend {

// A descent below this share of the value is indistinguishable from rounding; shorter steps descend even less.
constexpr double ROUNDING = 4 * std::numeric_limits<double>::epsilon();

// Parameters and loop of the search, for one node, a patch or all nodes of a mesh.
struct LineSearch {
    double initial_step;      // the first step length alpha
    double backtrack_factor;  // lambda in (0, 1), by which a rejected step is shortened
    double c1;                // share of the slope that a step must descend
    int max_backtracks;

    // Return the accepted step length, or 0.
    //
    // `value` is f where the search starts and `slope` < 0 its derivative along the direction. try_step(alpha, bound)
    // returns f at the step alpha, or INF where that step is inadmissible; f below `bound` accepts the step. The search
    // gives up after max_backtracks + 1 trials, or after a rejected trial whose expected descent is lost in the
    // rounding of `value`: near a minimiser it then costs one evaluation instead of a hundred.
    template <class TryStep> double operator()(double value, double slope, const TryStep &try_step) const {
        double alpha = initial_step;
        for (int backtracks = 0; backtracks <= max_backtracks; ++backtracks, alpha *= backtrack_factor) {
            double bound = value + c1 * alpha * slope;
            if (try_step(alpha, bound) < bound) return alpha;
            if (-alpha * slope < ROUNDING * std::abs(value)) return 0;
        }
        return 0;
    }
};

}  // namespace hexmend
