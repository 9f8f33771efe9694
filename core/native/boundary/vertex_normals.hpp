// Normals of a surface of triangles at its vertices, each weighted by the angles of the triangles there.
#pragma once

#include "boundary/closest_point.hpp"

namespace hexmend {

// Write the unit normal at each corner of each triangle, row 3 t + c for corner c of triangle t: the mean over the
// triangles of the same patch at that vertex, weighted by their angles; 0 where they have none.
void vertex_normals(Points points, std::span<const Piece> triangles, Indices patch, std::span<Point> normals);

}  // namespace hexmend
