#include "smoothers/line_search.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_line_search(nb::module_ &m) {
    m.doc() = "Step length: Algorithm A.5.";
    nb::class_<LineSearch>(m, "LineSearch", "Backtracking line search with the Armijo condition, Algorithm A.5.")
        .def(nb::init<double, double, double, int>(), "initial_step"_a = 1.0, "backtrack_factor"_a = 0.7, "c1"_a = 1e-4,
             "max_backtracks"_a = 100,
             "initial_step is the first step length alpha, backtrack_factor the factor lambda by which a rejected step "
             "is\n"
             "shortened, c1 the share of the slope that a step must descend.")
        .def_ro("initial_step", &LineSearch::initial_step)
        .def_ro("backtrack_factor", &LineSearch::backtrack_factor)
        .def_ro("c1", &LineSearch::c1)
        .def_ro("max_backtracks", &LineSearch::max_backtracks)
        .def(
            "with_initial_step",
            [](const LineSearch &search, double initial_step) {
                LineSearch other = search;
                other.initial_step = initial_step;
                return other;
            },
            "initial_step"_a, "Search that begins with another step length.\n")
        .def(
            "__call__",
            [](const LineSearch &search, const nb::callable &energy_along, double value, double slope) {
                int trials = 0;
                double alpha = search(value, slope, [&](double alpha, double) {
                    ++trials;
                    return nb::cast<double>(energy_along(alpha));
                });
                return std::pair{alpha, trials - 1};
            },
            "energy_along"_a, "value"_a, "slope"_a,
            "Find a step that descends: (alpha, number of backtracks); alpha is 0 if none descends.\n\n"
            "energy_along maps alpha to f(x + alpha p), +inf beyond the barrier; value is f(x), slope the derivative\n"
            "along p, below 0. The search also ends where the expected descent is lost in the rounding of value.");
}

}  // namespace hexmend
