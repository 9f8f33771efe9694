#include "linear/symmetric.hpp"

#include <nanobind/stl/array.h>

#include "bindings/arrays.hpp"
#include "smoothers/node_step.hpp"

namespace hexmend {
namespace {

SymmetricMatrix symmetric(const std::array<double, 6> &a) { return {a[0], a[1], a[2], a[3], a[4], a[5]}; }
V3<double> vector(const std::array<double, 3> &a) { return {a[0], a[1], a[2]}; }

std::pair<double, double> extremes(std::array<double, 6> a) {
    auto [smallest, largest] = extreme_eigenvalues(symmetric(a));
    return {smallest, largest};
}

std::array<double, 3> solution(std::array<double, 6> a, std::array<double, 3> b) {
    auto x = solve(symmetric(a), vector(b));
    return {x.x, x.y, x.z};
}

std::array<double, 3> direction(std::array<double, 6> hessian, std::array<double, 3> gradient, bool modified) {
    SymmetricMatrix matrix = symmetric(hessian);
    auto p = newton_direction(matrix, vector(gradient), modified ? eigenvalue_shift(matrix) : 0.0);
    return {p.x, p.y, p.z};
}

}  // namespace

void bind_symmetric(nb::module_ &m) {
    m.doc() = "Symmetric 3 x 3 matrices, given as (xx, xy, xz, yy, yz, zz).";
    m.def("extreme_eigenvalues", &extremes, "a"_a, "Smallest and largest eigenvalue (Smith 1961).");
    m.def("solve", &solution, "a"_a, "b"_a, "Solution of the linear system; zero where the matrix is singular.");
    m.def("newton", &direction, "hessian"_a, "gradient"_a, "modified"_a,
          "Search direction of Algorithm A.3 or, modified, A.4, at a node.");
}

}  // namespace hexmend
