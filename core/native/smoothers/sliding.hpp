// Local optimisation in which nodes of the boundary slide on the surface.
#pragma once

#include "boundary/sliding_surface.hpp"
#include "boundary/surface_term.hpp"
#include "smoothers/local.hpp"

namespace hexmend {

// Two unit tangents of the surface at a sliding node; the second is 0 for a node on a curve.
using Tangents = std::array<double, 6>;

// `local_sweep`, in which the nodes that slide step along their tangents and every trial is projected onto the
// surface. tangents (k, 6) are those of each sliding node, by its slot. With a `term`, the quads of the surface count
// in the objective of the nodes that slide.
std::int64_t sliding_sweep(std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
                           const NodeStepSettings &settings, const SlidingSurface &surface,
                           std::span<const Tangents> tangents, const SurfaceTerm *term = nullptr);

// Write flipped (f,): whether a quad is flipped after and was not before.
void flipped_quads(Points before, Points after, std::span<const Quad> quads, Points outward, std::span<bool> flipped);

}  // namespace hexmend
