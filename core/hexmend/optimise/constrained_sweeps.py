"""Sweeps over nodes with a linear motion: each independent node steps with its tied ones, by a line search of its own.

The kernels of local methods move single nodes; these sweeps are theirs for nodes that move with others, in planes and
along lines. Independent nodes of one colour share no hex, so that their steps are found at once.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from hexmend.arrays import mask
from hexmend.energy import MeshEnergy
from hexmend.energy.assembled_hessian import unpack_symmetric
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import CSR, Topology
from hexmend.optimise.floors.region import Region
from hexmend.optimise.search_direction import LEAST_EIGENVALUE

#: Function of energies (k,), gradients (k, 3), Hessians (k, 3, 3) of single nodes and p; gives their directions (k, 3).
NodeDirections: TypeAlias = Callable[[np.ndarray, np.ndarray, np.ndarray, float], np.ndarray]


def steepest_descents(values: np.ndarray, gradients: np.ndarray, hessians: np.ndarray, p: float) -> np.ndarray:
    """Algorithm A.2 for single nodes: minus the gradients of (3.3), the p-th roots of the energies."""
    return -(np.power(np.maximum(values, np.finfo(float).tiny), 1 / p - 1) / p)[:, None] * gradients


def newton_steps(values: np.ndarray, gradients: np.ndarray, hessians: np.ndarray, p: float) -> np.ndarray:
    """Algorithm A.4 for single nodes: Newton's steps with the small eigenvalues of the Hessians raised."""
    eigenvalues, vectors = np.linalg.eigh(hessians)
    least = LEAST_EIGENVALUE * np.abs(eigenvalues).max(axis=1, keepdims=True)
    least = np.maximum(least, np.finfo(float).tiny)
    along = np.einsum("kij,ki->kj", vectors, gradients) / np.maximum(eigenvalues, least)
    return -np.einsum("kij,kj->ki", vectors, along)


def colours_of_independent(mesh: Mesh, chosen: np.ndarray) -> CSR:
    """Colour the nodes that some nodes, chosen (n,) bool, follow or hang on, so that no two of a colour move one cell.

    Parameters
    ----------
    mesh : Mesh
        With a linear motion.
    chosen : (n,) bool

    Returns
    -------
    CSR
        Free nodes that lead, by colour.
    """
    motion, n = mesh.linear_motion, mesh.n_nodes
    assert motion is not None  # else nothing is followed
    moves = motion.with_coupled(chosen & mesh.free) & mesh.free & motion.leads(n)
    return Topology(motion.independent_rows(mesh.elements, n), n).colouring(moves)


class ConstrainedSweeps:
    """Sweeps over some nodes of a mesh and those tied to them, colour after colour.

    Parameters
    ----------
    energy : MeshEnergy
        Of a mesh with a linear motion.
    chosen : (n,) bool
        Nodes that move; fixed ones stay.
    """

    def __init__(self, energy: MeshEnergy, chosen: np.ndarray):
        colours = colours_of_independent(energy.mesh, chosen)
        self._parts = [_Colour(energy, colours[i]) for i in range(len(colours))]

    def __call__(
        self, x: np.ndarray, delta: float, directions: NodeDirections, search: LineSearch, repeats: int = 1
    ) -> None:
        """Sweep once.

        Parameters
        ----------
        x : (n, 3) float64
            Points in mean edge lengths; changed.
        delta : float
            In cubes of the mean edge length.
        directions : callable
            `steepest_descents` or `newton_steps`.
        search : LineSearch
        repeats : int
            Steps at a node before the next.
        """
        for part in self._parts:
            for _ in range(repeats):
                part.step(x, delta, directions, search)


class _Colour:
    """Independent nodes that share no hex, with the hexes at them and at the nodes tied to them."""

    def __init__(self, energy: MeshEnergy, nodes: np.ndarray):
        region = Region(energy, mask(nodes, energy.mesh.n_nodes))
        self._energy, self._nodes = region.energy, region.nodes
        # The one independent node at each hex, as a row of the gradient.
        own, motion = self._energy.mesh, self._energy.motion
        rows = np.full(own.n_nodes, -1)
        rows[motion.free] = np.arange(motion.free.size) if motion.row is None else motion.row
        self._row = rows[own.hexes].max(axis=1)

    def step(self, x: np.ndarray, delta: float, directions: NodeDirections, search: LineSearch) -> None:
        """Step with each node by its own line search; x (n, 3) is changed."""
        energy, here = self._energy, x[self._nodes]
        if not energy.nodes.size:
            return
        value, gradient = self._values(here, delta), energy.gradient(here, delta)
        hessian = unpack_symmetric(energy.hessian(here, delta).assembled(np.float64).diagonal_blocks)
        sound = np.isfinite(value) & np.isfinite(gradient).all(axis=1) & np.isfinite(hessian).all(axis=(1, 2))
        gradient = np.where(sound[:, None], gradient, 0.0)
        hessian = np.where(sound[:, None, None], hessian, np.eye(3))
        step = directions(np.where(sound, value, 1.0), gradient, hessian, energy.norm.p)
        slope = np.einsum("ki,ki->k", step, gradient)
        alpha = np.where(sound & (slope < 0) & np.isfinite(step).all(axis=1), search.initial_step, 0.0)
        open_, step = alpha > 0, np.where(np.isfinite(step), step, 0.0)
        for _ in range(search.max_backtracks + 1):  # A.5
            after = self._values(energy.moved(here, alpha[:, None] * step), delta)
            open_ &= ~(after <= value + search.c1 * alpha * slope)
            if not open_.any():
                break
            alpha[open_] *= search.backtrack_factor
        alpha[open_] = 0.0
        x[self._nodes] = energy.moved(here, alpha[:, None] * step)

    def _values(self, x: np.ndarray, delta: float) -> np.ndarray:
        """Energy of the hexes at each node and its tied ones, (k,) float64."""
        p, offset = self._energy.norm
        eta = self._energy.hex_energies(x, delta, offset)
        with np.errstate(over="ignore"):
            return np.bincount(self._row, np.power(eta, p), self._energy.nodes.size)
