#include "view/occlusion.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_occlusion(nb::module_ &m) {
    m.doc() = "Ambient occlusion of polygons.";
    m.def("normals", &normals, "points"_a, "start"_a, "places"_a, "answer"_a, ReleaseGil(),
          "Unit normals of the mean planes of polygons; writes answer (k, 3), 0 for a polygon without area.\n"
          "\n"
          "Polygon i of k has the points (p, 3) numbered places[start[i]:start[i + 1]], in order; start (k + 1,) and "
          "places\n"
          "int64. It runs on one thread, because the window's thread calls it.");
    m.def(
        "shine", &shine, "points"_a, "start"_a, "places"_a, "normals"_a, "directions"_a, "side"_a, "light"_a, "whole"_a,
        ReleaseGil(),
        "Light from directions (j, 3) float64, unit vectors, at every corner of polygons with normals (k, 3).\n"
        "\n"
        "For each direction the polygons that face it are rasterised into a height map of `side` x `side` pixels. "
        "Adds\n"
        "the light that reaches each corner to light (start[-1],) float64, and the light without occlusion to whole.");
}

}  // namespace hexmend
