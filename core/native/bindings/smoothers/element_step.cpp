#include "smoothers/element_step.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {
void bind_element_step(nb::module_ &m) {
    m.doc() = "GETMe's element step: a hex grows more regular by itself.";
    m.def("element_steps", &element_steps, "points"_a, "hexes"_a, "s"_a, "rho"_a, "places"_a, ReleaseGil(),
          "Where the corners of every hex go; writes places (m, 8, 3).\n\n"
          "Corner k goes to c_k + s n_k/sqrt(|n_k|), centroid and normal of the triangle of the centroids of its\n"
          "three faces; the hex keeps its mean edge length, and a share rho of the way is gone.\n"
          "Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.");
}

}  // namespace hexmend
