// Kernels of the picture in the window: faces and shading. All but `shine` run on one thread,
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
void edges_kept(Hexes hexes, Indices start, Indices corners, ArrayView<const Node, 2> edges, HexMask keep,
                std::span<bool> answer);

// Polygon i has the points numbered places[start[i]] to places[start[i + 1] - 1].
using PointNumbers = std::span<const std::int64_t>;

// Unit normals of the mean planes of polygons, and their ambient occlusion.
void normals(Points points, PointNumbers start, PointNumbers places, std::span<Point> answer);
void shine(Points points, PointNumbers start, PointNumbers places, Points normals, Points directions, std::int64_t side,
           std::span<double> light, std::span<double> whole);

}  // namespace hexmend
