"""Skin of a mesh or of its shown part: the faces that are visible from outside."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.kernels import skin
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import cell_faces, centres, has_node
from hexmend.mesh.validation import as_bools, as_points, check_node_numbers

#: Maximum number of shrunk hexes that are all drawn; of more hexes, only those with a visible face are. They take 50 ms
#: a frame in software rendering.
WHOLE = 4_000


@dataclass(frozen=True, eq=False)
class Faces:
    """Visible quads.

    Parameters
    ----------
    nodes : (u,) int32
        Nodes of the mesh that the quads use.
    quads : (k, 4) int32
        Indices into `nodes`, counter-clockwise as seen from outside; a triangle repeats its last.
    hexes : (k,) int32
        Hex of each quad.
    shrink : float
        Fraction by which nodes are moved towards the mean of their hex; if it is not 0, `nodes` lists the eight nodes
        of each hex.
    """

    nodes: np.ndarray
    quads: np.ndarray
    hexes: np.ndarray
    shrink: float = 0.0

    @classmethod
    def of(cls, faces: np.ndarray, hexes: np.ndarray) -> Faces:
        """Return faces from the nodes of each, (k, 4) int32, and its hex, (k,) int."""
        nodes, quads = np.unique(faces, return_inverse=True)
        return cls(nodes, quads.reshape(faces.shape), hexes)

    def places(self, points: np.ndarray) -> np.ndarray:
        """Return the drawn positions of the nodes, (u, 3), from the points of the mesh, (n, 3) float64."""
        if not self.shrink:
            return points[self.nodes]
        points = as_points(points)
        check_node_numbers(self.nodes[:, None], len(points), ("place", "column"))
        cells = self.nodes.reshape(-1, 8)
        middles = centres(points, cells)[:, None]
        return (self.shrink * middles + (1 - self.shrink) * points[cells]).reshape(-1, 3)


class Skin:
    """Finds the visible faces of parts of a mesh.

    Parameters
    ----------
    mesh : Mesh
    """

    def __init__(self, mesh: Mesh):
        self._hexes = mesh.elements
        self._neighbours = mesh.topology.face_neighbours
        cells, faces = np.nonzero(self._neighbours == np.arange(mesh.n_elements)[:, None])
        exist = cell_faces(mesh.elements[cells])[np.arange(len(cells)), faces, 0] >= 0
        if exist.any():  # faces that several others cover are always drawn
            self._neighbours = self._neighbours.copy()
            self._neighbours[cells[exist], faces[exist]] = -1
        self._all = np.ones(mesh.n_elements, dtype=bool)
        self._n_nodes = mesh.n_nodes

    def visible(self, keep: np.ndarray | None = None) -> Faces:
        """Return the faces of kept hexes without a kept neighbour.

        Parameters
        ----------
        keep : (m,) bool, optional
            True for kept hexes; None for all.
        """
        keep = self._kept(keep)
        return Faces(*skin.visible(self._n_nodes, self._hexes, self._neighbours, keep))

    def shrunk(self, shrink: float, keep: np.ndarray | None = None) -> Faces:
        """Return all faces of hexes that are drawn shrunk; of more than `WHOLE` hexes, of those with a visible face."""
        keep = chosen = self._kept(keep)
        if np.count_nonzero(keep) > WHOLE:
            chosen = keep & ((self._neighbours < 0) | ~keep[self._neighbours]).any(axis=1)
        numbers = np.flatnonzero(chosen).astype(np.int32)
        cells = self._hexes[numbers]
        columns = np.minimum(np.arange(8), has_node(cells).sum(axis=1, keepdims=True) - 1)
        quads = cell_faces((columns + 8 * np.arange(len(cells))[:, None]).astype(np.int32))
        exists = quads[:, :, 0] >= 0
        return Faces(cells.ravel(), quads[exists], numbers[np.nonzero(exists)[0]], shrink)

    def opened(self, faces: Faces, keep: np.ndarray | None = None) -> np.ndarray:
        """Return True for faces inside the mesh, whose adjacent hex is hidden, (k,) bool.

        Parameters
        ----------
        faces : Faces
            Result of `visible` or `shrunk` for the same `keep`.
        keep : (m,) bool, optional
        """
        # Faces are sorted by hex, and by their number in the hex.
        hexes = faces.hexes[np.flatnonzero(np.diff(faces.hexes, prepend=-1))]
        behind = self._neighbours[hexes]
        inside = behind >= 0
        if faces.shrink:
            return inside[cell_faces(self._hexes[hexes])[:, :, 0] >= 0]
        keep = self._kept(keep)
        return inside[~(inside & keep[behind])]

    def _kept(self, keep: np.ndarray | None) -> np.ndarray:
        """Return the mask of kept hexes, (m,) bool; raise `MeshError` if its length is wrong."""
        return self._all if keep is None else as_bools(keep, "keep", len(self._hexes))


def edges_of_kept(mesh: Mesh, edges: np.ndarray, keep: np.ndarray | None) -> np.ndarray:
    """Return True for edges, (k, 2) int32, of kept hexes, (k,) bool.

    Parameters
    ----------
    mesh : Mesh
    edges : (k, 2) int32
        Nodes of edges of hexes.
    keep : (m,) bool, optional
        True for kept hexes; None for all.
    """
    mask = np.ones(len(edges), dtype=bool)
    if keep is not None:
        rows = mesh.topology.node_corners
        skin.edges_kept(mesh.elements, rows.start, rows.items, edges, keep, mask)
    return mask
