#include "view/occlusion.hpp"

#include "bindings/arrays.hpp"

namespace hexmend {

void bind_occlusion(nb::module_ &m) {
    m.doc() = "How much of the light from all around reaches polygons that stand in each other's way.";
    m.def("normals", &normals, "points"_a, "start"_a, "places"_a, "answer"_a, ReleaseGil(),
          "One normal a polygon, that of its mean plane; on one thread, because a window's thread asks.\n\n"
          "Polygon i of k has the points (p, 3) at places[start[i]:start[i + 1]], in order; start (k + 1,) and places\n"
          "int64. Writes answer (k, 3), of length 1, or 0 for a polygon without an area.");
    m.def("shine", &shine, "points"_a, "start"_a, "places"_a, "normals"_a, "directions"_a, "side"_a, "light"_a,
          "whole"_a, ReleaseGil(),
          "Light from some directions (j, 3) float64, of length 1, at every corner of polygons with their normals\n"
          "(k, 3).\n\n"
          "From each direction the polygons that are turned to it are drawn into a square of so many pixels a side.\n"
          "Adds to light (start[-1],) float64 what reaches each corner, and to whole what would if nothing stood in\n"
          "its way.");
}

}  // namespace hexmend
