"""Meshes that are uniform refinements of coarser ones: the coarser mesh, and interpolation from its nodes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hexmend.arrays import index_of, mask
from hexmend.kernels import structure
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.solid_cells import kinds_of
from hexmend.mesh.topology.topology import Topology

#: Place of node (x, y, z) among the 27 of a coarse hex, x, y, z in 0, 1, 2.
_STRIDES = np.array([1, 3, 9])
_CORNERS = (2 * UNIT_CUBE.astype(int)) @ _STRIDES


@dataclass(frozen=True, eq=False)
class Refinement:
    """Division of each hex of a coarse mesh into 2 x 2 x 2 hexes.

    Parameters
    ----------
    blocks : (k, 27) int32
        Nodes of the fine mesh in each coarse hex; node (x, y, z) of its 3 x 3 x 3 is in column 9 z + 3 y + x.
    n_nodes : int
        Number of nodes of the fine mesh.
    """

    blocks: np.ndarray
    n_nodes: int

    @cached_property
    def vertices(self) -> np.ndarray:
        """Fine number of each coarse node, ascending, (v,) int64."""
        return np.flatnonzero(mask(self.blocks[:, _CORNERS], self.n_nodes))

    @cached_property
    def number(self) -> np.ndarray:
        """Coarse number of each fine node, -1 for those that the coarse mesh does not have, (n,) int32."""
        return index_of(self.vertices, self.n_nodes)

    @property
    def hexes(self) -> np.ndarray:
        """Hexes of the coarse mesh in its own numbers of nodes, (k, 8) int32."""
        return self.number[self.blocks[:, _CORNERS]]

    def interpolate(self, values: np.ndarray, kept: np.ndarray) -> None:
        """Interpolate values at fine nodes, in place, from those of coarse nodes and of nodes that are kept.

        Parameters
        ----------
        values : (n, 3) float64
        kept : (n,) bool
            Nodes whose values stay; in the coarse hexes around, those of other nodes follow them.
        """
        structure.interpolate_blocks(self.blocks, kept, values)


def find_refinement(topology: Topology) -> Refinement | None:
    """Recognise a mesh each of whose components is a uniform refinement; None for other meshes.

    Where a node of the coarse mesh is known, the hexes around it tell which nodes are in the middle of coarse hexes,
    and these tell more coarse nodes. Nodes with an odd number of hexes are coarse in any case.

    Parameters
    ----------
    topology : Topology

    Returns
    -------
    Refinement or None

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> cube = make("cube", size=64)
    >>> find_refinement(cube.topology).hexes.shape
    (8, 8)
    >>> find_refinement(make("cube", size=27).topology) is None
    True
    """
    corners = topology.node_corners
    if kinds_of(topology.elements).any():
        return None
    blocks = structure.coarse_blocks(topology.elements, corners.start, corners.items)
    return Refinement(blocks, topology.n) if len(blocks) else None
