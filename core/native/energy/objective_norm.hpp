// The power of a hex's energy in the objective, (3.3).
#pragma once

#include <cmath>

namespace hexmend {

// The objective is the p-norm of eta(H) = mean eta(T) - offset; kernels sum eta(H)^p. The offset is 1 in (B.20) and 0
// in chapter 4, 4.1.1.
struct ObjectiveNorm {
    double p = 2, offset = 1;
};

// First and second derivative of max(eta, 0)^p by eta.
struct PowerDerivatives {
    double first, second;
};

inline PowerDerivatives power_derivatives(double energy, double p) {
    if (energy < 0) return {0.0, 0.0};
    if (p == 2) return {2 * energy, 2.0};
    if (p == 1) return {1.0, 0.0};
    if (energy == 0) return {0.0, 0.0};
    double first = p * std::pow(energy, p - 1);
    return {first, (p - 1) * first / energy};
}

}  // namespace hexmend
