#include "linear/eigenvalues.hpp"

#include "smoothers/node_step.hpp"

namespace hexmend {
namespace {

SymmetricMatrix symmetric(const std::array<double, 6> &a) { return {a[0], a[1], a[2], a[3], a[4], a[5]}; }
V3<double> vector(const std::array<double, 3> &a) { return {a[0], a[1], a[2]}; }

}  // namespace

std::pair<double, double> extremes_of(std::array<double, 6> a) {
    auto [smallest, largest] = extreme_eigenvalues(symmetric(a));
    return {smallest, largest};
}

std::array<double, 3> solution_of(std::array<double, 6> a, std::array<double, 3> b) {
    auto x = solve(symmetric(a), vector(b));
    return {x.x, x.y, x.z};
}

std::array<double, 3> newton_step(std::array<double, 6> hessian, std::array<double, 3> gradient, bool modified) {
    SymmetricMatrix matrix = symmetric(hessian);
    auto p = newton_direction(matrix, vector(gradient), modified ? eigenvalue_shift(matrix) : 0.0);
    return {p.x, p.y, p.z};
}

}  // namespace hexmend
