"""Topology of a mesh: incidences that follow from its connectivity, each computed on first use."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hexmend.arrays import as_immutable, mask
from hexmend.kernels import incidence, structure, wavefronts
from hexmend.kernels.hex_mesh import HexMesh
from hexmend.mesh.fields import as_set
from hexmend.mesh.size_limits import MAX_HEXES, MAX_ITEMS, overflow_as_mesh_error
from hexmend.mesh.solid_cells import face_nodes, kinds_of
from hexmend.mesh.topology.components import any_of_rows, components
from hexmend.mesh.topology.split_faces import close_split_faces
from hexmend.mesh.validation import as_bools, as_hexes
from hexmend.parameters import Parameter

_RINGS = Parameter("rings", int, 0, 0, MAX_HEXES, None, "", "")


@dataclass(frozen=True)
class CSR:
    """Compressed sparse rows: row i is `items[start[i]:start[i + 1]]`.

    Parameters
    ----------
    start : (rows + 1,) int32
    items : (start[-1],) int32
    """

    start: np.ndarray
    items: np.ndarray

    def __getitem__(self, i: int) -> np.ndarray:
        return self.items[self.start[i] : self.start[i + 1]]

    def __len__(self) -> int:
        return self.start.size - 1

    def of(self, rows: np.ndarray) -> np.ndarray:
        """Return the items of several rows (k,), one row after another, (j,) int32."""
        count = self.start[rows + 1] - self.start[rows]
        before = np.cumsum(count) - count
        return self.items[np.arange(count.sum()) + np.repeat(self.start[rows] - before, count)]

    def without(self, omitted: np.ndarray) -> CSR:
        """Return the rows without the items i for which omitted[i]; omitted is (n,) bool."""
        kept = ~omitted[self.items]
        start = np.concatenate([[0], np.cumsum(kept)])[self.start]
        return CSR(start.astype(np.int32), self.items[kept])


class Topology:
    """Incidences of nodes, edges, faces and cells of a mesh.

    Parameters
    ----------
    elements : (m, 8) int32
        Nodes of hexes and other cells, numbered as in `hexmend.mesh.solid_cells`; copied unless immutable.
    n : int
        Number of nodes, used by a cell or not.
    n_hexes : int, optional
        Number of the first rows that are the mesh's hexes; all by default.

    Attributes
    ----------
    hexes : (n_hexes, 8) int32
        These rows; `elements` itself if they are all.

    Raises
    ------
    MeshError
        If the rows are not (m, 8) whole numbers from 0 to n - 1.
    """

    def __init__(self, elements: np.ndarray, n: int, n_hexes: int | None = None):
        self.n = n
        self._set_elements(as_hexes(elements, n), len(elements) if n_hexes is None else n_hexes)

    def _set_elements(self, elements: np.ndarray, n_hexes: int) -> None:
        self.elements = as_immutable(elements)
        self.hexes = self.elements if n_hexes == len(elements) else self.elements[:n_hexes]

    def __setstate__(self, state: Mapping[str, object]) -> None:
        self.__dict__.update(state)
        self._set_elements(self.elements, len(self.hexes))  # arrays that come out of a pickle are writable

    @cached_property
    def node_corners(self) -> CSR:
        """Hex corners at each node; items are 8 * hex + corner."""
        return CSR(*incidence.node_corners(self.elements, self.n))

    @property
    def _corners_of_nodes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The hexes, and the corners at each node as two arrays, as kernels take them."""
        return self.elements, self.node_corners.start, self.node_corners.items

    @cached_property
    def overlapping_corners(self) -> CSR:
        """Corners at each node whose cones overlap if they are positive; items are 8 * hex + corner.

        Two faces at the node have the same two edges there, and hexes on the same side. The proof is in
        `hexmend.locking.hexes_without_valid_position`.
        """
        return CSR(*incidence.overlapping_corners(*self._corners_of_nodes))

    @property
    def hex_mesh(self) -> HexMesh:
        """The hexes and `node_corners` as the kernels of methods take them; a view, cheap to make."""
        return HexMesh(*self._corners_of_nodes)

    @cached_property
    def used(self) -> np.ndarray:
        """True for each node that a hex uses, (n,) bool."""
        return mask(self.elements.ravel(), self.n)

    @cached_property
    def _faces(self) -> tuple[np.ndarray, int, np.ndarray]:
        neighbours, nonmanifold = incidence.face_neighbours(*self._corners_of_nodes)
        closed, hanging = close_split_faces(self.elements, neighbours)
        return closed, nonmanifold, hanging

    @cached_property
    def hanging(self) -> np.ndarray:
        """Nodes in the middle of edges and faces of coarser cells, with their masters, (h, 5) int32.

        See `close_split_faces`.
        """
        return self._faces[2]

    @property
    def face_neighbours(self) -> np.ndarray:
        """Neighbour across each face of `hexmend.mesh.solid_cells.SolidKind.faces`, (m, 6) int32.

        -1 on the boundary; the cell itself for a face that its kind does not have, and where several faces cover one.
        """
        return self._faces[0]

    @property
    def hex_neighbours(self) -> np.ndarray:
        """Hex across each face of the hexes, -1 where there is none, (n_hexes, 6) int32."""
        return self._among_hexes(self.face_neighbours)

    @property
    def neighbours_in_any_order(self) -> np.ndarray:
        """`hex_neighbours`, whatever the order in which both hexes have the nodes of a face."""
        if not self.n_nonmanifold_faces:
            return self.hex_neighbours
        return self._among_hexes(incidence.face_neighbours(*self._corners_of_nodes, opposed=False)[0])

    def _among_hexes(self, neighbours: np.ndarray) -> np.ndarray:
        n = len(self.hexes)
        return neighbours if n == len(self.elements) else np.where(neighbours[:n] < n, neighbours[:n], -1)

    def release_faces(self) -> None:
        """Give back the memory of `face_neighbours`; they are computed again on the next use."""
        self.__dict__.pop("_faces", None)

    def release_rings(self) -> None:
        """Give back the memory of `rings`; they are computed again on the next use."""
        self.__dict__.pop("rings", None)

    @property
    def n_nonmanifold_faces(self) -> int:
        """Number of faces of more than two hexes, or of two on the same side; they are treated as boundary.

        They are counted once a hex.
        """
        return self._faces[1]

    @cached_property
    def boundary_faces(self) -> np.ndarray:
        """Nodes of each boundary face, counter-clockwise from outside, (k, 4) int32; triangles repeat their last."""
        h, f = np.nonzero(self.face_neighbours < 0)
        return face_nodes(self.elements, h, f)

    @cached_property
    def boundary(self) -> np.ndarray:
        """True for each node of a boundary face, (n,) bool."""
        return mask(self.boundary_faces.ravel(), self.n)

    @cached_property
    def layers(self) -> np.ndarray:
        """Distance of each hex from the boundary, in hexes counted through faces, (m,) int32.

        0 for a hex with a boundary face; hexes that are not connected to the boundary are in one last layer.
        """
        behind = self.face_neighbours
        inside = behind >= 0
        start = np.append(0, np.cumsum(inside.sum(axis=1))).astype(np.int32)
        return wavefronts.levels(start, behind[inside], np.logical_or.reduce(behind < 0, axis=1))

    def hexes_around(self, hexes: Iterable[int], rings: int) -> np.ndarray:
        """Find some hexes and those in rings around them.

        Parameters
        ----------
        hexes : iterable of int
        rings : int
            Number of rings; each adds the hexes that share a node with those before.

        Returns
        -------
        (m,) bool

        Raises
        ------
        MeshError
            For a hex that does not exist.
        ParameterError
            For rings that are no whole number from 0 to the largest number of hexes.
        """
        rings = _RINGS.check(rings)
        chosen = as_set(hexes if isinstance(hexes, np.ndarray) else list(hexes), "the set of hexes", len(self.elements))
        reached = mask(chosen, len(self.elements))
        for _ in range(rings):
            before, reached = reached, any_of_rows(mask(self.elements[reached], self.n), self.elements)
            if np.array_equal(before, reached):
                break
        return reached

    @cached_property
    def parts(self) -> int:
        """Number of components connected by nodes."""
        return int(components(self.n, self.elements).max(initial=-1)) + 1 - int(np.count_nonzero(~self.used))

    @cached_property
    def rings(self) -> CSR:
        """Edge neighbours of each node, ascending."""
        with overflow_as_mesh_error("neighbours of nodes"):
            return CSR(*incidence.node_rings(*self._corners_of_nodes, MAX_ITEMS))

    @cached_property
    def _edges(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        with overflow_as_mesh_error("edges"):
            return structure.edges(*self._corners_of_nodes, self.face_neighbours, MAX_ITEMS)

    @property
    def edges(self) -> np.ndarray:
        """Unique edges, lower node first, ascending, (e, 2) int32."""
        return self._edges[0]

    @property
    def edge_valence(self) -> np.ndarray:
        """Number of hexes around each edge of `edges`, (e,) int32."""
        return self._edges[1]

    @property
    def edge_on_boundary(self) -> np.ndarray:
        """True for each edge of `edges` that is an edge of a boundary face, (e,) bool."""
        return self._edges[2]

    @cached_property
    def irregular_edges(self) -> np.ndarray:
        """Interior edges without exactly four hexes, as numbers of `edges`, (k,) int64.

        They form the singularity graph of the mesh: Gao, Deng and Chen, "Hexahedral mesh re-parameterization from
        aligned base-complex" (2015). Boundary edges, regular with two hexes, are in `irregular_boundary_edges`.
        """
        return np.flatnonzero((self.edge_valence != 4) & ~self.edge_on_boundary & self._edge_of_hexes)

    @cached_property
    def irregular_boundary_edges(self) -> np.ndarray:
        """Boundary edges without exactly two hexes, as numbers of `edges`, (k,) int64.

        They include the sharp edges of the boundary, with one hex if convex, three if concave.
        """
        return np.flatnonzero((self.edge_valence != 2) & self.edge_on_boundary & self._edge_of_hexes)

    @property
    def _edge_of_hexes(self) -> np.ndarray | bool:
        """True for edges that have no node of another cell than a hex, (e,) bool, or True for all."""
        others = self.elements[kinds_of(self.elements) > 0]
        return ~mask(others.ravel(), self.n)[self.edges].any(axis=1) if len(others) else True

    @cached_property
    def irregular_nodes(self) -> np.ndarray:
        """Interior nodes at which one, three or more irregular interior edges meet, (k,) int64."""
        nodes, meeting = np.unique(self.edges[self.irregular_edges], return_counts=True)
        return nodes[(meeting != 2) & ~self.boundary[nodes]].astype(np.int64)

    def colouring(self, chosen: np.ndarray) -> CSR:
        """Colour nodes so that no hex has two nodes of one colour; nodes of one colour can move in parallel.

        Parameters
        ----------
        chosen : (n,) bool
            Nodes to be coloured.

        Returns
        -------
        CSR
            Nodes of each colour.

        Raises
        ------
        MeshError
            For an array of another length or type.
        """
        rows, chosen = self.node_corners, as_bools(chosen, "chosen", self.n)
        colour = incidence.greedy_colours(rows.start, rows.items, chosen)
        count = int(colour.max(initial=-1)) + 1
        return CSR(*incidence.grouped(colour, count))

    def wavefronts(self, sequence: np.ndarray) -> CSR:
        """Divide a sequence of nodes into groups whose nodes can be visited in parallel, group after group.

        No hex has two nodes of one group, and nodes that share a hex keep their order: the result is that of visiting
        the nodes one by one.

        Parameters
        ----------
        sequence : (k,) int32
            Numbers of nodes, each at most once.

        Returns
        -------
        CSR
            Nodes of each group.

        Raises
        ------
        MeshError
            For a node that does not exist.
        """
        rows, nodes = self.node_corners, as_set(sequence, "sequence", self.n)
        return CSR(*wavefronts.wavefronts(rows.start, rows.items, np.ascontiguousarray(nodes, np.int32)))

    def levels(self, start: np.ndarray) -> np.ndarray:
        """Compute the distance of each node from the nearest of some start nodes, in edges.

        Parameters
        ----------
        start : (n,) bool
            True for start nodes.

        Returns
        -------
        (n,) int32
            0 for start nodes; nodes that are not connected to them are in one last level.

        Raises
        ------
        MeshError
            For an array of another length or type.
        """
        rings = self.rings
        return wavefronts.levels(rings.start, rings.items, as_bools(start, "start", self.n))
