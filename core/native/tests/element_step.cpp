#include "smoothers/element_step.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {
namespace {

OwnedArray<double, 3> one_element_step(Points corners, double s, double rho) {
    constexpr Hex ALL_EIGHT[] = {{0, 1, 2, 3, 4, 5, 6, 7}};
    expect(corners.size() == 8, "corners: 8 points are expected");
    auto y = element_step(gather_corners<double>(corners, ALL_EIGHT, 0, 1), s, rho);
    std::vector<double> targets(24);
    std::memcpy(targets.data(), &y, sizeof y);
    return {std::move(targets)};
}

}  // namespace

void bind_element_step(nb::module_ &m) {
    m.doc() = "GETMe's element step of one hex, computed without vectors as `worst_first` does.";
    m.def("element_step", &one_element_step, "x"_a, "s"_a, "rho"_a, "Targets (8, 3) of the corners x (8, 3).");
}

}  // namespace hexmend
