"""Base of the local methods that move one node at a time: Algorithm 3.2.

Newton's method, with the Hessian as it is and made positive definite: Algorithm 3.2 with A.3, A.4 and A.5.

Local optimisation by steepest descent: Algorithm 3.2 with A.2 and A.5.

Base of the local optimisers: the energy of a patch, and the line search on it.

Local optimisation of several nodes at a time: Algorithm 3.2 between its two extremes, 5.2.5.

Patches of several free nodes that are smoothed together.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.energy import POLICIES, DeltaPolicy, MeshEnergy
from hexmend.energy.quads import SurfaceQuads
from hexmend.energy.target import hex_sizes, target_matrices
from hexmend.iteration import Step
from hexmend.kernels import local
from hexmend.kernels import patches as kernels
from hexmend.kernels.target import TargetMatrices
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import CSR
from hexmend.optimise.constrained_sweeps import ConstrainedSweeps, newton_steps, steepest_descents
from hexmend.parameters import Parameter, parameter
from hexmend.quality import measure
from hexmend.smoothers.base import Steps, Sweep, method
from hexmend.smoothers.base_optimiser import Optimiser
from hexmend.smoothers.sliding_smoother import Sweeps
from hexmend.smoothers.visit_order import ORDERS, VisitOrder

#: Units of delta in mean edge lengths: a patch of eight hexes is two wide.
DELTA_UNITS = {"edge": 1.0, "extent": 2.0}


@dataclass(frozen=True)
class LocalOptimiser(Optimiser):
    """Steps with line search on the energy of one patch after another, each scaled to unit mean edge length."""

    #: Search direction of a node.
    direction: ClassVar[local.Direction] = local.Direction.NEWTON

    delta_unit: str = parameter(
        "edge",
        choices=tuple(DELTA_UNITS),
        help="Unit of length for delta: the patch's mean edge length, or its extent of two edges (Table 4.4).",
        advanced=True,
    )

    @property
    def repeats(self) -> int:
        """Number of steps at a node before the next."""
        return 1

    def constrained_sweep(self, mesh: Mesh, linear: np.ndarray) -> Sweep:
        energy = MeshEnergy(mesh, self.norm)
        sweeps = ConstrainedSweeps(energy, linear)
        find = steepest_descents if self.direction == local.Direction.STEEPEST_DESCENT else newton_steps

        def sweep(points: np.ndarray) -> np.ndarray:
            x = energy.to_edge_units(points)
            sweeps(x, self.delta_at(mesh, points), find, self.line_search, self.repeats)
            return np.where(linear[:, None], x * energy.unit, points)

        return sweep

    def delta_at(self, mesh: Mesh, points: np.ndarray) -> float:
        """delta of a sweep that begins with the nodes at points (n, 3): zero in the feasible region, 3.2.4."""
        return self.policy.at(measure(points, mesh.elements), hex_sizes(mesh))

    @property
    def policy(self) -> DeltaPolicy:
        """Policy of delta, in mean edge lengths."""
        return POLICIES[self.delta_policy](self.delta * DELTA_UNITS[self.delta_unit] ** 3)

    def surface_arguments(
        self, sliding: SlidingBoundary | None, quads: SurfaceQuads | None, points: np.ndarray, delta: float
    ) -> Callable[[np.ndarray], tuple]:
        """Make a function that returns the arguments of `local.sweep` about the surface, for a sweep from some points.

        Parameters
        ----------
        sliding : SlidingBoundary or None
        quads : SurfaceQuads or None
            If they count.
        points : (n, 3) float64
            At which their normals are held.
        delta : float
            Of the hexes.

        Returns
        -------
        callable
            Maps the points (n, 3) that are to be swept to the arguments.
        """
        if sliding is None:
            return lambda moved: ()
        term = None if quads is None else quads.at(points, delta, self.policy).of_kernels(quads.unit)
        return lambda moved: (sliding.sliding_surface, sliding.tangents(moved), term)


@dataclass(frozen=True)
class LocalDescent(LocalOptimiser):
    """Steps with line search at each free node in turn, on the node's patch scaled to unit mean edge length."""

    bytes_per_hex = 400

    order: str = parameter(
        "colour",
        choices=tuple(ORDERS),
        help="Order of the nodes in a sweep (5.2.6): inward is level by level from the fixed nodes.",
    )
    steps_per_node: int = parameter(
        1,
        low=1,
        high=100,
        help="Steps at a node before the next: more than one did not pay in the thesis (3.2.2). Sliding nodes keep "
        "their tangents meanwhile.",
        advanced=True,
    )

    def steps(self, mesh: Mesh) -> Steps:
        sliding = self.sliding(mesh)
        mesh = mesh if sliding is None else sliding.mesh
        corners, visits = mesh.topology.node_corners, VisitOrder(mesh, self.order, self.steps_per_node)
        # Each visit asks the hexes at its node.
        derivatives = self.steps_per_node * int(np.diff(corners.start)[mesh.free].sum())
        points, number, sweeps = mesh.points, 0, Sweeps(sliding, mesh.n_nodes)
        target, quads = target_matrices(mesh), self.surface_quads(sliding)

        def sweep(moved: np.ndarray, stays: np.ndarray) -> int:
            visited, settings = groups.without(stays), self.step_settings(delta, target)
            return local.sweep(moved, mesh.topology.hex_mesh, visited.start, visited.items, settings, *surface(moved))

        visits.groups(points, number)
        yield Step(points, surface=quads and quads.objective(points))
        while True:
            delta, groups = self.delta_at(mesh, points), visits.groups(points, number)
            surface = self.surface_arguments(sliding, quads, points, delta)
            points, energies = sweeps(points, sweep)
            counts = {"energy_evaluations": energies, "derivative_evaluations": derivatives}
            yield Step(points, {"delta": delta, **counts}, surface=quads and quads.objective(points))
            number += 1

    @property
    def repeats(self) -> int:
        return self.steps_per_node

    def step_settings(self, delta: float, target: TargetMatrices | None = None) -> local.NodeStepSettings:
        """Settings of a node's step in a sweep with that delta and the target of the mesh."""
        return local.NodeStepSettings(self.direction, delta, self.norm, self.line_search, target)


@method
class LocalModifiedNewton(LocalDescent):
    """Node after node by Newton's direction, the 3 x 3 Hessian made positive definite."""

    name = "local-mnr"
    title = "Local modified Newton"
    help = "Like local Newton-Raphson, with small or negative eigenvalues of the 3 x 3 Hessian raised."
    source = "Wilson 3.2, Algorithms 3.2, A.4 and A.5"
    direction = local.Direction.MODIFIED_NEWTON


@method
class LocalNewtonRaphson(LocalDescent):
    """Node after node by Newton's direction for its patch's energy."""

    name = "local-nr"
    title = "Local Newton-Raphson"
    help = "Moves node after node by a Newton step for its patch's energy. Accurate and robust, expensive sweeps."
    source = "Wilson 3.2, Algorithms 3.2, A.3 and A.5"
    direction = local.Direction.NEWTON


@method
class LocalSteepestDescent(LocalDescent):
    """Node after node down the gradient of its patch's energy."""

    name = "local-sd"
    title = "Local steepest descent"
    help = "Moves node after node down the gradient of its patch's energy. Smooths and untangles; reaches the optimum."
    source = "Wilson 3.2, Algorithms 3.2, A.2 and A.5"
    direction = local.Direction.STEEPEST_DESCENT


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
