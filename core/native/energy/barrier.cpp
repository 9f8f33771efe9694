#include "energy/barrier.hpp"

#include "energy/tetrahedron.hpp"

namespace hexmend {

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

}  // namespace hexmend
