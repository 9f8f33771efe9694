"""Sheets: layers of hexes between some faces of a mesh and copies of their nodes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hexmend.arrays import mask
from hexmend.errors import MeshError
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology.components import components

#: Face of a new hex on the padded face, and the one opposite.
OUTER, INNER = 5, 4
#: Face of a new hex over side i of its outer face, from corner i to corner i + 1.
LATERAL = np.array([2, 1, 3, 0])


class CrossingError(MeshError):
    """Edge at which a layer would cross itself; `nodes` are its ends, (2,) int."""

    def __init__(self, nodes: np.ndarray):
        self.nodes = nodes
        super().__init__(
            f"a layer cannot be closed at the edge between the nodes {nodes[0]} and {nodes[1]}: the hexes that it "
            "encloses touch each other there, and are connected at both ends of the edge. Divide the nodes of the edge"
        )


@dataclass(frozen=True, eq=False)
class Sheet:
    """Layer of hexes, one under each of some faces; the hexes behind use copies of the nodes of these faces.

    Nodes and hexes of the mesh keep their numbers, and the faces their nodes; the copies and the new hexes follow.

    Parameters
    ----------
    mesh : Mesh
    region : (m,) bool
        Hexes behind the faces, and those connected to them: only these use the copies.
    faces : (k, 2) int64
        A hex of the region and its face, for each face.

    Raises
    ------
    CrossingError
        If the hexes touch each other at an edge so that the sheet would cross itself there.
    """

    mesh: Mesh
    region: np.ndarray
    faces: np.ndarray

    def __post_init__(self) -> None:
        if self.lateral_count.max(initial=0) > 2:
            at = int(np.argmax(self.lateral_count[self.lateral_of_side.ravel()] > 2))
            ends = np.stack([self.quads, np.roll(self.quads, -1, axis=1)], axis=-1).reshape(-1, 2)[at]
            raise CrossingError(ends)

    @cached_property
    def quads(self) -> np.ndarray:
        """Nodes of each face, counter-clockwise from outside, (k, 4) int32."""
        return self.mesh.hexes[self.faces[:, :1], FACES[self.faces[:, 1]]]

    @cached_property
    def is_padded(self) -> np.ndarray:
        """True for the sides of hexes that are faces of the sheet, (m, 6) bool."""
        return self.face_number >= 0

    @cached_property
    def face_number(self) -> np.ndarray:
        """Number of the face of the sheet at each side of a hex, -1 for none, (m, 6) int64."""
        numbers = np.full((self.mesh.n_hexes, 6), -1)
        numbers[self.faces[:, 0], self.faces[:, 1]] = np.arange(len(self.faces))
        return numbers

    @cached_property
    def copy_of_corner(self) -> np.ndarray:
        """Number of the copy that each corner of a hex uses, from 0, -1 for none, (m, 8) int64.

        A node at which hexes touch without a common face has a copy for each group of hexes connected by faces.
        """
        mesh, n = self.mesh, self.mesh.n_nodes
        rows = np.flatnonzero(self.region & mask(self.quads, n)[mesh.hexes].any(axis=1))
        place = np.full(mesh.n_hexes, -1)
        place[rows] = np.arange(rows.size)
        across = mesh.topology.hex_neighbours[rows]
        inside = (across >= 0) & ~self.is_padded[rows] & (place[across] >= 0)
        one, face = np.nonzero(inside & (rows[:, None] < across))
        other = place[across[one, face]]
        links = []
        for corner in FACES[face].T:
            nodes = mesh.hexes[rows[one], corner]
            links.append(np.stack([8 * one + corner, 8 * other + _corner(mesh.hexes[rows[other]], nodes)], axis=1))
        groups = components(8 * rows.size, np.concatenate(links)).reshape(-1, 8)
        own = groups[place[self.faces[:, :1]], FACES[self.faces[:, 1]]]
        numbers = np.full(int(groups.max(initial=-1)) + 1, -1)
        used = np.unique(own)
        numbers[used] = np.arange(used.size)
        answer = np.full((mesh.n_hexes, 8), -1)
        answer[rows] = numbers[groups]
        return answer

    @cached_property
    def originals(self) -> np.ndarray:
        """Original node of each copy, (c,) int64."""
        answer = np.empty(int(self.copy_of_corner.max(initial=-1)) + 1, dtype=np.int64)
        hexes, corners = np.nonzero(self.copy_of_corner >= 0)
        answer[self.copy_of_corner[hexes, corners]] = self.mesh.hexes[hexes, corners]
        return answer

    @cached_property
    def inner_hexes(self) -> np.ndarray:
        """Hexes of the mesh with the copies of their nodes, (m, 8) int32."""
        copies = self.copy_of_corner
        return np.where(copies >= 0, self.mesh.n_nodes + copies, self.mesh.hexes).astype(np.int32)

    @cached_property
    def new_hexes(self) -> np.ndarray:
        """The hex under each face, (k, 8) int32: its side `OUTER` is the face, its side `INNER` has the copies."""
        inner = self.inner_hexes[self.faces[:, :1], FACES[self.faces[:, 1]]]
        return np.concatenate([inner, self.quads], axis=1).astype(np.int32)

    @cached_property
    def _laterals(self) -> tuple[np.ndarray, np.ndarray]:
        """Lateral face of each side of a new hex, (k, 4), and number of new hexes at each lateral face."""
        inner, outer = self.new_hexes[:, :4], self.new_hexes[:, 4:]
        ends = np.stack([outer, np.roll(outer, -1, axis=1), inner, np.roll(inner, -1, axis=1)], axis=-1)
        keys = np.sort(ends.reshape(-1, 4), axis=1)
        _, which, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
        return which.reshape(-1, 4), count

    @property
    def lateral_of_side(self) -> np.ndarray:
        """Number of the lateral face over each side of a face, from corner i to corner i + 1, (k, 4) int64."""
        return self._laterals[0]

    @property
    def lateral_count(self) -> np.ndarray:
        """Number of new hexes at each lateral face: 2, or 1 at the rim of the sheet."""
        return self._laterals[1]

    @cached_property
    def rim(self) -> np.ndarray:
        """Sides of faces at which the sheet ends, (r, 2) int64: the face, and the side from corner i to i + 1."""
        return np.argwhere(self.lateral_count[self.lateral_of_side] == 1)

    @cached_property
    def edges(self) -> np.ndarray:
        """Ends of the edges of the inner faces, (e, 2) int64, lower copy first, each once."""
        inner = self.new_hexes[:, :4].astype(np.int64) - self.mesh.n_nodes
        return np.unique(np.sort(np.stack([inner, np.roll(inner, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1), axis=0)


def _corner(hexes: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """Corner of each hex (k, 8) at a node (k,), (k,) int64."""
    return (hexes == nodes[:, None]).argmax(axis=1)
