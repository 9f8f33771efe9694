// Numbers as text.
#pragma once

#include <string>

#include "rows.hpp"

namespace hexmend {

std::string decimals(Numbers values, std::int64_t width);

}  // namespace hexmend
