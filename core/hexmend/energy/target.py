"""Target of the elements of a mesh as energies use it: its scale, and the lengths that follow from it."""

from __future__ import annotations

import copy
from dataclasses import replace
from functools import cached_property
from typing import Self

import numpy as np

from hexmend.arrays import row_norms
from hexmend.energy.ranks import Ranks
from hexmend.kernels.target import TargetMatrices
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import has_node, rows_by_kind

#: Longest over shortest target length of a hex up to which single precision is enough for the Hessian: the terms of its
#: directions differ by the square.
_MAX_SINGLE_ASPECT = 30.0

#: Least size of a hex that counts, in mean edge lengths: edges may have no length.
_MIN_SIZE = 1e-9


def wanted_lengths(mesh: Mesh) -> np.ndarray | None:
    """Lengths of the target matrices of a mesh's energy, (m, 3) in its unit of length; None without a target.

    They are those of the target if the size counts. If the shape alone counts, their scale is free, and each hex gets
    that of its own edges: sigma of S W^-1 is then close to 1 for hexes of any size, so that delta regularises the
    flattest layer as much as the largest hex.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    (m, 3) float64 or None
    """
    target = mesh.element_target
    if target is None or target.size_weight > 0:
        return None if target is None else target.lengths
    sizes = np.empty(mesh.n_elements)
    for kind, rows in rows_by_kind(mesh.elements):
        ends = mesh.points[mesh.elements[rows][:, kind.edges]]
        edges = row_norms(ends[:, :, 0] - ends[:, :, 1])
        # The median of the parallel edges is hardly changed by a node that is far away.
        columns = [np.sort(edges[:, kind.edge_class == of], axis=1) for of in kind.columns]
        middles = [own[:, (own.shape[1] - 1) // 2 : own.shape[1] // 2 + 1].mean(axis=1) for own in columns]
        with np.errstate(divide="ignore"):
            sizes[rows] = np.exp(np.log(np.stack(middles, axis=1)).mean(axis=1))
    sizes = np.maximum(sizes, _MIN_SIZE * (mesh.mean_edge_length or 1.0))
    return target.lengths * (sizes / np.exp(np.log(target.lengths).mean(axis=1)))[:, None]


def target_matrices(mesh: Mesh, unit: float = 1.0, which: np.ndarray | None = None) -> TargetMatrices | None:
    """Make the target of a mesh as kernels take it, from `wanted_lengths`; None without a target.

    Parameters
    ----------
    mesh : Mesh
    unit : float
        Unit of length of the points that kernels are given.
    which : (k,) int, optional
        Hexes of its rows; all by default.
    """
    lengths = wanted_lengths(mesh)
    if lengths is None:
        return None
    return TargetMatrices(unit / (lengths if which is None else lengths[which]), mesh.element_target.size_weight)


def node_sizes(mesh: Mesh) -> np.ndarray | float:
    """Lengths to which moves of nodes are relative.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    (n,) float64 or float
        The shortest length that a hex at the node is to have, at most the mean edge length, which it is without a
        target.
    """
    unit, lengths = mesh.mean_edge_length or 1.0, wanted_lengths(mesh)
    if lengths is None:
        return unit
    sizes = np.full(mesh.n_nodes, unit)
    shortest = lengths.min(axis=1)
    for corner in mesh.elements.T:
        np.minimum.at(sizes, corner, shortest)
    return sizes


class TargetScales:
    """Base of an energy: the lengths of its target, and what follows from them.

    Attributes
    ----------
    mesh : Mesh
    unit : float
        Unit of length of the energy, in that of the mesh.
    nodes : (k,) int32
        Free nodes.
    ranks : Ranks
        Among which the mesh is divided.
    target : TargetMatrices or None
        Of the mesh, in the energy's unit of length.
    """

    mesh: Mesh
    unit: float
    nodes: np.ndarray
    ranks: Ranks
    target: TargetMatrices | None
    _lengths: np.ndarray | None
    _weight: float

    def _set_target(self, mesh: Mesh) -> None:
        """Take over the target of a mesh with the same hexes."""
        self._lengths = wanted_lengths(mesh)
        self._weight = 0.0 if mesh.element_target is None else mesh.element_target.size_weight
        self.target = None if self._lengths is None else TargetMatrices(self.unit / self._lengths, self._weight)
        for name in ("hex_sizes", "node_lengths", "precision"):  # they follow from the lengths
            self.__dict__.pop(name, None)

    def without_size(self) -> Self:
        """Return the energy in which only the shape counts, with the scale of the present edges; itself if that is so.

        In tangled layers sigma may be many times the volume that is wanted, so that the size would outweigh the shape.
        """
        target = self.mesh.element_target
        if target is None or target.size_weight == 0:
            return self
        other = copy.copy(self)
        other._set_target(self.mesh.with_element_target(replace(target, size_weight=0.0)))
        return other

    @cached_property
    def hex_sizes(self) -> np.ndarray | float:
        """Lengths, in the mesh's unit, to whose cubes sigma and delta of the hexes are relative: `unit`, or (m,)."""
        return self.unit if self._lengths is None else np.cbrt(self._lengths.prod(axis=1))

    @cached_property
    def node_lengths(self) -> np.ndarray | None:
        """Lengths of the targets at the free nodes, in mean edge lengths, (k, 1); None without a target.

        Root mean squares of the inverse lengths are inverted: the shortest decide how far a node can move.
        """
        if self._lengths is None:
            return None
        squares, corners = np.square(self.unit / self._lengths).mean(axis=1), self.mesh.topology.node_corners
        nodes = has_node(self.mesh.elements)
        sums = np.bincount(self.mesh.elements[nodes], np.repeat(squares, nodes.sum(axis=1)), self.mesh.n_nodes)
        return np.sqrt(np.diff(corners.start)[self.nodes] / sums[self.nodes])[:, None]

    @cached_property
    def precision(self) -> type:
        """Precision in which the Hessian keeps its small terms: double where hexes are to be thin."""
        if self._lengths is None:
            return np.float32
        aspect = (self._lengths.max(axis=1) / self._lengths.min(axis=1)).max(initial=1.0)
        return np.float64 if self.ranks.any(aspect > _MAX_SINGLE_ASPECT) else np.float32
