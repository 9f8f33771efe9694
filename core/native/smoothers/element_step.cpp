#include "smoothers/element_step.hpp"

#include <stdexcept>

namespace hexmend {

void element_steps(Points points, Hexes hexes, double s, double rho, CornerVectors places) {
    for_each_block<Lanes>(hexes.size(), [&](std::int64_t first, int count) {
        auto y = element_step(gather_corners<Lanes>(points, hexes, first, count), s, rho);
        store(y, first, count, places);
    });
}

OwnedArray<double, 3> step_of_one(Points corners, double s, double rho) {
    constexpr Hex ALL_EIGHT[] = {{0, 1, 2, 3, 4, 5, 6, 7}};
    if (corners.size() != 8) throw std::invalid_argument("a hex has 8 corners");
    auto y = element_step(gather_corners<double>(corners, ALL_EIGHT, 0, 1), s, rho);
    std::vector<double> places(24);
    std::memcpy(places.data(), &y, sizeof y);
    return {std::move(places)};
}

}  // namespace hexmend
