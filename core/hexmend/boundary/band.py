"""The band around a surface in which a boundary that slides on it stays.

Samples of a boundary: edge midpoints, face centres and nodes.

Points of the cells of a lattice with the largest and the least value.
"""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from hexmend.arrays import bounds, mask, row_norms
from hexmend.boundary.closest_point import ClosestPoints, NearPoints, means, vertices_of
from hexmend.boundary.edges import SurfaceEdges
from hexmend.boundary.skin_surface import SAMPLE_DISTANCE, SkinSurface
from hexmend.boundary.tolerances import ROUNDING
from hexmend.kernels import closest_point
from hexmend.mesh.topology.components import any_of_rows


def extremes_in_cells(x: np.ndarray, distances: np.ndarray, cell: float) -> np.ndarray:
    """Find the points with the largest and with the least distance in each cell of a cubic lattice.

    Parameters
    ----------
    x : (k, 3) float64
    distances : (k,) float64
    cell : float
        Edge of a cell.

    Returns
    -------
    (j,) int64
        Numbers of these points, ascending.

    Examples
    --------
    >>> x = np.array([[0.1, 0, 0], [0.2, 0, 0], [0.3, 0, 0], [1.5, 0, 0]])
    >>> extremes_in_cells(x, np.array([1.0, 2.0, 3.0, 0.0]), 1.0).tolist()
    [0, 2, 3]
    """
    if not len(x):
        return np.empty(0, dtype=np.int64)
    place = np.floor((x - bounds(x)[0]) / cell)
    order = np.lexsort((distances, *place.T))
    first = np.append(True, (np.diff(place[order], axis=0) != 0).any(axis=1))
    return np.unique(order[first | np.roll(first, -1)])


def samples_of_faces(faces: np.ndarray, n: int, edges: np.ndarray | None = None) -> np.ndarray:
    """Return the samples of quads: midpoints of edges (with each node twice) and of faces, then the nodes themselves.

    Parameters
    ----------
    faces : (k, 4) int32
    n : int
        Number of nodes of the mesh.
    edges : (e, 2) int32, optional
        Edges of the faces, where they are known already.

    Returns
    -------
    (s, 4) int32
        Four nodes whose mean each sample is.
    """
    edges = SurfaceEdges(faces, n).nodes if edges is None else edges
    nodes = np.tile(np.flatnonzero(mask(faces, n))[:, None], 4)
    return np.ascontiguousarray(np.concatenate([np.tile(edges, 2), faces, nodes]), dtype=np.int32)


NO_NODES = np.empty(0, dtype=np.int64)


class _Judged(NamedTuple):
    """Samples that were outside the band at some node positions: the others are inside until their nodes move."""

    points: np.ndarray  # (n, 3) float64
    max_deviation: float
    boundary: np.ndarray  # (s,) bool: samples of the boundary that were outside, or were not examined
    surface: np.ndarray  # (t,) bool: samples of the surface
    pieces: np.ndarray  # (t,) int32: pieces of the boundary near to samples of the surface


class InitialDistances(NamedTuple):
    """Distances of samples of a surface from the boundary before sliding.

    Parameters
    ----------
    distances : (s,) float64
        In the mesh's unit.
    nodes : (s, 4) int
        Boundary nodes whose weighted mean is the closest point.
    weights : (s, 4) float64
        Their weights.
    """

    distances: np.ndarray
    nodes: np.ndarray
    weights: np.ndarray


class Band:
    """Two-sided distance between a boundary and the surface on which it slides, against a limit.

    Nodes of the boundary lie on the surface; its edges and faces deviate where the surface is curved.

    Parameters
    ----------
    points : (n, 3) float64
        Original node positions of the boundary.
    faces : (k, 4) int32
        Faces of the boundary.
    start : (n, 3) float64
        Node positions before sliding, with the nodes on the surface.
    target : SkinSurface or None
        The surface; None if it is the original boundary.
    max_deviation : float
        Largest distance allowed, in the mesh's unit; 0 allows rounding only.
    inner : (k,) bool, optional
        Faces of interfaces; none by default. The outer boundary is compared with the outer boundary alone, interfaces
        with interfaces alone. On another surface interfaces stay and are not compared.
    """

    def __init__(
        self,
        points: np.ndarray,
        faces: np.ndarray,
        start: np.ndarray,
        target: SkinSurface | None,
        max_deviation: float,
        inner: np.ndarray | None = None,
    ):
        self.points, self._faces, self._start, self._given = points, faces, start, target
        self._inner = inner if inner is not None and inner.any() and not inner.all() else None
        self._first: ClosestPoints | None = None  # points of the boundary closest to `target_samples` at first
        self._judged: _Judged | None = None  # by the last call of `nodes_outside_band`
        self._known_limits: tuple[float, tuple[np.ndarray, np.ndarray]] | None = None  # and the width they are for
        self.max_deviation = max_deviation

    @cached_property
    def skin(self) -> SkinSurface:
        """The original boundary."""
        group = None if self._inner is None else self._inner.astype(np.int64)
        return SkinSurface(self.points, self._faces, group=group)

    @property
    def target(self) -> SkinSurface:
        """The surface on which the boundary slides."""
        return self._given or self.skin

    @cached_property
    def samples(self) -> np.ndarray:
        """Samples of the boundary, (s, 4) int32: each is the mean of four nodes.

        They are the midpoints of edges (with each node twice) and of faces, then the nodes themselves; those of
        interfaces follow, so that edges and nodes at which these end are among them twice.
        """
        return self._samples_and_groups[0]

    @cached_property
    def _samples_and_groups(self) -> tuple[np.ndarray, np.ndarray]:
        """The samples, and the group of faces of the surface that is searched for each, (s,) int64."""
        if self._inner is None:
            samples = samples_of_faces(self._faces, len(self.points), self.skin.edges.nodes)
            return samples, np.zeros(len(samples), dtype=np.int64)
        kinds = (~self._inner, self._inner) if self._given is None else (~self._inner,)
        parts = [samples_of_faces(self._faces[which], len(self.points)) for which in kinds]
        return np.concatenate(parts), np.repeat(np.arange(len(parts)), [len(samples) for samples in parts])

    @property
    def _groups_on_target(self) -> np.ndarray:
        """The group of faces of `target` that is searched for each sample of the boundary, (s,) int64."""
        return self._samples_and_groups[1]

    @cached_property
    def _groups_on_boundary(self) -> np.ndarray:
        """The group of faces of `skin` that is searched for each sample of the surface, (t,) int64."""
        return self._groups_on_target if self._given is None else np.zeros(len(self.target_samples), dtype=np.int64)

    def nodes_outside_band(self, points: np.ndarray, changed: np.ndarray | None = None) -> np.ndarray:
        """Find nodes at which the boundary is outside the band and further from the surface than at first.

        Where a sample of the surface is too far from the boundary, these are the nodes of the face closest to it now
        and of the face closest to it at first.

        Parameters
        ----------
        points : (n, 3) float64
            Node positions.
        changed : (n,) bool, optional
            Nodes of whose samples the distance from the surface is examined; all by default.

        Returns
        -------
        (k,) int
            Numbers of nodes, ascending.
        """
        if not np.isfinite(self.max_deviation):
            return NO_NODES
        _, nodes, _ = self.initial_surface_deviation
        (boundary_limits, surface_limits), near = self._limits, self._near_boundary
        doubtful, of_surface = self._doubtful_samples(points)
        own = doubtful if changed is None else any_of_rows(changed, self.samples)
        boundary = self._near_target.means_beyond(self.target.trees, points, self.samples, own, boundary_limits)
        vertices = vertices_of(points, self._faces)
        surface = near.beyond_moving(self.skin.trees, vertices, self.target_samples, of_surface, surface_limits)
        outside, of_surface = (doubtful & ~own) | boundary, mask(surface, len(self.target_samples))
        self._judged = _Judged(points.copy(), self.max_deviation, outside, of_surface, near.pieces.copy())
        if not (surface.size or boundary.any()):
            return NO_NODES
        found = np.zeros(len(points), dtype=bool)
        for of in (self.samples[boundary], self.skin.nodes_of_pieces(near.pieces[surface]), nodes[surface]):
            found[of] = True
        return np.flatnonzero(found)

    def _doubtful_samples(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Find samples that may be outside the band now: of the boundary, (s,) bool, and of the surface, (t,) bool."""
        judged = self._judged  # one read, as another thread may replace it
        if judged is None or judged.max_deviation != self.max_deviation:
            return np.ones(len(self.samples), dtype=bool), np.ones(len(self.target_samples), dtype=bool)
        boundary, surface = (np.empty(len(marks), dtype=bool) for marks in (judged.boundary, judged.surface))
        samples = closest_point.BandSamples(self.samples, self._faces, self.skin.faces_of_pieces, judged.pieces)
        before = judged.boundary, judged.surface
        closest_point.moved_samples(samples, points, judged.points, *before, boundary, surface)
        return boundary, surface

    @property
    def _limits(self) -> tuple[np.ndarray, np.ndarray]:
        """Distances that samples of the boundary, (s,), and of the surface, (t,), are allowed to have."""
        known = self._known_limits  # one read, as another thread may replace it
        if known is None or known[0] != self.max_deviation:
            initial = self._initial_boundary_deviation, self.initial_surface_deviation.distances
            width = max(self.max_deviation, ROUNDING * self._edge_length)
            limits = tuple(np.maximum(one, width) * (1 + ROUNDING) for one in initial)
            known = self._known_limits = self.max_deviation, limits
        return known[1]

    @cached_property
    def _edge_length(self) -> float:
        """Mean length of the edges of the boundary before sliding."""
        lengths = row_norms(np.diff(self._start[self.skin.edges.nodes], axis=1)[:, 0])
        return float(lengths.mean()) if lengths.size else 0.0

    @cached_property
    def _near_target(self) -> NearPoints:
        """Points of the surface near `samples` at some earlier node positions."""
        return NearPoints(self.target.trees.roots[self._groups_on_target])

    @cached_property
    def _near_boundary(self) -> NearPoints:
        """Points of the boundary near samples of the surface at some earlier node positions."""
        return NearPoints(self.skin.trees.roots[self._groups_on_boundary])

    @cached_property
    def target_samples(self) -> np.ndarray:
        """Samples of the surface, (s, 3), thinned where it is finer than the boundary, which cannot follow its details.

        Edges and faces that are no longer than a cell of a lattice are not sampled; in each cell the samples that are
        furthest from the boundary and nearest to it at first are kept.
        """
        if self._given is None:
            return means(self._start, self.samples)
        start = self.skin.with_points(self._start)
        cell = SAMPLE_DISTANCE * self._edge_length
        x = self._given.samples(cell)
        found = start.find(x)
        kept = extremes_in_cells(x, row_norms(found.points - x), cell) if cell > 0 else np.arange(len(x))
        self._first = found.rows(kept)
        return x[kept]

    @cached_property
    def _initial_boundary_deviation(self) -> np.ndarray:
        """Distance of `samples` from the surface before sliding, (s,)."""
        if self._given is None:
            return np.zeros(len(self.samples))
        x = means(self._start, self.samples)
        found = self.target.find(x)
        self._near_target.store(found)
        return row_norms(found.points - x)

    @cached_property
    def initial_surface_deviation(self) -> InitialDistances:
        """Distances of the surface's samples from the boundary before sliding."""
        if self._given is None:
            return InitialDistances(np.zeros(len(self.samples)), self.samples, np.full(self.samples.shape, 0.25))
        x = self.target_samples
        self._near_boundary.store(self._first)
        return InitialDistances(row_norms(x - self._first.points), *self.skin.weights_of_nodes(self._first))
