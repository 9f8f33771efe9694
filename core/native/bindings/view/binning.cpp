#include "view/binning.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_binning(nb::module_ &m) {
    m.doc() = "Histograms. They run on one thread, because the window's thread calls them.";
    m.def("count", &count, "values"_a, "inverted"_a, "low"_a, "scale"_a, "open_low"_a, "open_high"_a, "counts"_a,
          ReleaseGil(),
          "Count values (m,) float64 in equal bins from `low` on, `scale` bins per unit.\n"
          "\n"
          "Writes counts (bins + 3,) int64, at least one bin: the bins; the values above and below them, where that "
          "end is\n"
          "open (else they count in the outermost bin); the values that are inverted (m,) bool or NaN.");
}

}  // namespace hexmend
