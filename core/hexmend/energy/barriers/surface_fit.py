"""Fit of a boundary that moves to the surface that it had, as a term of an energy.

Samples of the boundary (nodes, centres of quads, middles of edges and of diagonals) are compared with the closest
points of their own curve or patch of the surface; nodes and centres, as they were on the surface, with those of the
boundary. A sample at a distance d of its tolerance tau, z = d/tau, costs one of

- the barrier -w log(1 - z^2), infinite at the tolerance;
- the elastic ceiling: min over e of L e - mu log(1 + e - g) - mu log e, minus its value at d = 0, with
  g = 2 z^2/(1 + z), L = slope tau, mu = L/10: nearly the barrier inside, and a constant force outside.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from hexmend.arrays import index_of, mask
from hexmend.boundary import SlidingBoundary
from hexmend.boundary.classification import NodeClass
from hexmend.boundary.closest_point import ClosestPointCache, ClosestPointTrees, triangulate, vertices_of
from hexmend.boundary.edges import SurfaceEdges
from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.norm import ObjectiveNorm
from hexmend.energy.sparsity import BlockSparsity
from hexmend.energy.terms import Term
from hexmend.kernels import closest_point
from hexmend.kernels import surface_fit as kernels

#: Smoothing of the elastic ceiling, as a share of its slope.
_SMOOTHING = 0.1
#: Share of its tolerance that a sample may use where it begins.
_INSIDE = 0.95
#: Share of what is left that a sample may use in a step.
_USED = 0.9
#: Tolerance, in mean edge lengths, of samples without one.
NO_LIMIT = 1e3


@dataclass(frozen=True)
class FitTolerances:
    """Largest distances of samples, in mean edge lengths.

    Parameters
    ----------
    patches, curves : float
    confined : float
        Of interfaces, and of edges that are marked or lie between sets.
    is_limit : bool
        Not to be exceeded: the surface has samples in the middles of edges too.
    """

    patches: float
    curves: float
    confined: float
    is_limit: bool = False


class FitResult(NamedTuple):
    """Samples at some positions: see `hexmend.kernels.surface_fit.distances`."""

    distances: np.ndarray
    vectors: np.ndarray
    directions: np.ndarray
    nodes: np.ndarray
    weights: np.ndarray


class Costs(NamedTuple):
    """Cost of each distance, its derivative divided by the distance, and its second derivative, (s + t,) each."""

    cost: np.ndarray
    first: np.ndarray
    second: np.ndarray


class SurfaceFit(Term):
    """Distances of samples of a boundary from its surface, and of the surface from the boundary.

    Samples with a node that moves in space count; others do not: their nodes keep planes, lines and places exactly.

    Parameters
    ----------
    sliding : SlidingBoundary
        The boundary on its surface.
    free : (n,) bool
        Nodes of the boundary that move in space.
    released : (n,) bool
        Nodes whose samples are compared with the whole surface, whatever their curve or patch.
    tolerances : FitTolerances
    unit : float
        Unit of length of the energy, in that of the mesh.

    Attributes
    ----------
    tolerances : (s + t,) float64
        Of the s samples of the boundary, then of the t of the surface, in mean edge lengths.
    diagonal : (s + t,) bool
        Middles of diagonals.
    weight : float
        Of the barrier; 0: none.
    slope : float
        Of the elastic ceiling, an energy per mean edge length; 0: none.
    """

    def __init__(
        self,
        sliding: SlidingBoundary,
        free: np.ndarray,
        released: np.ndarray,
        tolerances: FitTolerances,
        unit: float,
    ):
        boundary, self.n = sliding.boundary, len(free)
        points = sliding.start / unit
        self.weight, self.slope, self._faces = 0.0, 0.0, boundary.faces
        nodes, group, diagonal, returns = _samples(sliding, tolerances.is_limit)
        last = sliding.surface.n_patches + sliding.surface.n_curves
        of_curve = (group >= sliding.surface.n_patches) & (group < last)
        # Quads of inverted hexes may have any shape at first.
        kept = free[nodes].any(axis=1) & ~(diagonal & released[nodes].any(axis=1))
        nodes, group, diagonal, of_curve = nodes[kept], group[kept], diagonal[kept], of_curve[kept]
        count, back = len(nodes), int(np.count_nonzero(kept[:returns]))
        confined = sliding.confined[nodes].all(axis=1)
        group[released[nodes].any(axis=1)] = last
        first = points[nodes].mean(axis=1)
        trees = sliding.surface.trees_with_union(unit)
        slides = group >= 0
        first[slides] = trees.closest(first[slides], group[slides]).points
        vertices, triangles, face = triangulate(points, boundary.faces)
        segments = boundary.segments[:, [0, 1, 1]]
        pieces = np.concatenate([triangles, segments, triangles]).astype(np.int32)
        patches, curves = boundary.patch_of_face[face], boundary.n_patches + boundary.curve_of_segment
        whole = boundary.n_patches + boundary.n_curves
        self._moving = ClosestPointTrees(
            vertices, pieces, np.concatenate([patches, curves, np.full(len(triangles), whole)])
        )
        self._boxes = np.empty_like(self._moving.boxes)
        own = np.maximum(group, 0) if sliding.surface_is_own else np.full(count, whole)
        slots = np.where(slides, np.cumsum(slides) - 1, -1).astype(np.int32)
        roots = np.where(slides, self._moving.roots[own], 0).astype(np.int32)
        self._cache = ClosestPointCache(trees, group[slides])
        self._nodes = np.ascontiguousarray(nodes)
        self._kernel = kernels.FitSamples(
            self._nodes, first, slots, roots, self._cache.kernel, _directions(trees), boundary.faces
        )
        self._known = np.full(back, -1, dtype=np.int32)
        self._results: list[tuple[np.ndarray, FitResult]] = []  # of the last two positions
        self._costs_at: tuple[np.ndarray, Costs] | None = None  # distances, and their costs
        self._rows = np.arange(count + back, dtype=np.int32)  # that are compared
        self._part: tuple[np.ndarray, np.ndarray] | None = None  # nodes of a part, and positions of the others
        self._slot_of: tuple[BlockSparsity, np.ndarray] | None = None
        self.diagonal, self._of_line = (np.concatenate([of, of[:back]]) for of in (diagonal, of_curve | ~slides))
        each = np.where(of_curve, tolerances.curves, tolerances.patches)
        each = np.where(released[nodes].any(axis=1), tolerances.patches, each)
        each = np.where(confined, np.minimum(each, tolerances.confined), each)
        self.tolerances = np.concatenate([each, each[:back]])
        self._confined = np.concatenate([confined, confined[:back]])
        # Warped quads are off their own surface, and all quads off a surface from elsewhere.
        self.tolerances = self.allowing(points, np.full_like(self.diagonal, True)).tolerances

    @property
    def limits_moves(self) -> bool:
        """True if there are samples."""
        return self._rows.size > 0

    def allowing(self, x: np.ndarray, which: np.ndarray) -> SurfaceFit:
        """Return the fit with tolerances of some samples (s + t,) bool that allow positions x (n, 3)."""
        enough = np.maximum(self.tolerances, self.distances(x) / _INSIDE)
        return self.with_weights(self.weight, self.slope, np.where(which, enough, self.tolerances))

    def widened(self, factor: float) -> SurfaceFit:
        """Return the fit with tolerances larger by a factor, but for those of what is to be exact."""
        tolerances = np.where(self._confined, self.tolerances, factor * self.tolerances)
        return self.with_weights(self.weight, self.slope, tolerances)

    def without_diagonals(self) -> SurfaceFit:
        """Return the fit without a tolerance for the middles of diagonals."""
        return self.with_weights(self.weight, self.slope, np.where(self.diagonal, NO_LIMIT, self.tolerances))

    def is_within(self, x: np.ndarray, factor: float = 1.0) -> bool:
        """Return True if all samples are within a multiple of their tolerances at positions x (n, 3), with room."""
        return not (self.distances(x) > factor * _INSIDE * self.tolerances).any()

    def exceeding(self, x: np.ndarray, before: np.ndarray) -> np.ndarray:
        """Mark nodes of samples that are beyond their tolerance at x (n, 3), and were not as far before, (n,) bool."""
        was, result = self.distances(before), self.result(x)
        return self._nodes_of(result.distances > np.maximum(self.tolerances, was), result)

    def with_weights(self, weight: float = 0.0, slope: float = 0.0, tolerances: np.ndarray | None = None) -> SurfaceFit:
        """Return the fit with another weight of the barrier, slope of the ceiling, and tolerances (s + t,)."""
        other = copy.copy(self)
        other.weight, other.slope, other._costs_at = weight, slope, None
        if tolerances is not None:
            other.tolerances = tolerances
        return other

    def on_part(self, nodes: np.ndarray, moves: np.ndarray, x: np.ndarray) -> SurfaceFit:
        """Return the fit as a function of the positions of some nodes (j,), of which those with `moves` (j,) bool move.

        Samples elsewhere, which the part does not move, count as on the surface; x (n, 3) are the positions of all.
        """
        other = copy.copy(self)
        near, moving = mask(nodes, self.n), mask(nodes[moves], self.n)
        rows = np.concatenate([moving[self._nodes].any(axis=1), near[self._nodes[: len(self._known)]].any(axis=1)])
        other._rows, other._part = np.flatnonzero(rows).astype(np.int32), (nodes, x)
        other._known, other._boxes = self._known.copy(), self._boxes.copy()
        other._results, other._slot_of, other._costs_at = [], None, None
        return other

    def _all(self, x: np.ndarray) -> np.ndarray:
        """Positions of all nodes, (n, 3), from the positions of the nodes of the part."""
        if self._part is None:
            return x
        nodes, others = self._part
        merged = others.copy()
        merged[nodes] = x
        return merged

    def _of_part(self, rows: np.ndarray) -> np.ndarray:
        """Rows of the nodes of the part, of an array with a row for each node."""
        return rows if self._part is None else rows[self._part[0]]

    def result(self, x: np.ndarray) -> FitResult:
        """Compare at positions x (n, 3) of the nodes, which are not changed in place between calls."""
        result = self._known_result(x)
        if result is None:
            result = self._compare(x)
            self._results[:] = [(x, result), *self._results[:1]]
        return result

    def _known_result(self, x: np.ndarray) -> FitResult | None:
        """Return the comparison at positions x (n, 3) if it is one of the last two."""
        return next((result for known, result in self._results if known is x or np.array_equal(known, x)), None)

    def _compare(self, x: np.ndarray) -> FitResult:
        """Compare the samples near the part that moves at positions x (n, 3); others count as on the surface."""
        count = len(self.tolerances)
        shapes = (count,), (count, 3), (count, 3), (count, 4), (count, 4)
        result = FitResult(*(np.zeros(shape, np.int32 if k == 3 else np.float64) for k, shape in enumerate(shapes)))
        vertices, trees = vertices_of(self._all(x), self._faces), self._moving
        closest_point.refit(vertices, trees.pieces, trees.links, self._boxes)
        moving = closest_point.BoxTrees(vertices, trees.pieces, self._boxes, trees.links)
        kernels.distances(self._kernel, moving, self._rows, self._known, *result)
        return result

    def distances(self, x: np.ndarray) -> np.ndarray:
        """Distances of the samples at positions x (n, 3), (s + t,), in mean edge lengths."""
        return self.result(x).distances

    def value(self, x: np.ndarray, norm: ObjectiveNorm | None = None) -> float:
        """Compute the term at positions x (n, 3)."""
        return float(self._costs(self.distances(x)).cost.sum())

    def gradient(self, x: np.ndarray, norm: ObjectiveNorm | None = None) -> np.ndarray:
        """Compute the gradient by all nodes, (n, 3)."""
        result, gradient = self.result(x), np.zeros((self.n, 3))
        forces = self._costs(result.distances).first[:, None] * result.vectors
        kernels.add_gradient(result.nodes, result.weights, forces, gradient)
        return self._of_part(gradient)

    def assemble(self, x: np.ndarray, norm: ObjectiveNorm | None, matrix: AssembledHessian) -> None:
        """Add second derivatives, without those of the surface's curvature, to a matrix."""
        result = self.result(x)
        costs = self._costs(result.distances)
        sparsity = matrix.sparsity
        if self._slot_of is None or self._slot_of[0] is not sparsity:
            own = sparsity.nodes if self._part is None else self._part[0][sparsity.nodes]
            self._slot_of = sparsity, index_of(own, self.n)
        kernels.hessian(
            self._slot_of[1][result.nodes],
            result.distances,
            result.vectors,
            result.directions,
            result.weights,
            costs.first,
            costs.second,
            self._of_line,
            sparsity.row_start,
            sparsity.columns,
            matrix.off_diagonal,
            matrix.diagonal,
        )

    def beyond(self, x: np.ndarray, there: np.ndarray) -> np.ndarray | None:
        """Mark nodes of samples that use most of what they have left, (n,) bool; None where none does.

        Only a barrier limits them. Samples that may move farther than that are compared again, those of the surface
        with the tangent at their closest point alone, unless all are compared there already.
        """
        if not self.weight:
            return None
        before = self.result(x)
        limit = before.distances + _USED * np.maximum(self.tolerances - before.distances, 0.0)
        known = self._known_result(there)
        if known is not None:
            bad = known.distances > limit
            return self._of_part(self._nodes_of(bad, before)) if bad.any() else None
        shift = np.zeros((self.n, 3))
        shift[slice(None) if self._part is None else self._part[0]] = there - x
        lengths = np.linalg.norm(shift, axis=1)
        most = before.distances + (before.weights * lengths[before.nodes]).sum(axis=1)
        rows = np.flatnonzero(most > limit).astype(np.int32)
        if not rows.size:
            return None
        bad = np.zeros(len(limit), dtype=bool)
        moved = before.vectors[rows] + (before.weights[rows, :, None] * shift[before.nodes[rows]]).sum(axis=1)
        along = (moved * before.directions[rows]).sum(axis=1)
        across = np.sqrt(np.maximum((moved**2).sum(axis=1) - along**2, 0.0))
        bad[rows] = np.where(self._of_line[rows], across, np.abs(along)) > limit[rows]
        return self._of_part(self._nodes_of(bad, before)) if bad.any() else None

    def _nodes_of(self, samples: np.ndarray, result: FitResult) -> np.ndarray:
        """Mark the nodes of some samples (s + t,) bool, (n,) bool."""
        return mask(result.nodes[samples][result.weights[samples] > 0], self.n)

    def _costs(self, d: np.ndarray) -> Costs:
        """Costs of distances (s + t,); those of the last ones are known."""
        if self._costs_at is None or self._costs_at[0] is not d:
            self._costs_at = d, self._find_costs(d)
        return self._costs_at[1]

    def _find_costs(self, d: np.ndarray) -> Costs:
        tau = self.tolerances
        z = d / tau
        cost, first, second = (np.zeros(len(d)) for _ in range(3))
        if self.weight:
            left = 1 - z * z
            with np.errstate(divide="ignore", invalid="ignore"):
                cost += self.weight * np.where(left > 0, -np.log(np.maximum(left, 1e-300)), np.inf)
                first += 2 * self.weight / (tau * tau * left)
                second += 2 * self.weight * (1 + z * z) / (tau * tau * left * left)
        if self.slope:
            most = self.slope * tau
            mu = _SMOOTHING * most
            c = 1 - 2 * z * z / (1 + z)
            root = np.sqrt(most * most * c * c + 4 * mu * mu)
            s = np.where(c > 0, most * c + root, 4 * mu * mu / (root - most * np.minimum(c, 0)))
            u = (s + 2 * mu) / (2 * most)  # 1 + e - g, mu/u + mu/e = L
            e = _SMOOTHING * u / np.maximum(u - _SMOOTHING, 1e-300)
            u0 = (1 + np.sqrt(1 + 4 * _SMOOTHING**2)) / 2 + _SMOOTHING
            e0 = _SMOOTHING * u0 / (u0 - _SMOOTHING)
            cost += -mu * np.log(u / u0) - mu * np.log(e / e0) + most * (e - e0)
            force = mu / u
            rise = force / u * s / (2 * root)
            slope = (4 + 2 * z) / (1 + z) ** 2  # of g, divided by z
            first += force * slope / tau**2
            second += (force * 4 / (1 + z) ** 3 + rise * (slope * z) ** 2) / tau**2
        return Costs(cost, first, second)


def _samples(sliding: SlidingBoundary, with_edges: bool) -> tuple[np.ndarray, np.ndarray, np.ndarray, int]:
    """Find the samples, (s, 4) int32, each the mean of four nodes; their groups, (s,); and which are of diagonals.

    Groups are those of `PartitionedSurface.trees`; -1 for a node that stays where it is. The number is that of the
    samples that the surface has too, which are first: of nodes and centres, and of edges if that is asked for.
    """
    boundary, surface, n = sliding.boundary, sliding.surface, len(sliding.node_class)
    faces, last = boundary.faces, surface.n_patches + surface.n_curves
    on = np.flatnonzero(mask(faces, n))
    of_node = np.full(on.size, -1, dtype=np.int64)
    slides = surface.node_class[on] >= NodeClass.CURVE
    of_node[slides] = surface.group_of(on[slides])
    edges = SurfaceEdges(faces, n)
    of_edge, of_face = np.full(len(edges.nodes), last, dtype=np.int64), np.full(len(faces), last, dtype=np.int64)
    if sliding.surface_is_own:
        of_edge, of_face = boundary.patch_of_face[edges.neighbours[:, 0]].astype(np.int64), boundary.patch_of_face
        at = np.searchsorted(edges.key, edges.keys_of(boundary.segments))
        of_edge[at] = boundary.n_patches + boundary.curve_of_segment
    diagonals = np.concatenate([faces[:, [0, 2, 0, 2]], faces[:, [1, 3, 1, 3]]])
    nodes = np.concatenate([np.tile(on[:, None], 4), faces, np.tile(edges.nodes, 2), diagonals])
    group = np.concatenate([of_node, of_face, of_edge, np.tile(of_face, 2)])
    is_diagonal = np.arange(len(nodes)) >= len(nodes) - len(diagonals)
    of_surface = len(on) + len(faces) + (len(edges.nodes) if with_edges else 0)
    return nodes.astype(np.int32), group, is_diagonal, of_surface


def _directions(trees: ClosestPointTrees) -> np.ndarray:
    """Unit normals of the triangles and unit tangents of the segments of trees, (p, 3)."""
    a, b, c = (trees.points[trees.pieces[:, k]] for k in range(3))
    is_segment = (trees.pieces[:, 1] == trees.pieces[:, 2])[:, None]
    directions = np.where(is_segment, b - a, np.cross(b - a, c - a))
    return directions / np.maximum(np.linalg.norm(directions, axis=1, keepdims=True), np.finfo(float).tiny)
