#include "../decimals.hpp"

#include "arrays.hpp"

namespace hexmend {

void bind_decimals(nb::module_ &m) {
    m.doc() = "Numbers as text.";
    m.def("lines", [](Numbers values, std::int64_t width) {
        std::string text;
        {
            WithoutLock unlocked;
            text = decimals(values, width);
        }
        return nb::bytes(text.data(), text.size());
    }, "values"_a, "width"_a, "Rows of `width` numbers, each the shortest text that gives the same number back.");
}

}  // namespace hexmend
