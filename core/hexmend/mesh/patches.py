"""Patches of several free nodes that are smoothed together (thesis 5.2.5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.kernels import patches as kernels
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import CSR
from hexmend.parameters import Parameter

_SIZES = tuple(Parameter(name, int, 1, low, 2**31 - 1, None, "", "") for name, low in (("size", 1), ("overlap", 0)))


@dataclass(frozen=True, eq=False)
class Patches:
    """Connected groups of free nodes with their hexes, coloured for parallel sweeps.

    Parameters
    ----------
    nodes : CSR
        Nodes of each patch, ascending. Every free node is in one patch; with overlap in several.
    chosen : CSR
        Numbers of the hexes at the nodes of each patch.
    hexes : (t, 8) int32
        Corners of those hexes, one patch after another.
    slots : (t, 8) int32
        Index of each corner among the patch's nodes; -1 if it is fixed.
    colours : CSR
        Patches of each colour; two of one colour share no hex.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> patches = partition_patches(make("cube", size=125), size=8, overlap=0)
    >>> len(patches.nodes), patches.nodes[0].size
    (8, 8)
    """

    nodes: CSR
    chosen: CSR
    hexes: np.ndarray
    slots: np.ndarray
    colours: CSR

    @property
    def kernel_partition(self) -> kernels.PatchPartition:
        """The patches as `hexmend.kernels.patches.sweep` takes them; a view, cheap to make."""
        return kernels.PatchPartition(self.hexes, self.slots, self.chosen.start, self.nodes.start, self.nodes.items)


def partition_patches(mesh: Mesh, size: int, overlap: int) -> Patches:
    """Divide the free nodes of a mesh into patches.

    Parameters
    ----------
    mesh : Mesh
    size : int
        Number of nodes of a patch, collected breadth first through hexes from the lowest remaining node; fewer where
        no more are connected.
    overlap : int
        Number of rings of free nodes around these that the patch moves as well.

    Returns
    -------
    Patches

    Raises
    ------
    ParameterError
        For a size or overlap out of range.
    """
    size, overlap = (one.check(value) for one, value in zip(_SIZES, (size, overlap), strict=True))
    node_start, nodes, hex_start, chosen, slots = kernels.partition(mesh.topology.hex_mesh, mesh.free, size, overlap)
    colours = CSR(*kernels.colours(hex_start, chosen, mesh.n_hexes))
    return Patches(CSR(node_start, nodes), CSR(hex_start, chosen), mesh.hexes[chosen], slots, colours)
