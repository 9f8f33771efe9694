#include "smoothers/worst_first.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_worst_first(nb::module_ &m) {
    m.doc() = "Sequential GETMe: the worst hex takes its element step, again and again, from a priority queue.";
    nb::class_<WorstFirstSettings>(m, "WorstFirstSettings", "Settings of the element steps.")
        .def(nb::init<double, double, double, double>(), "scaling"_a, "relaxation"_a, "penalty"_a,
             "rejection_penalty"_a,
             "scaling and relaxation are the scale s and the blend rho of an element step. After it the hex ranks as\n"
             "better by penalty if the step was accepted and by rejection_penalty if not, in q(H).");
    m.def("sweep", &sweep, "points"_a, "mesh"_a, "free"_a, "candidates"_a, "q"_a, "sound"_a, "settings"_a,
          "surface"_a.none() = nb::none(), ReleaseGil(),
          "Take as many element steps as there are candidates, each of the hex that is worst at the time; returns the\n"
          "number of rejected steps, those that inverted a sound hex.\n"
          "\n"
          "points (n, 3), changed, end at the best state reached: fewest inverted hexes, then highest q_min, then "
          "highest\n"
          "q_mean. free (n,) bool; candidates (k,) int32: the hexes that have a free node. q (m,) float64 and sound "
          "(m,)\n"
          "bool, as measured at points, are changed to those of the last state, which need not be the best. With a\n"
          "surface each element step is projected before it is checked.");
}

}  // namespace hexmend
