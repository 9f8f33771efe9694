#include "decimals.hpp"

#include <charconv>

namespace hexmend {

std::string decimals(Numbers values, std::int64_t width) {
    constexpr std::size_t LONGEST = 32;  // of one number and what stands behind it
    std::string text;
    std::int64_t column = 0;
    for (double value : values) {
        std::size_t end = text.size();
        text.resize(end + LONGEST);
        char *last = std::to_chars(text.data() + end, text.data() + end + LONGEST - 1, value).ptr;
        *last++ = ++column % width ? ' ' : '\n';
        text.resize(last - text.data());
    }
    return text;
}

}  // namespace hexmend
