// Local optimisation in which nodes of the boundary slide on the surface.
#pragma once

#include "boundary/sliding_surface.hpp"
#include "smoothers/local.hpp"

namespace hexmend {

// Two unit tangents of the surface at a sliding node; the second is 0 for a node on a curve.
using Tangents = std::array<double, 6>;

// `sweep` of local.hpp, in which the nodes that slide step along their tangents and every trial is projected onto the
// surface. tangents (k, 6) are those of each sliding node, by its slot.
std::int64_t sliding_sweep(std::span<Point> points, const HexMesh &mesh, Indices groups, Indices nodes,
                           const NodeStepSettings &settings, const SlidingSurface &surface,
                           std::span<const Tangents> tangents);

// Write for each of quads (f, 4) whether it is inverted after and was not before: inverted (f,). outward (f, 3) are the
// surface's normals, as in `BoundaryQuads`.
void newly_inverted(Points before, Points after, std::span<const Quad> quads, Points outward, std::span<bool> inverted);

}  // namespace hexmend
