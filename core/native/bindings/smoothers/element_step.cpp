#include "smoothers/element_step.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {
void bind_element_step(nb::module_ &m) {
    m.doc() = "GETMe's element step, which makes one hex more regular.";
    m.def(
        "element_steps", &element_steps, "points"_a, "hexes"_a, "s"_a, "rho"_a, "places"_a, ReleaseGil(),
        "Targets of the corners of every hex; writes places (m, 8, 3).\n"
        "\n"
        "Corner k moves to c_k + s n_k/sqrt(|n_k|), centroid and normal of the triangle of the centroids of its three\n"
        "faces; the hex is scaled to its old mean edge length and blended with the old one by rho.\n"
        "Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.");
}

}  // namespace hexmend
