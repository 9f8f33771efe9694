// Counting values by bins; on one thread, because a window's thread asks.
#pragma once

#include "mesh/array_views.hpp"

namespace hexmend {

void count(Numbers values, std::span<const bool> inverted, double low, double scale, bool open_low, bool open_high,
           std::span<std::int64_t> counts);

}  // namespace hexmend
