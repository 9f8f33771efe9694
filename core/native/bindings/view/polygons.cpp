#include "view/polygons.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_polygons(nb::module_ &m) {
    m.doc() = "Convex polygons cut off at planes; on one thread, because a window's thread asks.";
    m.def(
        "before", &before, "points"_a, "start"_a, "places"_a, "owner"_a, "normals"_a, "offsets"_a, ReleaseGil(),
        "What of polygons lies before all planes, where x . normal <= offset.\n\n"
        "Polygon i of k has the points (p, 3) at places[start[i]:start[i + 1]], in order; start (k + 1,), places and\n"
        "owner (k,) int64; normals (j, 3) and offsets (j,) float64. Makes the points of what is left, polygon after\n"
        "polygon, its start, and its owners.");
}

}  // namespace hexmend
