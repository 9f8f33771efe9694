// Histograms. They run on one thread, because the window's thread calls them.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

// Count values (m,) in equal bins from `low` on, `scale` bins per unit. counts (bins + 3,): the bins; values above and
// below, if that end is open (else they count in the outermost bin); inverted hexes and NaN.
void count(Numbers values, std::span<const bool> inverted, double low, double scale, bool open_low, bool open_high,
           std::span<std::int64_t> counts);

}  // namespace hexmend
