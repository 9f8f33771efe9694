#include "element_step.hpp"

namespace hexmend {

void element_steps(Points points, Hexes hexes, double s, double rho, Places places) {
    blocks_of<Lanes>(hexes.size(), [&](std::int64_t first, int count) {
        auto y = element_step(gathered<Lanes>(points, hexes, first, count), s, rho);
        alignas(64) double buffer[24][LANES];
        std::memcpy(buffer, &y, sizeof y);
        for (int i = 0; i < count; ++i)
            for (int k = 0; k < 24; ++k) places[first + i][k] = buffer[k][i];
    });
}

}  // namespace hexmend
