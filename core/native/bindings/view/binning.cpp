#include "view/binning.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_binning(nb::module_ &m) {
    m.doc() = "Counting values by bins; on one thread, because a window's thread asks.";
    m.def("count", &count, "values"_a, "inverted"_a, "low"_a, "scale"_a, "open_low"_a, "open_high"_a, "counts"_a,
          ReleaseGil(),
          "How many values (m,) float64 lie in each of equal bins from low on, scale bins for every 1.\n\n"
          "Writes counts (bins + 3,) int64, at least one bin: after the bins those above and below them, where these "
          "ends\n"
          "are open, else they belong to the bin there; last those that are inverted (m,) bool, or no numbers.");
}

}  // namespace hexmend
