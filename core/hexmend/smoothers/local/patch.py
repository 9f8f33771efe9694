"""Local optimisation of several nodes at a time: Algorithm 3.2 between its two extremes, 5.2.5.

Patches of several free nodes that are smoothed together.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.energy.target import target_matrices
from hexmend.iteration import Step
from hexmend.kernels import local
from hexmend.kernels import patches as kernels
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import CSR
from hexmend.parameters import Parameter, parameter
from hexmend.smoothers.base import Steps, method
from hexmend.smoothers.local.single_node import LocalOptimiser
from hexmend.smoothers.sliding_smoother import Sweeps

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
    colours = CSR(*kernels.colours(hex_start, chosen, mesh.n_elements))
    return Patches(CSR(node_start, nodes), CSR(hex_start, chosen), mesh.elements[chosen], slots, colours)


@method
@dataclass(frozen=True)
class LocalPatch(LocalOptimiser):
    """One Newton step per patch of connected free nodes, with the rest of the mesh fixed, sweep after sweep.

    Nodes that slide belong to no patch: after each sweep they step one by one.
    """

    name = "local-patch"
    title = "Local Newton, large patches"
    help = "Moves patches of connected nodes, each by its own Newton step. Few, but expensive sweeps."
    source = "Wilson 5.2.5, Algorithms 3.2, A.3 and A.5"
    bytes_per_hex = 1700

    patch: int = parameter(
        8, low=1, high=1000, unit="nodes", help="Number of connected free nodes in a patch: 1, 8, 27, 64, 216..."
    )
    overlap: int = parameter(
        1, low=0, high=1, unit="rings", help="Rings of nodes of other patches that move with a patch."
    )

    def steps(self, mesh: Mesh) -> Steps:
        sliding, patches = self.sliding(mesh), partition_patches(mesh, self.patch, self.overlap)
        if sliding is not None:
            alone = mesh.topology.colouring(~sliding.mesh.fixed & mesh.fixed)
            derived = int(np.diff(mesh.topology.node_corners.start)[sliding.nodes].sum())
            mesh = sliding.mesh
        points, sweeps, search = mesh.points, Sweeps(sliding, mesh.n_nodes), self.line_search
        partition, colours = patches.kernel_partition, patches.colours
        target, of_patches = target_matrices(mesh), target_matrices(mesh, which=patches.chosen.items)

        def slide(moved: np.ndarray, stays: np.ndarray) -> int:
            groups = alone.without(stays)
            settings = local.NodeStepSettings(local.Direction.NEWTON, delta, self.norm, search, target)
            return local.sweep(moved, mesh.topology.hex_mesh, groups.start, groups.items, settings, *surface(moved))

        quads = self.surface_quads(sliding)
        yield Step(points, surface=quads and quads.objective(points))
        while True:
            delta = self.delta_at(mesh, points)
            points = points.copy()
            settings = local.NodeStepSettings(local.Direction.NEWTON, delta, self.norm, search, of_patches)
            energies, derivatives = kernels.sweep(points, partition, colours.start, colours.items, settings)
            if sliding is not None:
                surface = self.surface_arguments(sliding, quads, points, delta)
                points, more = sweeps(points, slide)
                energies, derivatives = energies + more, derivatives + derived
            counts = {"energy_evaluations": energies, "derivative_evaluations": derivatives}
            yield Step(points, {"delta": delta, **counts}, surface=quads and quads.objective(points))
