#include "bindings/arrays.hpp"
#include "energy/assembly.hpp"
#include "energy/floor_barrier.hpp"
#include "energy/objective.hpp"

namespace hexmend {
namespace {

template <class Real> void bind_assemble(nb::module_ m) {
    m.def("assemble", &assemble<Real>, "points"_a, "delta"_a, "norm"_a, "omitted"_a, "shares"_a, "off_diagonal"_a,
          "diagonal"_a, "target"_a.none() = nb::none(), ReleaseGil(),
          "Add the Hessian of sum eta(H)^p to off_diagonal and diagonal, in their precision.\n\n"
          "Bit t of omitted (m,) uint8 is set where corner tetrahedron t of a hex is omitted. off_diagonal (blocks +\n"
          "1, 9): blocks above the diagonal, by rows, and an unused one. diagonal (k, 6): xx xy xz yy yz zz.");
}

template <class Real> void bind_assemble_floors(nb::module_ m) {
    m.def("assemble", &assemble_floors<Real>, "points"_a, "floors"_a, "omitted"_a, "shares"_a, "off_diagonal"_a,
          "diagonal"_a, "target"_a.none() = nb::none(), ReleaseGil(),
          "Add the second derivatives of the barrier to off_diagonal and diagonal; see `assembly.assemble`.");
}

}  // namespace

void bind_floor_barrier(nb::module_ m) {
    m.doc() = "Barrier of floors: of the scaled Jacobians at the corners of hexes, and of their qualities.";
    nb::class_<Floors>(m, "Floors", "Floors of the hexes of a mesh, with the weight and the bands of their barrier.")
        .def(ViewOf<Numbers, Numbers, OmittedCorners, double, double, double>(), "jacobians"_a, "qualities"_a,
             "ignored"_a, "jacobian_band"_a, "quality_band"_a, "weight"_a,
             "Floors jacobians (m,) of the scaled Jacobians and qualities (m,) of q(H), -inf where there is none;\n"
             "bit t of ignored (m,) uint8: corner t has no floor. The barrier begins a band above the floor.");
    m.def("qualities", &floor_qualities, "points"_a, "hexes"_a, "omitted"_a, "values"_a, "target"_a.none() = nb::none(),
          ReleaseGil(),
          "q(H) of every hex, with a target that of S W^-1, omitted corners as perfect; writes values (m,).");
    m.def("values", &floor_values, "points"_a, "hexes"_a, "floors"_a, "omitted"_a, "values"_a,
          "target"_a.none() = nb::none(), ReleaseGil(),
          "The barrier of every hex; writes values (m,); inf for a hex at or below a floor.");
    m.def("add_gradient", &add_floor_gradient, "points"_a, "hexes"_a, "floors"_a, "omitted"_a, "shares"_a,
          "target"_a.none() = nb::none(), ReleaseGil(),
          "Add the derivatives of the barrier by the corners of every hex to shares (m, 8, 3).");
    bind_assemble_floors<float>(m);
    bind_assemble_floors<double>(m);
}

void bind_assembly(nb::module_ m) {
    m.doc() = "Assembly of the Hessian of a mesh's energy.";
    nb::class_<HexShares>(m, "HexShares",
                          "Slots divided into shares that are assembled in parallel, with the hexes at the slots\n"
                          "of each.\n\n"
                          "Each share computes all its hexes, some of which are in several, so that every block is\n"
                          "summed over its hexes in one order for any number of shares.")
        .def(ViewOf<Indices, Indices, Indices, Hexes, Indices, Indices, Indices>(), "bounds"_a, "start"_a, "numbers"_a,
             "hexes"_a, "slots"_a, "row_start"_a, "columns"_a,
             "Slots of share k: bounds[k] to bounds[k + 1] - 1; its hexes: start[k] to start[k + 1] - 1 of numbers,\n"
             "in the mesh, int32. hexes (m, 8) int32 of the mesh; slots (n,) int32 of its nodes, -1 for fixed ones;\n"
             "row_start (k + 1,) and columns (blocks,) int32: `sparsity.pattern`.");
    bind_assemble<float>(m);
    bind_assemble<double>(m);
    m.def(
        "assemble_packed", &assemble_packed, "points"_a, "delta"_a, "norm"_a, "omitted"_a, "shares"_a,
        "first_separator"_a, "off_diagonal"_a, "diagonal"_a, "target"_a.none() = nb::none(), ReleaseGil(),
        "Write the Hessian of sum eta(H)^p above the diagonal to off_diagonal (blocks + 1, 12) int16, packed.\n\n"
        "A block has nine whole numbers of 20 bits, by rows, and a power of two that they are multiplied by: each is\n"
        "rounded by at most 2^-19 of the largest. What belongs to fixed nodes is added to diagonal (k, 6) float32;\n"
        "`conjugate_gradients.complete_diagonal` adds the rest. Slots from first_separator on are those of\n"
        "separators, the last of which may be ghosts; see `assemble`.");
}

void bind_objective(nb::module_ m) {
    m.doc() = "Sum of eta(H)^p over a mesh: energies, gradient, Hessian product.";
    m.def("energies", &energies, "points"_a, "hexes"_a, "delta"_a, "offset"_a, "omitted"_a, "eta"_a,
          "target"_a.none() = nb::none(), ReleaseGil(),
          "eta(H), the mean of eta(T) minus offset, of every hex, with the barrier of (3.2) regularised by delta,\n"
          "in the unit of sigma; writes eta (m,).\n\n"
          "Bit t of omitted (m,) uint8 is set where corner tetrahedron t of the hex is omitted, that is, counts as\n"
          "perfect. With a target, sigma and delta are in the cube of each hex's target lengths.");
    m.def("gradient", &gradient, "points"_a, "hexes"_a, "delta"_a, "norm"_a, "omitted"_a, "shares"_a,
          "target"_a.none() = nb::none(), ReleaseGil(),
          "Gradient of sum eta(H)^p by the corners of every hex, (B.3), (B.21); writes shares (m, 8, 3).");
    m.def("hessian_product", &hessian_product, "points"_a, "hexes"_a, "slots"_a, "values"_a, "delta"_a, "norm"_a,
          "omitted"_a, "shares"_a, "target"_a.none() = nb::none(), ReleaseGil(),
          "Hessian of sum eta(H)^p times a displacement of the free nodes, (B.19) corrected; writes shares (m, 8,\n"
          "3).\n\n"
          "slots is the number of each corner among the free nodes, -1 if it is fixed; values has a row for each.");
    m.def("gather", &gather, "shares"_a, "start"_a, "corners"_a, "nodes"_a, "rows"_a, ReleaseGil(),
          "Sum of the contributions, shares (m, 8, 3), over the corners at each of `nodes` (k,); writes rows (k, 3).");
}

void bind_target(nb::module_ m) {
    m.doc() = "Targets of the hexes of a mesh.";
    nb::class_<TargetMatrices>(m, "TargetMatrices", "Target matrices W = diag(lengths) along each hex's directions.")
        .def(nb::init<Points, double>(), "inverse_lengths"_a, "size_weight"_a = 0.0, nb::keep_alive<1, 2>(),
             "inverse_lengths (m, 3) float64, along x, y and z of each hex; not copied. size_weight is the weight\n"
             "of the size term.");
}

}  // namespace hexmend
