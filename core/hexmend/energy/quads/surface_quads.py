"""Quads of a sliding boundary whose shape counts in the objective (Wilson 5.2.1).

Normals of the surface at the boundary's quads, each on the quad's own patch.

Term of an energy that the quads of a sliding boundary add: value, gradient, and blocks of the Hessian.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hexmend.arrays import row_norms
from hexmend.boundary.classification import NodeClass
from hexmend.boundary.closest_point import ClosestPointCache
from hexmend.boundary.normals import directions_of_means
from hexmend.boundary.sliding.sliding_boundary import SlidingBoundary
from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.norm import ObjectiveNorm, SurfaceObjective
from hexmend.energy.quads.quad_energy import QuadCorners, power_derivatives
from hexmend.energy.target import wanted_lengths
from hexmend.energy.terms import ElementBlocks, Term
from hexmend.kernels import sliding_surface
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.solid_cells import SOLID_KINDS, WEDGE, cell_faces, kinds_of


@dataclass(frozen=True, eq=False)
class SurfaceTerm(Term):
    """Sum of weight eta(Q)^p over the quads of a boundary, with normals and delta that are held for a step.

    Parameters
    ----------
    quads : (f, 4) int32
        Nodes, counter-clockwise from outside.
    counted : (f, 4) bool
        False for corners that count as perfect.
    normals : (f, 3) float64
        Outward unit normals of the surface at the quads.
    scales : (2, f, 4) float64
        Inverse lengths, in the energy's unit, that the edges to the next and the previous corner are to have; 1 without
        a target.
    weight : float
    delta : float
        Softens the barrier: in squares of the energy's unit of length.
    blocks : ElementBlocks
        Of the quads.
    has_lengths : bool
        True if the edges are to have lengths of their own, with a target.
    """

    quads: np.ndarray
    counted: np.ndarray
    normals: np.ndarray
    scales: np.ndarray
    weight: float
    delta: float
    blocks: ElementBlocks
    has_lengths: bool = False

    @property
    def total_weight(self) -> float:
        """Sum of the weights of the quads: the term has so many times the value of a hex if all of them are squares."""
        return self.weight * len(self.quads)

    def value(self, x: np.ndarray, norm: ObjectiveNorm) -> float:
        """Compute the term at points x (n, 3) in the energy's unit; +inf at delta = 0 with a flipped corner."""
        with np.errstate(over="ignore"):
            energy = np.maximum(self.corners(x).energies(norm.offset), 0.0)
            return self.weight * float(np.power(energy, norm.p).sum())

    def gradient(self, x: np.ndarray, norm: ObjectiveNorm) -> np.ndarray:
        """Compute the gradient by all nodes, (n, 3); see `value`."""
        corners = self.corners(x)
        first, _ = power_derivatives(corners.energies(norm.offset), norm.p)
        shares = (self.weight * first)[:, None, None] * corners.gradients()
        at = self.quads.ravel()
        return np.stack([np.bincount(at, shares[:, :, k].ravel(), len(x)) for k in range(3)], axis=1)

    def assemble(self, x: np.ndarray, norm: ObjectiveNorm, matrix: AssembledHessian) -> None:
        """Add the second derivatives to a matrix; see `value`."""
        corners = self.corners(x)
        first, second = power_derivatives(corners.energies(norm.offset), norm.p)
        gradients = corners.gradients()
        outer = np.einsum("fai,fbj->fabij", gradients, gradients)
        pairs = first[:, None, None, None, None] * corners.hessians() + second[:, None, None, None, None] * outer
        pairs *= self.weight
        self.blocks.add(pairs, matrix)

    def corners(self, x: np.ndarray) -> QuadCorners:
        """Compute the corners of the quads at points x (n, 3) in the energy's unit."""
        return QuadCorners.of(x[self.quads], self.normals, self.scales, self.counted, self.delta)

    def sigma(self, x: np.ndarray) -> np.ndarray:
        """Compute the least sigma of the counted corners of each quad, (f,): in squares of the energy's unit."""
        sigma = self.corners(x).sigma
        return np.where(self.counted, sigma, np.inf).min(axis=1, initial=np.inf)

    def of_kernels(self, unit: float) -> sliding_surface.SurfaceTerm:
        """Return the term as the kernels of local methods take it, with `delta` in units of a node's patch.

        Parameters
        ----------
        unit : float
            The energy's unit of length in the unit of the points that the kernels are given.
        """
        scales = None
        if self.has_lengths:
            scales = np.ascontiguousarray(self.scales.transpose(1, 2, 0)).reshape(-1, 8) / unit
        counted = self.counted.view(np.uint8)
        return sliding_surface.SurfaceTerm(counted, self.normals, scales, self.weight, self.delta)


class QuadNormals:
    """Outward unit normals of the surface on which a boundary slides, at the boundary's quads.

    That of a quad is the mean over its corners, each at the closest point of the patch of the quad: nodes on curves are
    on several. On a target surface it is the patch on which a node of the quad slides. A quad without one, or around
    which the surface turns back, keeps the normal of the original boundary.

    Parameters
    ----------
    sliding : SlidingBoundary
        The quads are the faces of its `boundary`.
    """

    def __init__(self, sliding: SlidingBoundary):
        self._surface, self._faces, self._outward = sliding.surface, sliding.boundary.faces, sliding.outward
        patch = sliding.boundary.patch_of_face
        if sliding.mesh.target is not None:
            on_patch = sliding.node_class[self._faces] == NodeClass.PATCH
            patches = np.where(on_patch, sliding.surface.component[self._faces], -1)
            patch = patches.max(axis=1, initial=-1)
        self._quads = np.flatnonzero(patch >= 0)
        self._cache = ClosestPointCache(sliding.surface.trees, np.repeat(patch[self._quads], 4))

    def __call__(self, points: np.ndarray) -> np.ndarray:
        """Compute the normals with the nodes at some points.

        Parameters
        ----------
        points : (n, 3) float64
            In the mesh's unit of length.

        Returns
        -------
        (f, 3) float64
            0 where neither the surface nor the original boundary has a normal.
        """
        at, outward = self._quads, self._outward[self._quads]
        found = self._cache.closest(points[self._faces[at].ravel()])
        mean = self._surface.directions(found).reshape(-1, 4, 3).mean(axis=1)
        side = np.where(np.einsum("fi,fi->f", mean, outward) < 0, -1, 1)  # triangles of a file may face either way
        normals = self._outward.copy()
        normals[at] = directions_of_means(side[:, None] * mean, outward)
        return normals


#: Unit normals shorter than this are those of a surface so small that numbers underflow.
_LEAST_NORMAL = 0.5


class SurfaceQuads:
    """Quads of a boundary whose nodes slide, as a term of the objective: weight times the sum of eta(Q)^p.

    Corners between two edges of curves count as perfect, as the curves determine their angle, and so do those whose
    three nodes stay.

    Parameters
    ----------
    sliding : SlidingBoundary
    norm : ObjectiveNorm
        p and offset of the objective, of hexes and of quads.
    weight : float
        Weight of a quad relative to a hex, greater than 0.

    Attributes
    ----------
    unit : float
        Mean edge length of the mesh, the unit of the term.
    """

    def __init__(self, sliding: SlidingBoundary, norm: ObjectiveNorm, weight: float):
        mesh = sliding.mesh
        quads = np.ascontiguousarray(sliding.boundary.faces, dtype=np.int32)
        self.norm, self.weight, self.unit = norm, weight, mesh.mean_edge_length or 1.0
        self._normals = QuadNormals(sliding)
        lengths = wanted_lengths(mesh)
        scales = _scales(mesh.elements, quads, lengths, self.unit)
        counted, normals = _counted_corners(sliding), np.zeros((len(quads), 3))
        self._term = SurfaceTerm(
            quads, counted, normals, scales, weight, 0.0, ElementBlocks(quads), lengths is not None
        )
        self._last: tuple[np.ndarray | None, SurfaceTerm] = None, self._term

    def at(self, points: np.ndarray, delta: float, softening: float) -> SurfaceTerm:
        """Return the term for a step from some points: normals are held, and quads softened while one is flipped.

        Parameters
        ----------
        points : (n, 3) float64
            In the mesh's unit of length.
        delta : float
            That of the hexes, which quads have too if it is greater than theirs.
        softening : float
            The least delta of the quads while one of them is flipped.
        """
        term = self._with_normals(points)
        is_sound = (term.sigma(points / self.unit) > 0).all()
        return replace(term, delta=delta if is_sound else max(delta, softening))

    def objective(self, points: np.ndarray) -> SurfaceObjective:
        """Compute the term at points (n, 3) in the mesh's unit, for delta = 0; no value if they are not finite."""
        if not np.isfinite(points).all():
            return SurfaceObjective(self.weight, len(self._term.quads), None)
        term = self._with_normals(points)
        value = term.value(points / self.unit, self.norm)
        return SurfaceObjective(self.weight, len(term.quads), value if np.isfinite(value) else None)

    def corners(self, points: np.ndarray) -> QuadCorners:
        """Compute the corners of the quads at points (n, 3) in the mesh's unit, with their qualities."""
        return self._with_normals(points).corners(points / self.unit)

    def _with_normals(self, points: np.ndarray) -> SurfaceTerm:
        """Return the term with the normals at some points (n, 3), and delta = 0; the last result is kept."""
        known, term = self._last
        if known is not points:
            normals = self._normals(points)
            counted = self._term.counted & (row_norms(normals) > _LEAST_NORMAL)[:, None]
            term = replace(self._term, normals=normals, counted=counted)
            self._last = points, term
        return term


def _counted_corners(sliding: SlidingBoundary) -> np.ndarray:
    """Mark the corners of boundary quads whose shape sliding nodes can change, (f, 4) bool; none of triangles."""
    faces, free = sliding.boundary.faces, sliding.mesh.free[sliding.boundary.faces]
    n, segments = sliding.mesh.n_nodes, np.sort(sliding.boundary.segments.astype(np.int64), axis=1)
    sides = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).astype(np.int64), axis=2)
    on_curve = np.isin(sides[:, :, 0] * n + sides[:, :, 1], segments[:, 0] * n + segments[:, 1])
    moves = free | np.roll(free, -1, axis=1) | np.roll(free, 1, axis=1)
    is_quad = faces[:, 2] != faces[:, 3]
    return moves & ~(on_curve & np.roll(on_curve, 1, axis=1)) & is_quad[:, None]


def _scales(hexes: np.ndarray, quads: np.ndarray, lengths: np.ndarray | None, unit: float) -> np.ndarray:
    """Inverse lengths that edges of quads (f, 4) are to have, in mean edge lengths; see `SurfaceTerm`.

    Parameters
    ----------
    hexes : (m, 8) int32
    quads : (f, 4) int32
    lengths : (m, 3) float64 or None
        Lengths of the targets of the hexes; of the two hexes at an interface those of the later.
    unit : float
        Mean edge length.

    Returns
    -------
    (2, f, 4) float64
    """
    if lengths is None:
        return np.ones((2, len(quads), 4))
    corners = np.sort(cell_faces(hexes).reshape(-1, 4), axis=1)
    _, number = np.unique(np.concatenate([corners, np.sort(quads, axis=1)]), axis=0, return_inverse=True)
    number = number.ravel()
    face_of = np.empty(number.max(initial=-1) + 1, dtype=np.int64)
    face_of[number[: len(corners)]] = np.arange(len(corners))
    hex_of = face_of[number[len(corners) :]] // 6
    local = (hexes[hex_of][:, None, :] == quads[:, :, None]).argmax(axis=2)  # corner of the hex, (f, 4)
    after = np.roll(local, -1, axis=1)
    along = np.abs(UNIT_CUBE[after] - UNIT_CUBE[local]).argmax(axis=2)
    kinds, upright = kinds_of(hexes[hex_of])[:, None], np.abs(after - local) == 3  # edges between a wedge's triangles
    along = np.where(kinds == 0, along, np.where((SOLID_KINDS.index(WEDGE) == kinds) & upright, 2, 0))
    to_next = unit / lengths[hex_of[:, None], along]
    return np.stack([to_next, np.roll(to_next, 1, axis=1)])
