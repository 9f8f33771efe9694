#include "view/corner_values.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_corner_values(nb::module_ &m) {
    m.doc() =
        "What values at nodes (n,) float64 come to over the corners of each hex; on one thread, because a window's\n"
        "thread asks. Each writes of_hexes (m,) float64.";
    m.def("largest", &largest, "hexes"_a, "of_nodes"_a, "of_hexes"_a, ReleaseGil(), "The largest of the eight values.");
    m.def("mean", &mean, "hexes"_a, "of_nodes"_a, "of_hexes"_a, ReleaseGil(), "The mean of the eight values.");
}

}  // namespace hexmend
