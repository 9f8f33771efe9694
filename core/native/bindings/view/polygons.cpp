#include "view/polygons.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_polygons(nb::module_ &m) {
    m.doc() = "Clipping of convex polygons. It runs on one thread, because the window's thread calls it.";
    m.def(
        "before", &before, "points"_a, "start"_a, "places"_a, "owner"_a, "normals"_a, "offsets"_a, ReleaseGil(),
        "Clip polygons to x . normal <= offset for all planes.\n"
        "\n"
        "Polygon i of k has the points (p, 3) numbered places[start[i]:start[i + 1]], in order; start (k + 1,), places "
        "and\n"
        "owner (k,) int64; normals (j, 3) and offsets (j,) float64. Returns the points of the remaining polygons, one\n"
        "after another, their start, and their owners.");
}

}  // namespace hexmend
