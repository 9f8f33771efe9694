#include "../assembly.hpp"

#include "arrays.hpp"

namespace hexmend {
namespace {

template <class Real> void bind_assemble(nb::module_ &m) {
    m.def("assemble", &assemble<Real>, "points"_a, "hexes"_a, "delta"_a, "p"_a, "left_out"_a, "slots"_a, "target"_a,
          "bounds"_a, "start"_a, "chosen"_a, "off"_a, "diagonal"_a, Unlocked(),
          "Assemble the Hessian of sum eta(H)^p: add it to off and diagonal, in their precision.\n\n"
          "Slots are shared out, and each share takes all hexes at its slots: some hexes are computed twice, and every\n"
          "block is the sum over its hexes in one order, however many shares there are.\n\n"
          "left_out: bit t set: corner tetrahedron t of the hex is left out, as if it were perfect. slots (m, 8): of\n"
          "each corner, -1 if it is fixed. target (m, 28): from `couplings.targets`. The slots of share k are those\n"
          "from bounds[k] to bounds[k + 1], its hexes chosen[start[k]:start[k + 1]]. off (blocks + 1, 9): blocks\n"
          "above the diagonal, by rows, and one that is none. diagonal (k, 6): xx xy xz yy yz zz.");
}

}  // namespace

void bind_assembly(nb::module_ &m) {
    m.doc() = "The Hessian of a mesh's energy, assembled.";
    bind_assemble<float>(m);
    bind_assemble<double>(m);
}

}  // namespace hexmend
