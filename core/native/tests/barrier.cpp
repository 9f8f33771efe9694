#include "bindings/arrays.hpp"
#include "energy/tetrahedron.hpp"

namespace hexmend {
namespace {

void powers(Numbers h, std::span<double> powers) {
    for (std::size_t i = 0; i < h.size(); ++i) powers[i] = power_minus_two_thirds(broadcast<Lanes>(h[i]))[0];
}

void barriers(Numbers sigma, double delta, std::span<double> h, std::span<double> r) {
    for (std::size_t i = 0; i < sigma.size(); ++i) {
        auto s = broadcast<Lanes>(sigma[i]);
        auto at = delta != 0 ? barrier<true>(s, delta) : barrier<false>(s, delta);
        h[i] = at.h[0], r[i] = at.r[0];
    }
}

}  // namespace

void bind_barrier(nb::module_ &m) {
    m.doc() = "The scalar formulas of a corner tetrahedron, in one lane of a vector register.";
    m.def("power_minus_two_thirds", &powers, "h"_a, "powers"_a, "Write h^(-2/3) of h (n,) to powers (n,), float64.");
    m.def("barrier", &barriers, "sigma"_a, "delta"_a, "h"_a, "r"_a,
          "Write h(sigma) of (3.2) and r = sqrt(sigma^2 + 4 delta^2) of sigma (n,) to h and r (n,), float64.");
}

}  // namespace hexmend
