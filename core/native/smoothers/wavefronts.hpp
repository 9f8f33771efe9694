// In what order a sweep visits nodes, and which of them it can visit at the same time.
#pragma once

#include "mesh/incidence.hpp"

namespace hexmend {

OwnedArray<std::int32_t> levels(Indices ring_start, Indices ring, std::span<const bool> from);

CSR wavefronts(Indices start, Indices corners, Indices sequence);

}  // namespace hexmend
