#include "bindings/arrays.hpp"
#include "text/decimals.hpp"

namespace hexmend {

namespace {

// Text made without the interpreter's lock, as bytes.
template <class Make> nb::bytes text(const Make &make) {
    std::string made;
    {
        GilRelease unlocked;
        made = make();
    }
    return nb::bytes(made.data(), made.size());
}

}  // namespace

void bind_decimals(nb::module_ m) {
    m.doc() = "Numbers as decimal text, in bytes.";
    m.def(
        "decimal_lines",
        [](Numbers values, std::int64_t width, Integers last) {
            return text([&] { return decimal_lines(values, width, last); });
        },
        "values"_a, "width"_a, "last"_a,
        "Rows of `width` numbers, each the shortest text that gives the same number back, and behind them one of\n"
        "`last` (rows,), whole numbers, if it has any.");
    m.def(
        "whole_lines",
        [](Integers values, std::int64_t width) { return text([&] { return whole_lines(values, width); }); },
        "values"_a, "width"_a, "Rows of `width` whole numbers.");
}

}  // namespace hexmend
