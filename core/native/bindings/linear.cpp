#include "bindings/arrays.hpp"
#include "linear/aggregates.hpp"
#include "linear/coarse_space.hpp"
#include "linear/conjugate_gradients.hpp"
#include "linear/packed_diagonal.hpp"
#include "linear/sparsity.hpp"
#include "linear/turned_blocks.hpp"
#include "mesh/csr.hpp"

namespace hexmend {
namespace {

// The functions of Python by which processes are coupled; the caller holds them, and the interpreter's lock is not
// held.
template <class Real>
Coupling<Real> coupling_of(std::int64_t slots, std::int64_t ghosts, nb::handle sum, nb::handle exchange) {
    if (sum.is_none()) return {};
    return {ghosts,
            [sum](double own) {
                nb::gil_scoped_acquire lock;
                return nb::cast<double>(sum(own));
            },
            [=](std::array<Real, 4> *t) {
                nb::gil_scoped_acquire lock;
                nb::ndarray<nb::numpy, Real, nb::ndim<2>> rows(t, {static_cast<std::size_t>(slots + ghosts), 4},
                                                               nb::handle());
                exchange(nb::cast(rows, nb::rv_policy::reference));
            }};
}

template <class Block> void bind_matrix(nb::module_ m) {
    using Real = NumberOf<Block>;
    m.def(
        "solve",
        [](const BlockPattern &pattern, UpperBlocks<Block> off_diagonal, DiagonalBlocks<Real> diagonal, double damping,
           Vectors<Real> right, double tolerance, int max_iterations, std::span<std::array<Real, 4>> x,
           std::span<Real> work, std::int64_t ghosts, nb::handle sum, nb::handle exchange,
           const CoarsePattern *coarse) {
            auto coupling = coupling_of<Real>(pattern.bounds.back(), ghosts, sum, exchange);
            return solve<Block>(pattern, off_diagonal, diagonal, damping, right, tolerance, max_iterations, x, work,
                                coupling, coarse);
        },
        "pattern"_a, "off_diagonal"_a, "diagonal"_a, "damping"_a, "rhs"_a, "tolerance"_a, "max_iterations"_a, "x"_a,
        "work"_a, "ghosts"_a = 0, "sum"_a.none() = nb::none(), "exchange"_a.none() = nb::none(),
        "coarse"_a.none() = nb::none(), ReleaseGil(),
        "Solve A x = rhs, stopping at a direction of negative curvature (Steihaug 1983).\n\n"
        "At such a direction x is the iterate so far or, if it is the first, that direction. Vectors, (k, 4)\n"
        "with a fourth number 0, are in the precision of the matrix; sums over them are in double precision.\n\n"
        "off_diagonal (blocks + 1, 9): blocks above the diagonal, and an unused one; or (blocks + 1, 12) int16,\n"
        "packed, for vectors in single precision, see `assembly.assemble_packed`. diagonal (k, 6). damping:\n"
        "this multiple of D is added to the diagonal. tolerance: of the residual relative to the right-hand\n"
        "side, both in the norm of M^-1. work: see `workspace_size`. Writes x, which may be rhs; returns the\n"
        "iterations and the status. With `coarse` the iteration is deflated by the translations of aggregates,\n"
        "unless the matrix is not positive definite for these already; where processes share a matrix, it is not.\n\n"
        "Where several processes share a matrix, its columns from k on belong to ghosts, slots of other\n"
        "processes. `sum` adds a number over all processes; `exchange` is called with an array (k + ghosts, 4)\n"
        "of which it sends rows, and receives those of the ghosts. All processes call it together.");
    m.def("product", &product<Block>, "pattern"_a, "off_diagonal"_a, "diagonal"_a, "order"_a, "x"_a, "y"_a,
          ReleaseGil(),
          "Product A x of x (k, 3) in double precision; writes y (k, 3).\n\n"
          "Row k of x and y belongs to slot order[k].");
}

template <class Real> void bind_vectors(nb::module_ m) {
    m.def("to_slots", &to_slots<Real>, "of_nodes"_a, "order"_a, "scale"_a, "of_slots"_a, ReleaseGil(),
          "Write vectors of nodes (k, 3), times a scale, to slots (k, 4), whose fourth number becomes 0.\n\n"
          "Row k of of_nodes belongs to slot order[k], int32.");
    m.def("from_slots", &from_slots<Real>, "of_slots"_a, "order"_a, "scale"_a, "of_nodes"_a, ReleaseGil(),
          "Write vectors of slots (k, 4), times a scale, to nodes (k, 3); see `to_slots`.");
    m.def("turn_blocks", &turn_blocks<Real>, "turn"_a, "at"_a, "rows"_a, "columns"_a, "off_diagonal"_a, ReleaseGil(),
          "Replace the blocks `at` (j,) int32, each once, by T_row^T B T_column.\n\n"
          "rows, columns (j,) int32: indices in turn (k, 9); off_diagonal (blocks + 1, 9). Numbers must exist.");
    m.def("turn_diagonal", &turn_diagonal<Real>, "turn"_a, "slots"_a, "diagonal"_a, ReleaseGil(),
          "Replace the diagonal blocks D of `slots` (k,) int32, each once, by T^T D T.\n\n"
          "turn (k, 9): T of each; diagonal (s, 6): xx xy xz yy yz zz of each slot. Numbers must exist.");
    m.def(
        "project_diagonal", &project_diagonal<Real>, "projectors"_a, "slots"_a, "diagonal"_a, ReleaseGil(),
        "Replace the diagonal blocks D of `slots` (k,) int32, each once, by P D P + size (I - P).\n\n"
        "projectors (k, 9): the symmetric P of each; size is the absolute mean of the eigenvalues along P, or 1 where\n"
        "it is 0 or not a number. diagonal (s, 6): xx xy xz yy yz zz of each slot. Numbers must exist.");
}

}  // namespace

void bind_conjugate_gradients(nb::module_ m) {
    m.doc() = "Conjugate gradients with an assembled Hessian, preconditioned by symmetric Gauss-Seidel.";
    nb::enum_<SolveStatus>(m, "SolveStatus", "End of a solve.")
        .value("DONE", DONE, "The tolerance is reached.")
        .value("NEGATIVE_CURVATURE", NEGATIVE_CURVATURE, "A direction of negative curvature was met.")
        .value("TOO_MANY", TOO_MANY, "The number of iterations is exhausted.");
    nb::class_<BlockPattern>(m, "BlockPattern", "Pattern of a symmetric matrix of 3 x 3 blocks.")
        .def(ViewOf<Indices, Indices, Indices>(), "bounds"_a, "row_start"_a, "columns"_a,
             "bounds (2 parts,) int32: `ordering.slots`; row_start (k + 1,) and columns (blocks,) int32: blocks\n"
             "above the diagonal, `sparsity.pattern`.");
    nb::class_<CoarsePattern>(m, "CoarsePattern", "Pattern of A R, R being translations of aggregates of slots.")
        .def(ViewOf<Indices, Indices, Indices>(), "aggregate"_a, "row_start"_a, "columns"_a,
             "aggregate (k,) int32: the aggregate of each slot; row_start (k + 1,) and columns (blocks,) int32: the\n"
             "aggregates that each row of A R meets, as `coarse_pattern` returns them.");
    m.def("coarse_pattern", &coarse_pattern, "slots"_a, "slot_of_node"_a, "nodes"_a, "ring_start"_a, "ring"_a,
          "start"_a, "corners"_a, "distance"_a, ReleaseGil(),
          "Divide slots into aggregates: the arrays of a `CoarsePattern`.\n\n"
          "A slot is a centre if no centre before it is within `distance` edges; each slot belongs to the nearest\n"
          "centre, of several to the first. slots (m, 8): the slot of each corner, -1 if it is fixed; slot_of_node\n"
          "(n,), -1 likewise; nodes (k,): the node of each slot; ring_start, ring: `Topology.rings`; start, corners:\n"
          "`Topology.node_corners`. All are int32.");
    m.def(
        "complete_diagonal", &complete_diagonal, "pattern"_a, "off_diagonal"_a, "diagonal"_a, ReleaseGil(),
        "Add to diagonal (k, 6) float32, which `assembly.assemble_packed` began, what follows from the packed blocks\n"
        "(blocks + 1, 12): rows sum to the shares of fixed nodes. Returns the number of diagonal blocks whose\n"
        "eigenvalues differ too much for packed blocks.");
    m.def("coarse_workspace_size", &coarse_workspace_size, "coarse"_a,
          "Numbers that `solve` needs in its workspace for a coarse space, besides `workspace_size`.");
    m.def("workspace_size", &workspace_size, "pattern"_a, "ghosts"_a = 0, "coupled"_a = false,
          "Numbers of the workspace of `solve`; `coupled`: with `sum` and `exchange`.");
    bind_matrix<std::array<float, 9>>(m);
    bind_matrix<std::array<double, 9>>(m);
    bind_matrix<PackedBlock>(m);
    bind_vectors<float>(m);
    bind_vectors<double>(m);
}

void bind_ordering(nb::module_ m) {
    m.doc() = "Ordering of the free nodes in an assembled Hessian.";
    m.def("slots", &slots, "hexes"_a, "ring_start"_a, "ring"_a, "free"_a, "parts"_a, ReleaseGil(),
          "The free nodes after Cuthill and McKee, in parts that share no hex, followed by the separators between\n"
          "them.\n\n"
          "ring_start, ring: `Topology.rings`; free (n,) bool. The number of parts, at least 1, is reduced until\n"
          "none is too thin. Returns the node in each slot (k,), and the bounds of the parts and then the\n"
          "separators, (2 parts,).");
}

void bind_sparsity(nb::module_ m) {
    m.doc() = "Sparsity of a Hessian: the 3 x 3 blocks above its diagonal, one for each pair of free nodes of a hex.";
    m.attr("PAIRS") = PAIRS;
    m.def("pattern", &pattern, "slots"_a, "nodes"_a, "start"_a, "corners"_a, "opposite"_a = true,
          "max_items"_a = MOST_ITEMS, ReleaseGil(),
          "Blocks above the diagonal.\n\n"
          "slots (m, 8): the slot of each corner, -1 if it is fixed; nodes (k,): the node of each slot; start,\n"
          "corners: `Topology.node_corners`. Without `opposite`, nodes that only opposite corners of hexes join have\n"
          "no block. Returns row_start (k + 1,) and columns, ascending within a row, int32.\n"
          "OverflowError where there are more than `max_items` blocks.");
}

}  // namespace hexmend
