"""The skin: the faces through which a mesh, or what is left of it, can be seen from outside."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.hexahedron import FACES
from hexmend.numba_kernels import serial
from hexmend.mesh import Mesh

#: Elements up to which all are drawn where they are shrunk; of more, those in sight. So many take 50 ms a frame without
#: a graphics card.
WHOLE = 4_000

_NONE = np.empty((0, 6), np.int32)


@dataclass(frozen=True, eq=False)
class Faces:
    """Visible quads.

    Parameters
    ----------
    nodes : (u,) int32
        The mesh's nodes that the quads use.
    quads : (k, 4) int32
        Places in `nodes`, counter-clockwise from outside.
    hexes : (k,) int32
        The hex that each quad belongs to.
    shrink : float
        Where it is not 0, the nodes are those of whole hexes, eight by eight, and drawn that much nearer to their mean.
    many : bool
        Whether they are so many shrunk ones that sides are left out while something moves.
    """

    nodes: np.ndarray
    quads: np.ndarray
    hexes: np.ndarray
    shrink: float = 0.0
    many: bool = False

    def places(self, points: np.ndarray) -> np.ndarray:
        """Where the nodes are drawn, (u, 3), of a mesh whose nodes are at (n, 3) float64 `points`."""
        return _shrunk(points, self.nodes, self.shrink) if self.shrink else points[self.nodes]


class Skin:
    """Finds the visible faces of a mesh whatever is hidden of it, from the table of face neighbours made once.

    Parameters
    ----------
    mesh : Mesh
    """

    def __init__(self, mesh: Mesh):
        self._hexes = mesh.hexes
        self._neighbours = mesh.topology.face_neighbours
        self._all = np.ones(mesh.n_hexes, dtype=bool)
        self._place = np.empty(mesh.n_nodes, dtype=np.int32)

    def visible(self, keep: np.ndarray | None = None) -> Faces:
        """Faces of kept hexes that have no kept hex behind them.

        Parameters
        ----------
        keep : (m,) bool, optional
            None keeps all.
        """
        return Faces(*_visible(self._hexes, self._neighbours, self._all if keep is None else keep, self._place))

    def shrunk(self, shrink: float, keep: np.ndarray | None = None, fine: bool = True) -> Faces:
        """All six faces of kept hexes; of more than `WHOLE`, of those that have a visible face, and not `fine` that."""
        keep = self._all if keep is None else keep
        if np.count_nonzero(keep) <= WHOLE:
            return Faces(*_faces_of(self._hexes, np.flatnonzero(keep), _NONE, keep), shrink)
        chosen = np.flatnonzero(_outer(self._neighbours, keep))
        return Faces(*_faces_of(self._hexes, chosen, _NONE if fine else self._neighbours, keep), shrink, True)


@serial
def _outer(neighbours, keep):
    """Kept hexes with a face that no kept hex is behind, (m,) bool."""
    answer = np.zeros(keep.size, np.bool_)
    for h in range(keep.size):
        if keep[h]:
            for f in range(6):
                other = neighbours[h, f]
                if other < 0 or not keep[other]:
                    answer[h] = True
    return answer


@serial
def _faces_of(hexes, chosen, neighbours, keep):
    """Faces of chosen hexes with nodes of their own; of none that a kept hex is behind where `neighbours` are given."""
    nodes = np.empty(8 * chosen.size, np.int32)
    quads = np.empty((6 * chosen.size, 4), np.int32)
    owners = np.empty(6 * chosen.size, np.int32)
    row = 0
    for at in range(chosen.size):
        h = chosen[at]
        for c in range(8):
            nodes[8 * at + c] = hexes[h, c]
        for f in range(6):
            if neighbours.size and neighbours[h, f] >= 0 and keep[neighbours[h, f]]:
                continue
            for k in range(4):
                quads[row, k] = 8 * at + FACES[f, k]
            owners[row] = h
            row += 1
    return nodes, quads[:row].copy(), owners[:row].copy()


@serial
def _shrunk(points, nodes, shrink):
    answer = np.empty((nodes.size, 3))
    for first in range(0, nodes.size, 8):
        for x in range(3):
            mean = 0.0
            for c in range(8):
                mean += points[nodes[first + c], x]
            for c in range(8):
                answer[first + c, x] = shrink * (mean / 8) + (1 - shrink) * points[nodes[first + c], x]
    return answer


@serial
def _visible(hexes, neighbours, keep, place):
    count = 0
    for h in range(hexes.shape[0]):
        if keep[h]:
            for f in range(6):
                other = neighbours[h, f]
                count += other < 0 or not keep[other]
    quads = np.empty((count, 4), np.int32)
    owners = np.empty(count, np.int32)
    nodes = np.empty(min(4 * count, place.size), np.int32)
    place[:] = -1
    row, used = 0, 0
    for h in range(hexes.shape[0]):
        if keep[h]:
            for f in range(6):
                other = neighbours[h, f]
                if other < 0 or not keep[other]:
                    for k in range(4):
                        i = hexes[h, FACES[f, k]]
                        if place[i] < 0:
                            place[i] = used
                            nodes[used] = i
                            used += 1
                        quads[row, k] = place[i]
                    owners[row] = h
                    row += 1
    return nodes[:used].copy(), quads, owners
