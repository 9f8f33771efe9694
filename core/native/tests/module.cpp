// Extension module of the native functions that only tests call. Wheels do not contain it.
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>

#include "bindings/arrays.hpp"
#include "energy/node_quads.hpp"
#include "smoothers/element_step.hpp"
#include "smoothers/node_step.hpp"
#include "smoothers/worst_first.hpp"

namespace hexmend {
namespace {

void powers(Numbers h, std::span<double> powers) {
    for (std::size_t i = 0; i < h.size(); ++i) powers[i] = power_minus_two_thirds(broadcast<Lanes>(h[i]))[0];
}

void barriers(Numbers sigma, double delta, std::span<double> h, std::span<double> r) {
    for (std::size_t i = 0; i < sigma.size(); ++i) {
        auto s = broadcast<Lanes>(sigma[i]);
        auto at = delta != 0 ? barrier<true>(s, delta) : barrier<false>(s, delta);
        h[i] = at.h[0], r[i] = at.r[0];
    }
}

void bind_barrier(nb::module_ m) {
    m.doc() = "The scalar formulas of a corner tetrahedron, in one lane of a vector register.";
    m.def("power_minus_two_thirds", &powers, "h"_a, "powers"_a, "Write h^(-2/3) of h (n,) to powers (n,), float64.");
    m.def("barrier", &barriers, "sigma"_a, "delta"_a, "h"_a, "r"_a,
          "Write h(sigma) of (3.2) and r = sqrt(sigma^2 + 4 delta^2) of sigma (n,) to h and r (n,), float64.");
}

OwnedArray<double, 3> one_element_step(Points corners, double s, double rho) {
    constexpr Hex ALL_EIGHT[] = {{0, 1, 2, 3, 4, 5, 6, 7}};
    expect(corners.size() == 8, "corners: 8 points are expected");
    auto y = element_step<Hexahedron>(gather_corners<double>(corners, ALL_EIGHT, 0, 1), s, rho);
    std::vector<double> targets(24);
    std::memcpy(targets.data(), &y, sizeof y);
    return {std::move(targets)};
}

void bind_element_step(nb::module_ m) {
    m.doc() = "GETMe's element step of one hex, computed without vectors as `worst_first` does.";
    m.def("element_step", &one_element_step, "x"_a, "s"_a, "rho"_a, "Targets (8, 3) of the corners x (8, 3).");
}

nb::tuple rows(const auto &table) {
    nb::list all;
    for (const auto &row : table) {
        nb::list numbers;
        for (int i : row) numbers.append(i);
        all.append(nb::tuple(numbers));
    }
    return nb::tuple(all);
}

void bind_hexahedron(nb::module_ m) {
    m.doc() = "The reference hexahedron, as the kernels number it.";
    m.attr("CORNER_TETRAHEDRA") = rows(CORNER_TETRAHEDRA);
    m.attr("EDGES") = rows(EDGES);
    m.attr("DIAGONALS") = rows(DIAGONALS);
    m.attr("FACES") = rows(FACES);
    m.attr("UNIT_CUBE") = rows(UNIT_CUBE);
    m.attr("CORNER_FACES") = rows(CORNER_FACES);
    m.attr("ROTATIONS") = rows(ROTATIONS);
}

SymmetricMatrix matrix_of(const std::array<double, 6> &a) { return {a[0], a[1], a[2], a[3], a[4], a[5]}; }
V3<double> vector_of(const std::array<double, 3> &a) { return {a[0], a[1], a[2]}; }

std::pair<double, double> extremes(std::array<double, 6> a) {
    auto [smallest, largest] = extreme_eigenvalues(matrix_of(a));
    return {smallest, largest};
}

std::array<double, 3> solution(std::array<double, 6> a, std::array<double, 3> b) {
    auto x = solve(matrix_of(a), vector_of(b));
    return {x.x, x.y, x.z};
}

std::array<double, 3> direction(std::array<double, 6> hessian, std::array<double, 3> gradient, bool modified) {
    SymmetricMatrix matrix = matrix_of(hessian);
    auto p = newton_direction(matrix, vector_of(gradient), modified ? eigenvalue_shift(matrix) : 0.0);
    return {p.x, p.y, p.z};
}

// Value, gradient and second derivatives (xx, xy, xz, yy, yz, zz) of the quads at node 0, and their value at y.
std::tuple<double, std::array<double, 3>, std::array<double, 6>, double> quads_at_node(
    Points points, std::span<const Quad> quads, Indices corners, std::span<const std::array<std::uint8_t, 4>> counted,
    std::span<const std::array<double, 3>> normals,
    std::optional<std::span<const std::array<double, 8>>> inverse_lengths, std::array<double, 3> weight_delta_factor,
    ObjectiveNorm norm, std::array<double, 3> y) {
    auto [weight, delta, factor] = weight_delta_factor;
    SurfaceTerm term{counted, normals, inverse_lengths, weight, delta};
    const std::int32_t start[] = {0, static_cast<std::int32_t>(corners.size())};
    NodeQuads at_node;
    at_node.load(points, {start, corners, quads, {}}, 0, term, factor);
    ValueAndGradient at{};
    SymmetricMatrix h{};
    at_node.add_to(at, norm);
    at_node.add_to(h, norm);
    return {at.value, point(at.gradient), {h.xx, h.xy, h.xz, h.yy, h.yz, h.zz}, at_node.value_at(vector_of(y), norm)};
}

void bind_node_quads(nb::module_ m) {
    m.doc() = "The energy of the boundary quads at a node as a function of that node.";
    m.def("quads_at_node", &quads_at_node, "points"_a, "quads"_a, "corners"_a, "counted"_a, "normals"_a,
          "inverse_lengths"_a.none(), "weight_delta_factor"_a, "norm"_a, "y"_a,
          "Value, gradient and Hessian of the quads whose corners (4 * quad + corner) are the node, and their value\n"
          "at its displacement y; lengths are multiplied by the factor.");
}

void bind_symmetric(nb::module_ m) {
    m.doc() = "Symmetric 3 x 3 matrices, given as (xx, xy, xz, yy, yz, zz).";
    m.def("extreme_eigenvalues", &extremes, "a"_a, "Smallest and largest eigenvalue (Smith 1961).");
    m.def("solve", &solution, "a"_a, "b"_a, "Solution of the linear system; zero where the matrix is singular.");
    m.def("newton", &direction, "hessian"_a, "gradient"_a, "modified"_a,
          "Search direction of Algorithm A.3 or, modified, A.4, at a node.");
}

void bind_tournament(nb::module_ m) {
    m.doc() = "The priority queue of `worst_first`: a tournament tree of hexes by ascending key.";
    m.def("tournament", &tournament, "key"_a, "hexes"_a,
          "The tree (2 k,) int32 of the hexes (k,) int32; tree[1] is the hex of the smallest key (m,) float64.");
    m.def("replay", &replay, "tree"_a, "key"_a, "leaf"_a,
          "Update the tree after the key of the hex at a leaf, 0 to k - 1, has changed.");
}

}  // namespace
}  // namespace hexmend

NB_MODULE(hexmend_test_kernels, m) {
    using namespace hexmend;
    bind_barrier(m.def_submodule("barrier"));
    bind_element_step(m.def_submodule("element_step"));
    bind_hexahedron(m.def_submodule("hexahedron"));
    bind_node_quads(m.def_submodule("node_quads"));
    bind_symmetric(m.def_submodule("symmetric"));
    bind_tournament(m.def_submodule("tournament"));
}
