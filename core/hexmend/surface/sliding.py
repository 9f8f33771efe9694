"""The nodes of a mesh that slide on its boundary: which they are, where they may go, and how they are put back."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np

from hexmend.hexahedron import FACES
from hexmend.kernels import sliding as kernels
from hexmend.mesh import Mesh
from hexmend.quality import corner_determinants
from hexmend.surface.boundary import Boundary, Kind, boundary_of, classify
from hexmend.surface.change import NEAR, Skin
from hexmend.surface.features import DEGREES, given_corners
from hexmend.surface.surface import Surface
from hexmend.surface.trees import Closest, triangulated
from hexmend.surface.vectors import unit, vertex_normals
from hexmend.topology import Rows

#: Least weight of the corners of a triangle, or segment, at a place that counts as inside of it: there its own plane
#: is the tangent, at its edges the mean of those around.
_INNER = 1e-3
#: The least room, in mean edge lengths: what is on the surface is off it by rounding.
_ROUNDING = 1e-9

NOBODY = np.empty(0, dtype=np.int64)


class Sliding:
    """A mesh whose boundary nodes slide: those of curves along them, those of patches on them; corners stay.

    Parameters
    ----------
    mesh : Mesh
        Its `target`, or else its `surface`, is what nodes of its boundary slide on.
    degrees : float
        Dihedral angle beyond which an edge is a feature; see `boundary_of`.
    room : float
        How far, in the mesh's unit, the middles of the boundary's edges and faces may leave the surface: nodes are on
        it, but what lies between them cuts off its bends.

    Attributes
    ----------
    boundary : Boundary
    surface : Surface
    kind : (n,) uint8
        What each node is to the surface that it slides on, one of `Kind`.
    mesh : Mesh
        The same, of whose nodes only corners, pinned ones and those that no hex uses are fixed; on a target those that
        slide have been put on it.
    nodes : (k,) int64
        Those that slide, ascending.
    """

    def __init__(self, mesh: Mesh, degrees: float = DEGREES, room: float = np.inf):
        self.room, self._points = max(room, _ROUNDING * mesh.mean_edge_length), mesh.surface
        original = mesh.with_points(mesh.surface)
        self.boundary = boundary_of(original, degrees)
        bends = kept_bends(original, self.boundary)
        if bends.size:
            kept = np.concatenate([given_corners(mesh), bends])
            self.boundary = boundary_of(original, degrees, corners=kept)
        target = mesh.target
        if target is None:
            self.surface = Surface(mesh.surface, self.boundary)
        else:
            whole = Surface(target.points, classify(target.points, target.faces, degrees))
            self.surface = whole.attached(mesh.surface, self.boundary, NEAR * mesh.mean_edge_length)
        self.kind = self.surface.kind
        slides = self.kind >= Kind.CURVE
        self.nodes = np.flatnonzero(slides)
        self.yields = self.boundary.kind == Kind.CORNER
        self.yields[given_corners(mesh)] = False
        self._group = self.surface.group_of(self.nodes)
        self._number = np.full(mesh.n_nodes, -1, dtype=np.int64)
        self._number[self.nodes] = np.arange(self.nodes.size)
        if target is not None:
            points = mesh.points.copy()
            points[self.nodes] = self.put_back(points[self.nodes])
            mesh = mesh.with_points(points)
        self.mesh = mesh.with_fixed(mesh.fixed & ~slides)

    def slides(self, nodes: np.ndarray) -> np.ndarray:
        """Which of some nodes slide, bool."""
        return self._number[nodes] >= 0

    def put_back(self, x: np.ndarray, nodes: np.ndarray | None = None) -> np.ndarray:
        """The closest places of sliding nodes on their own curves and patches, (k, 3).

        Parameters
        ----------
        x : (k, 3) float64
            Where they have been moved to, in the mesh's unit of length.
        nodes : (k,) int, optional
            Which they are; all that slide, if None.
        """
        return self._closest(x, nodes).places

    def bases(self, x: np.ndarray, nodes: np.ndarray | None = None) -> np.ndarray:
        """Directions in which sliding nodes may move, the columns of (k, 3, 3): 0 beyond the node's degrees of freedom.

        Parameters
        ----------
        x : (k, 3) float64
            Where they are, on the surface.
        nodes : (k,) int, optional
            Which they are; all that slide, if None.
        """
        of, found = self.nodes if nodes is None else nodes, self._closest(x, nodes)
        weights = found.weights.copy()
        weights[self.kind[of] == Kind.CURVE, 2] = 1.0  # a segment has two
        inner = weights.min(axis=1, keepdims=True) > _INNER
        along = np.where(inner, self.surface.directions(found, smooth=False), self.surface.directions(found))
        bases = np.zeros((len(of), 3, 3))
        curve = self.kind[of] == Kind.CURVE
        bases[curve, :, 0] = along[curve]
        bases[~curve, :, :2] = _across(along[~curve])
        return bases

    def tangents(self, points: np.ndarray) -> np.ndarray:
        """The directions of `bases` for all that slide, nodes being at points (n, 3): one after the other, (k, 6)."""
        return np.ascontiguousarray(self.bases(points[self.nodes])[:, :, :2].transpose(0, 2, 1)).reshape(-1, 6)

    @cached_property
    def ground(self) -> tuple[np.ndarray, ...]:
        """What `hexmend.kernels.sliding` takes: slots, roots, vertices, pieces, boxes, links, and the quads."""
        trees, faces = self.surface.trees, self.boundary.faces
        slots = self._number.astype(np.int32)
        at = slots[faces.ravel()]
        order = np.argsort(at, kind="stable")
        quads_at = order[np.searchsorted(at[order], 0) :].astype(np.int32)
        start = np.searchsorted(at[quads_at], np.arange(self.nodes.size + 1)).astype(np.int32)
        return (
            slots, trees.roots[self._group], trees.points, trees.pieces, trees.boxes, trees.links,
            start, quads_at, faces, self.outward,
        )  # fmt: skip

    @cached_property
    def outward(self) -> np.ndarray:
        """The normal of the boundary at each of its faces as it was, that of the faces around it too, (k, 3)."""
        faces = self.boundary.faces
        vertices, triangles, face = triangulated(self._points, faces)
        normals = vertex_normals(vertices, triangles, self.boundary.patch_of_face[face])
        return unit(normals[:, :2].mean(axis=1).reshape(len(faces), 4, 3).mean(axis=1))

    @cached_property
    def rings(self) -> Rows:
        """Edge neighbours of each node, of those that slide only the ones on their own curve or patch, and its ends."""
        kind, whole = self.kind, self.mesh.topology.rings
        node = np.repeat(np.arange(self.mesh.n_nodes), np.diff(whole.start))
        ways = [np.stack([node, whole.items], axis=1)[self._number[node] < 0]]
        for of, along in (Kind.CURVE, self.boundary.segments), (Kind.PATCH, self.skin.edges.nodes):
            both = np.concatenate([along, along[:, ::-1]])
            ways.append(both[kind[both[:, 0]] == of])
        ways = np.concatenate(ways)
        ways = ways[np.lexsort((ways[:, 1], ways[:, 0]))]
        start = np.searchsorted(ways[:, 0], np.arange(self.mesh.n_nodes + 1))
        return Rows(start.astype(np.int32), np.ascontiguousarray(ways[:, 1], dtype=np.int32))

    @cached_property
    def skin(self) -> Skin:
        """The boundary as it was, as a whole."""
        return Skin(self._points, self.boundary.faces)

    @property
    def target(self) -> Skin:
        """The surface, as a whole: that of the mesh's target, or else the boundary as it was."""
        return self.mesh.target or self.skin

    @cached_property
    def middles(self) -> np.ndarray:
        """Nodes whose means are the middles of the boundary's edges and faces, (s, 4) int: an edge's nodes twice."""
        nodes = np.tile(self.skin.nodes[:, None], 4)
        return np.concatenate([np.tile(self.skin.edges.nodes, 2), self.boundary.faces, nodes])

    def middles_at(self, nodes: np.ndarray) -> np.ndarray:
        """Which of `middles` move with some nodes, (k,) int64."""
        moved = np.zeros(self.mesh.n_nodes, dtype=bool)
        moved[nodes] = True
        return np.flatnonzero(moved[self.middles].any(axis=1))

    def off(self, points: np.ndarray, which: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """How far some of `middles` are from the surface, (k,), and the unit vectors that lead away from it, (k, 3)."""
        x = points[self.middles[which]].mean(axis=1)
        away = x - self.target.closest(x)
        far = np.linalg.norm(away, axis=1)
        return far, away / np.maximum(far, np.finfo(float).tiny)[:, None]

    def behind(
        self, points: np.ndarray, which: np.ndarray | slice = slice(None)
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """How far the surface's nodes and middles, or some of them, are from the boundary as it is now.

        Returns
        -------
        far : (s,)
        away : (s, 3)
            Unit vectors from the boundary to them.
        nodes, weights : (s, 4)
            What makes the closest places of the boundary.
        """
        x = self._samples[which]
        places, nodes, weights = self.skin.with_points(points).closest_on(x)
        far = np.linalg.norm(x - places, axis=1)
        return far, (x - places) / np.maximum(far, np.finfo(float).tiny)[:, None], nodes, weights

    def leaves_behind(self, points: np.ndarray, room: float) -> bool:
        """Whether the boundary may have left a place of the surface by more: not where each node is that near."""
        if self.mesh.target is not None:
            return True
        nodes = self.skin.nodes
        return bool((np.square(points[nodes] - self._points[nodes]).sum(axis=1) > max(room, 0.0) ** 2).any())

    @cached_property
    def _samples(self) -> np.ndarray:
        if self.mesh.target is not None:
            return self.mesh.target.samples()
        return self._points[self.middles].mean(axis=1)

    @cached_property
    def _at_first(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Where `middles` are before anything slides, and how far from the surface; how far its samples are from the
        boundary, and the nodes that make what is closest.
        """
        points = self._points.copy()
        points[self.nodes] = self.put_back(points[self.nodes])
        places = points[self.middles].mean(axis=1)
        if self.mesh.target is None:
            return places, np.zeros(len(places)), np.zeros(len(places)), self.middles
        far, _, nodes, _ = self.behind(points)
        return places, self.off(points, np.arange(len(places)))[0], far, nodes

    def beyond(self, points: np.ndarray) -> np.ndarray:
        """The nodes at which the boundary has left its room, further than it was at first, (k,) int.

        Where it is far from a place of the surface these are the nodes that are closest to it, and that were at first.
        What has not moved as far as its room is wide need not be asked for its distance.
        """
        if not np.isfinite(self.room):
            return NOBODY
        places, far_at_first, behind_at_first, nodes_at_first = self._at_first
        moved = np.linalg.norm(points[self.middles].mean(axis=1) - places, axis=1)
        which = np.flatnonzero(moved + far_at_first > self.room)
        if not which.size:
            return which
        most = np.maximum(far_at_first[which], self.room) * (1 + _ROUNDING)
        beyond = [self.middles[which[self.off(points, which)[0] > most]].ravel()]
        if self.mesh.target is not None:
            which = np.arange(len(self._samples))
        far, _, nodes, _ = self.behind(points, which)
        most = np.maximum(behind_at_first[which], self.room) * (1 + _ROUNDING)
        beyond += [nodes[far > most].ravel(), nodes_at_first[which[far > most]].ravel()]
        return np.unique(np.concatenate(beyond))

    def turned(self, before: np.ndarray, after: np.ndarray) -> np.ndarray:
        """Faces of the boundary with a corner that is turned over after a step and was not before, (k,) int.

        A corner of a quad is turned over if its normal is against that of the boundary there as it was, or it is flat.

        Parameters
        ----------
        before, after : (n, 3) float64
        """
        found = np.empty(len(self.boundary.faces), dtype=bool)
        kernels.turned(before, after, self.boundary.faces, self.outward, found)
        return np.flatnonzero(found)

    def unturned(self, before: np.ndarray, after: np.ndarray) -> np.ndarray:
        """The points after a step, of which those nodes stay whose quads it would turn over, until none is."""
        while (faces := self.turned(before, after)).size:
            nodes = np.unique(self.boundary.faces[faces])
            after = after.copy()
            after[nodes] = before[nodes]
        return after

    def refused(self, before: np.ndarray, after: np.ndarray) -> np.ndarray:
        """Nodes that a step must not take where it does, (k,) int: it would turn a quad over, or leave the room."""
        turned = self.boundary.faces[self.turned(before, after)].ravel()
        return np.union1d(turned, self.beyond(after))

    def held(
        self, before: np.ndarray, after: np.ndarray, harmed: Callable[[np.ndarray], np.ndarray] = lambda after: NOBODY
    ) -> np.ndarray:
        """The points after a step, of which those nodes stay that are refused to go, until none is.

        Parameters
        ----------
        before, after : (n, 3) float64
        harmed : callable
            From points (n, 3) to more nodes, (k,) int, that are refused to be there.
        """
        while True:
            nodes = np.union1d(self.refused(before, after), harmed(after))
            nodes = nodes[(after[nodes] != before[nodes]).any(axis=1)]
            if not nodes.size:
                return after
            after = after.copy()
            after[nodes] = before[nodes]

    def _closest(self, x: np.ndarray, nodes: np.ndarray | None) -> Closest:
        return self.surface.trees.closest(x, self._group if nodes is None else self._group[self._number[nodes]])


def kept_bends(mesh: Mesh, boundary: Boundary) -> np.ndarray:
    """Nodes of curves that had better not slide, (k,) int: of a face with both edges at the node on the curve.

    The bend of the curve at such a node is all that holds the hex's corner open: on one straight segment with its
    neighbours it would be flat for good, sigma being 0 and its derivative along the curve too. Where the corner is
    inverted as it is, the node may as well slide.
    """
    hexes, sides = np.nonzero(mesh.topology.face_neighbours < 0)
    ahead = _keys(boundary.faces, np.roll(boundary.faces, -1, axis=1), mesh.n_nodes)
    on_curve = np.isin(ahead, _keys(*boundary.segments.T, mesh.n_nodes))
    at = on_curve & np.roll(on_curve, 1, axis=1) & (boundary.kind[boundary.faces] == Kind.CURVE)
    face, place = np.nonzero(at)
    sigma = corner_determinants(mesh.points, mesh.hexes, hexes[face])
    corner = FACES[sides[face], place]
    return np.unique(boundary.faces[face, place][sigma[np.arange(face.size), corner] > 0])


def _keys(one: np.ndarray, other: np.ndarray, n: int) -> np.ndarray:
    return np.minimum(one, other).astype(np.int64) * n + np.maximum(one, other)


def _across(normals: np.ndarray) -> np.ndarray:
    """Two unit vectors at right angles to each other and to each normal, the columns of (k, 3, 2); 0 where it is 0."""
    least = np.abs(normals).argmin(axis=1)
    one = np.cross(normals, np.eye(3)[least])
    one /= np.maximum(np.linalg.norm(one, axis=1, keepdims=True), np.finfo(float).tiny)
    return np.stack([one, np.cross(normals, one)], axis=-1)
