#include "bindings/arrays.hpp"
#include "optimise/linear_program.hpp"

namespace hexmend {

void bind_linear_program(nb::module_ m) {
    m.doc() = "Linear program of a step of sequential linear programming.";
    m.def(
        "rows",
        [](std::span<const std::array<Node, 4>> nodes, std::span<const std::array<double, 12>> slopes, Numbers gains,
           Indices index, std::span<const std::int64_t> first, Points displacements,
           std::span<const std::int64_t> columns, std::int64_t gain_column) {
            expect(slopes.size() == nodes.size() && gains.size() == nodes.size(),
                   "slopes and gains: a row for each of nodes is expected");
            expect(are_csr(first, displacements.size()) && columns.size() == displacements.size(),
                   "displacements and columns: as many as the last of first are expected");
            return program_rows({nodes, slopes, gains}, index, {first, displacements, columns}, gain_column);
        },
        "nodes"_a, "slopes"_a, "gains"_a, "index"_a, "first"_a, "displacements"_a, "columns"_a, "gain_column"_a,
        ReleaseGil(),
        "Rows of the program, one for each of r linear models of values that depend on four nodes.\n\n"
        "A row has minus the slope of its value along each direction of its nodes, in the column of the direction,\n"
        "and its gain in the last place, in gain_column. nodes (r, 4) int32, which must exist; slopes (r, 12) by\n"
        "their places; gains (r,). index (n,) int32 numbers the nodes with directions, -1 for others: those of\n"
        "number k are rows first[k]:first[k + 1] of displacements (w, 3) and of their columns (w,) int64; first\n"
        "(k + 1,) int64. Returns where each row begins, (r + 1,) int64, its columns, int64, and values. A node that\n"
        "a model has twice counts once, with the sum of its slopes.");
}

}  // namespace hexmend
