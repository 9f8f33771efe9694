#include "smoothers/element_step.hpp"

namespace hexmend {

void element_steps(Points points, Hexes hexes, double s, double rho, CornerVectors places) {
    for_each_block<Lanes>(hexes.size(), [&](std::int64_t first, int count) {
        auto y = element_step(gather_corners<Lanes>(points, hexes, first, count), s, rho);
        store(y, first, count, places);
    });
}

}  // namespace hexmend
