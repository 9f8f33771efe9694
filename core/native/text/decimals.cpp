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

void expect_width(std::size_t values, std::int64_t width) {
    expect(width > 0 ? values % width == 0 : values == 0, "values: rows of `width` are expected");
}

}  // namespace

std::string decimal_lines(Numbers values, std::int64_t width, Integers last) {
    expect_width(values.size(), width);
    expect(last.empty() || last.size() * width == values.size(), "last: a number for each row is expected");
    Lines lines;
    std::int64_t column = 0, row = 0;
    for (double value : values) {
        bool end = ++column % width == 0;
        if (value != value) value = std::abs(value);  // NaN is written without sign
        lines.put(value, end && last.empty() ? '\n' : ' ');
        if (end && !last.empty()) lines.put(last[row++], '\n');
    }
    return std::move(lines).text();
}

std::string whole_lines(Integers values, std::int64_t width) {
    expect_width(values.size(), width);
    Lines lines;
    std::int64_t column = 0;
    for (auto value : values) lines.put(value, ++column % width ? ' ' : '\n');
    return std::move(lines).text();
}

}  // namespace hexmend
