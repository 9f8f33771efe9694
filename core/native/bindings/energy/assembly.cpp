#include "energy/assembly.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {
namespace {

template <class Real> void bind_assemble(nb::module_ &m) {
    m.def("assemble", &assemble<Real>, "points"_a, "delta"_a, "power"_a, "left_out"_a, "bounds"_a, "start"_a,
          "chosen"_a, "hexes"_a, "slots"_a, "target"_a, "off"_a, "diagonal"_a, ReleaseGil(),
          "Add the Hessian of sum eta(H)^p to off and diagonal, in their precision.\n"
          "\n"
          "Slots are divided into shares that are assembled in parallel. Each share computes all hexes at its slots, "
          "some\n"
          "of them twice, so that every block is summed over its hexes in one order for any number of shares. The "
          "slots of\n"
          "share k are bounds[k] to bounds[k + 1] - 1; its hexes are numbers start[k] to start[k + 1] - 1 of chosen, "
          "their\n"
          "numbers in the mesh; hexes (.., 8); slots (.., 8), -1 where a corner is fixed; target (.., 28), from\n"
          "`sparsity.pattern`. Bit t of left_out is set where corner tetrahedron t of a hex is omitted.\n"
          "off (blocks + 1, 9): blocks above the diagonal, by rows, and an unused one. diagonal (k, 6): xx xy xz yy yz "
          "zz.");
}

}  // namespace

void bind_assembly(nb::module_ &m) {
    m.doc() = "Assembly of the Hessian of a mesh's energy.";
    bind_assemble<float>(m);
    bind_assemble<double>(m);
}

}  // namespace hexmend
