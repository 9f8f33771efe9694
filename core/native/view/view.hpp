// Kernels of the picture in the window: faces, sections, shading. All but `shine` run on one thread,
// because the window's thread calls them. bindings/view.cpp describes arguments and results.
#pragma once

#include <tuple>

#include "mesh/array_views.hpp"

namespace hexmend {

using HexMask = std::span<const bool>;

// Nodes of faces (u,), the faces as positions among these (k, 4), and the hex of each face (k,).
using Faces = std::tuple<OwnedArray<Node>, OwnedArray<Node, 4>, OwnedArray<Node>>;

// Visible faces of a mesh of which some hexes, keep (m,), are shown.
Faces visible(std::int64_t nodes, Hexes hexes, Neighbours neighbours, HexMask keep);
Faces faces_of(Hexes hexes, Neighbours neighbours, HexMask keep, HexMask chosen, bool hidden);
void edges_kept(Hexes hexes, Indices start, Indices corners, ArrayView<const Node, 2> edges, HexMask keep,
                std::span<bool> answer);

// Sides of planes on which hexes lie: a point is beyond a plane if x . normal > offset; normals (k, 3), offsets (k,).
double centre_heights(Points points, Hexes hexes, Points normal, std::span<double> eightfold);
std::pair<OwnedArray<Node, 4>, OwnedArray<Node>> opened(Hexes hexes, Neighbours neighbours, Numbers eightfold,
                                                        double extent, double offset);
void touched(Points points, Hexes hexes, Points normals, Numbers offsets, bool notch, std::span<bool> answer);

// x . normal without fused multiply-add: whether a node lies on a plane does not depend on the processor.
inline double height(const Point &x, const Point &normal) { return exact_dot(vector(x), vector(normal)); }

// Polygon i has the points numbered places[start[i]] to places[start[i + 1] - 1].
using PointNumbers = std::span<const std::int64_t>;

// Clip convex polygons to x . normal <= offset for all planes.
std::tuple<OwnedArray<double, 3>, OwnedArray<std::int64_t>, OwnedArray<std::int64_t>> before(
    Points points, PointNumbers start, PointNumbers places, PointNumbers owner, Points normals, Numbers offsets);

// Unit normals of the mean planes of polygons, and their ambient occlusion.
void normals(Points points, PointNumbers start, PointNumbers places, std::span<Point> answer);
void shine(Points points, PointNumbers start, PointNumbers places, Points normals, Points directions, std::int64_t side,
           std::span<double> light, std::span<double> whole);

}  // namespace hexmend
