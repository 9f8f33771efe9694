// Directions in which nodes that slide on a surface may move, and normals of the surface at its vertices.
#pragma once

#include "boundary/closest_point.hpp"

namespace hexmend {

// Unit normals of triangles and tangents of segments, 0 for those without extent: of each as it is, and at its corners,
// averaged over those around.
struct SurfaceDirections {
    std::span<const std::int64_t> number;  // of each piece of the trees among the triangles and segments
    Points flat;
    std::span<const std::array<double, 9>> smooth;  // at three corners
};

// Write orthonormal directions (k, 3, 3), in columns, at closest points on pieces: one where the node is of a curve,
// two on a patch; other columns are 0. Where all weights exceed `interior` the direction of the piece counts, elsewhere
// the one interpolated between its corners.
void tangent_bases(const SurfaceDirections &surface, Indices pieces, std::span<const Barycentric> weights,
                   std::span<const bool> of_curve, double interior, ArrayView<double, 9> bases);

// Write the projectors B B^T (k, 3, 3) onto directions B (k, 3, 3), orthonormal or 0 in columns.
void tangent_projectors(ArrayView<const double, 9> bases, ArrayView<double, 9> projectors);

// Write the unit normal at each corner of each triangle, row 3 t + c for corner c of triangle t: the mean over the
// triangles of the same patch at that vertex, weighted by their angles; 0 where they have none.
void vertex_normals(Points points, std::span<const Piece> triangles, Indices patch, std::span<Point> normals);

}  // namespace hexmend
