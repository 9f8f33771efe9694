#include "text/decimals.hpp"

#include <charconv>
#include <cmath>

namespace hexmend {
namespace {

// Text to which numbers are appended.
class Lines {
  public:
    template <class Number> void put(Number value, char behind) {
        auto end = text_.size();
        text_.resize(end + LONGEST);
        char *last = std::to_chars(text_.data() + end, text_.data() + end + LONGEST - 1, value).ptr;
        *last++ = behind;
        text_.resize(last - text_.data());
    }

    std::string &&text() && { return std::move(text_); }

  private:
    static constexpr std::size_t LONGEST = 32;  // of one number and the separator after it
    std::string text_;
};

// Rows of `width` values, and behind each one of `last`, if it has any.
template <class Number> std::string lines_of(std::span<const Number> values, std::int64_t width, Integers last) {
    expect(width > 0 ? values.size() % width == 0 : values.empty(), "values: rows of `width` are expected");
    expect(last.empty() || last.size() * width == values.size(), "last: a number for each row is expected");
    Lines lines;
    std::int64_t column = 0, row = 0;
    for (Number value : values) {
        bool end = ++column % width == 0;
        if (value != value) value = std::abs(value);  // NaN is written without sign
        lines.put(value, end && last.empty() ? '\n' : ' ');
        if (end && !last.empty()) lines.put(last[row++], '\n');
    }
    return std::move(lines).text();
}

}  // namespace

std::string decimal_lines(Numbers values, std::int64_t width, Integers last) { return lines_of(values, width, last); }
std::string whole_lines(Integers values, std::int64_t width) { return lines_of(values, width, {}); }

}  // namespace hexmend
