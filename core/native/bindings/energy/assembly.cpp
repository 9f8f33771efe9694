#include "energy/assembly.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {
namespace {

template <class Real> void bind_assemble(nb::module_ &m) {
    m.def(
        "assemble", &assemble<Real>, "points"_a, "delta"_a, "power"_a, "left_out"_a, "bounds"_a, "start"_a, "chosen"_a,
        "hexes"_a, "slots"_a, "target"_a, "off"_a, "diagonal"_a, ReleaseGil(),
        "Assemble the Hessian of sum eta(H)^p: add it to off and diagonal, in their precision.\n\n"
        "Slots are shared out, and each share takes all hexes at its slots: some hexes are computed twice, and every\n"
        "block is the sum over its hexes in one order, however many shares there are.\n\n"
        "left_out: bit t set: corner tetrahedron t of the hex is left out, as if it were perfect. The slots of share\n"
        "k are those from bounds[k] to bounds[k + 1], its hexes those from start[k] to start[k + 1] of: chosen, their\n"
        "numbers; hexes (.., 8); slots (.., 8), -1 where a corner is fixed; target (.., 28), from "
        "`couplings.pattern`.\n"
        "off (blocks + 1, 9): blocks above the diagonal, by rows, and one that is none. diagonal (k, 6): xx xy xz\n"
        "yy yz zz.");
}

}  // namespace

void bind_assembly(nb::module_ &m) {
    m.doc() = "The Hessian of a mesh's energy, assembled.";
    bind_assemble<float>(m);
    bind_assemble<double>(m);
}

}  // namespace hexmend
