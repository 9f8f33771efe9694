// The sweeps of nodes that slide on the boundary among those that do not: local optimisation, Laplacian, GETMe.
#pragma once

#include "boundary/sliding_surface.hpp"
#include "energy/objective_norm.hpp"

namespace hexmend {

// Two directions along the surface; of a node on a curve the second is 0.
using Tangents = std::array<double, 6>;

std::int64_t sliding_local(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices groups,
                           Indices nodes, int direction, double delta, ObjectiveNorm power, double first, double shrink,
                           double c1, int cuts, std::span<const Tangents> tangents, Indices slots, Indices roots,
                           Points vertices, std::span<const Piece> pieces, std::span<const Box> boxes,
                           std::span<const TreeLink> links, Indices quads_start, Indices quads_at,
                           std::span<const Quad> quads, Points outward);

void sliding_laplacian(std::span<Point> points, Indices ring_start, Indices ring, Indices nodes, Indices slots,
                       Indices roots, Points vertices, std::span<const Piece> pieces, std::span<const Box> boxes,
                       std::span<const TreeLink> links, Indices quads_start, Indices quads_at,
                       std::span<const Quad> quads, Points outward);

std::int64_t sliding_guarded(std::span<Point> points, Hexes hexes, Indices start, Indices corners, Indices ring_start,
                             Indices ring, Indices nodes, bool keep_least_quality, Indices slots, Indices roots,
                             Points vertices, std::span<const Piece> pieces, std::span<const Box> boxes,
                             std::span<const TreeLink> links, Indices quads_start, Indices quads_at,
                             std::span<const Quad> quads, Points outward);

std::int64_t sliding_worst_first(std::span<Point> points, Hexes hexes, Indices start, Indices corners,
                                 std::span<const bool> free, Indices candidates, std::span<double> q,
                                 std::span<bool> sound, double s, double rho, double penalty, double setback,
                                 Indices slots, Indices roots, Points vertices, std::span<const Piece> pieces,
                                 std::span<const Box> boxes, std::span<const TreeLink> links, Indices quads_start,
                                 Indices quads_at, std::span<const Quad> quads, Points outward);

// Whether a quad was not turned before and is now, of each.
void turned(Points before, Points after, std::span<const Quad> quads, Points outward, std::span<bool> is);

}  // namespace hexmend
