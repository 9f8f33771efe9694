// Numbers as text.
#pragma once

#include <string>

#include "mesh/array_views.hpp"

namespace hexmend {

using Wholes = std::span<const std::int64_t>;

std::string decimal_lines(Numbers values, std::int64_t width, Wholes last);

std::string whole_lines(Wholes values, std::int64_t width);

}  // namespace hexmend
