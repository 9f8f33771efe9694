#include "view/corner_values.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_corner_values(nb::module_ &m) {
    m.doc() =
        "Values of hexes, of_hexes (m,) float64, from values at their nodes, of_nodes (n,) float64. The functions run\n"
        "on one thread, because the window's thread calls them.";
    m.def("largest", &largest, "hexes"_a, "of_nodes"_a, "of_hexes"_a, ReleaseGil(), "The largest of the eight values.");
    m.def("mean", &mean, "hexes"_a, "of_nodes"_a, "of_hexes"_a, ReleaseGil(), "The mean of the eight values.");
}

}  // namespace hexmend
