#include "../symmetric.hpp"

#include <nanobind/stl/array.h>

#include "../visit.hpp"
#include "arrays.hpp"

namespace hexmend {
namespace {

Symmetric symmetric(const std::array<double, 6> &a) { return {a[0], a[1], a[2], a[3], a[4], a[5]}; }
V3<double> vector(const std::array<double, 3> &a) { return {a[0], a[1], a[2]}; }
std::tuple<double, double, double> numbers(const V3<double> &a) { return {a.x, a.y, a.z}; }

}  // namespace

void bind_symmetric(nb::module_ &m) {
    m.doc() = "Symmetric 3 x 3 matrices, xx xy xz yy yz zz.";
    m.def("extreme_eigenvalues", [](std::array<double, 6> a) {
        auto [least, greatest] = extreme_eigenvalues(symmetric(a));
        return std::pair(least, greatest);
    }, "a"_a, "Least and greatest eigenvalue (Smith 1961).");
    m.def("solve", [](std::array<double, 6> a, std::array<double, 3> b) { return numbers(solve(symmetric(a), vector(b))); },
          "a"_a, "b"_a, "Solution of the linear system; zero where the matrix is singular.");
    m.def("newton", [](std::array<double, 6> hessian, std::array<double, 3> gradient, bool modified) {
        return numbers(newton(symmetric(hessian), vector(gradient), modified));
    }, "hessian"_a, "gradient"_a, "modified"_a, "The direction of Algorithm A.3 or, modified, A.4, at a node.");
}

}  // namespace hexmend
