#include "mesh/hexahedron.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {
namespace {

nb::tuple rows(const auto &table) {
    nb::list all;
    for (const auto &row : table) {
        nb::list numbers;
        for (int i : row) numbers.append(i);
        all.append(nb::tuple(numbers));
    }
    return nb::tuple(all);
}

}  // namespace

void bind_hexahedron(nb::module_ &m) {
    m.doc() = "The reference hexahedron, as the kernels number it.";
    m.attr("CORNER_TETRAHEDRA") = rows(CORNER_TETRAHEDRA);
    m.attr("EDGES") = rows(EDGES);
    m.attr("DIAGONALS") = rows(DIAGONALS);
    m.attr("FACES") = rows(FACES);
    m.attr("UNIT_CUBE") = rows(UNIT_CUBE);
    m.attr("CORNER_FACES") = rows(CORNER_FACES);
    m.attr("ROTATIONS") = rows(ROTATIONS);
}

}  // namespace hexmend
