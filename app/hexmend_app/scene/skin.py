"""The skin: the faces through which a mesh, or what is left of it, can be seen from outside."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.hexahedron import FACES
from hexmend.kernels import serial
from hexmend.mesh import Mesh


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
    """

    nodes: np.ndarray
    quads: np.ndarray
    hexes: np.ndarray


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
