#include "mesh/hex_mesh.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_hex_mesh(nb::module_ &m) {
    m.doc() = "Connectivity of a mesh, as sweeps take it.";
    nb::class_<HexMesh>(m, "HexMesh", "Hexes, and the corners of hexes at each node.")
        .def(
            "__init__",
            [](HexMesh *self, Hexes hexes, Indices start, Indices corners) {
                expect(corners.size() == 8 * hexes.size(), "corners: eight for each of the hexes are expected");
                expect(!start.empty() && start.back() == static_cast<std::int64_t>(corners.size()),
                       "start: its last number is expected to be the length of corners");
                new (self) HexMesh{hexes, start, corners};
            },
            "hexes"_a, "start"_a, "corners"_a, nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(), nb::keep_alive<1, 4>(),
            "hexes (m, 8) int32; start (n + 1,) and corners (8 m,) int32: `incidence.node_corners`. Arrays are not\n"
            "copied.");
}

}  // namespace hexmend
