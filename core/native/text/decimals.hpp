// Numbers as decimal text.
#pragma once

#include <string>

#include "mesh/array_views.hpp"

namespace hexmend {

using Integers = std::span<const std::int64_t>;

// Rows of `width` numbers and, unless `last` is empty, an integer.
std::string decimal_lines(Numbers values, std::int64_t width, Integers last);

// Rows of `width` integers.
std::string whole_lines(Integers values, std::int64_t width);

}  // namespace hexmend
