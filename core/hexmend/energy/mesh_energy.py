"""The energy of a whole mesh as a function of its free nodes: value, gradient, Hessian."""

from __future__ import annotations

import copy
import threading
from functools import cached_property

import numpy as np

from hexmend.aliases import reads_old_names
from hexmend.arrays import dot
from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.hex_energy import corners_left_out, energies
from hexmend.energy.linear_operator import SymmetricOperator
from hexmend.energy.norm import SQUARES, ObjectiveNorm
from hexmend.energy.sparsity import BlockSparsity
from hexmend.kernels import assembly, step_limits, threads
from hexmend.kernels import objective as kernels
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import points_like


@reads_old_names
class MeshEnergy:
    """Sum over all hexes of eta(H)^p, which has the minimisers of (3.3).

    Lengths are in mean edge lengths of the mesh as given, so that delta means the same on every mesh.

    Parameters
    ----------
    mesh : Mesh
    power : ObjectiveNorm
        p and offset.
    left_out : (m,) uint8, optional
        Bit t set: corner tetrahedron t of the hex is left out, as if it were perfect.

    Attributes
    ----------
    unit : float
        Mean edge length of the mesh.
    nodes : (k,) int32
        The free nodes; row i of a gradient is that of node nodes[i].

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = make("cube", size=27)
    >>> energy = MeshEnergy(mesh)
    >>> x = energy.to_edge_units(mesh.points)
    >>> round(energy.value(x), 12), energy.gradient(x).shape
    (0.0, (8, 3))
    """

    #: Whether it has bends, those of a surface of triangles, at which Newton's method is slow.
    faceted = False

    def __init__(self, mesh: Mesh, power: ObjectiveNorm = SQUARES, left_out: np.ndarray | None = None):
        self.mesh = mesh
        self.power = power
        self.left_out = corners_left_out(left_out, mesh.n_hexes)
        self.unit = mesh.mean_edge_length or 1.0
        self.nodes = np.flatnonzero(mesh.free).astype(np.int32)
        self._scratch = threading.local()

    @cached_property
    def slots(self) -> np.ndarray:
        """Number of each corner among the free nodes, -1 if it is fixed, (m, 8) int32."""
        slot = np.full(self.mesh.n_nodes, -1, np.int32)
        slot[self.nodes] = np.arange(self.nodes.size, dtype=np.int32)
        return slot[self.mesh.hexes]

    @cached_property
    def couplings(self) -> BlockSparsity:
        """Which free nodes share a hex."""
        return BlockSparsity(self.mesh)

    @property
    def least(self) -> float:
        """What `value` is where all hexes are cubes and delta is zero."""
        return self.power.least * self.mesh.n_hexes

    def with_objective(self, power: ObjectiveNorm, left_out: np.ndarray) -> MeshEnergy:
        """The energy with another power and other corners left out; what depends on the mesh alone is shared.

        Both may be used by several threads at once.

        Parameters
        ----------
        power : ObjectiveNorm
        left_out : (m,) uint8
            As of `MeshEnergy`.
        """
        other = copy.copy(self)
        other.power, other.left_out = power, corners_left_out(left_out, self.mesh.n_hexes)
        return other

    def to_edge_units(self, points: np.ndarray) -> np.ndarray:
        """Points in mean edge lengths, (n, 3)."""
        return self._places(points) / self.unit

    def to_mesh_units(self, x: np.ndarray) -> np.ndarray:
        """Points in the mesh's own unit of length, (n, 3); fixed nodes to the last bit where they were."""
        points = self.mesh.points.copy()
        np.multiply(self._places(x), self.unit, out=points, where=self.mesh.free[:, None])
        return points

    def moved(self, x: np.ndarray, step: np.ndarray, alpha: float = 1.0) -> np.ndarray:
        """x (n, 3) with its free nodes displaced by alpha times step (k, 3)."""
        x, there = self._places(x), np.empty(x.shape)
        step_limits.displaced(x, self.nodes, points_like(step, (self.nodes.size, 3), "steps"), alpha, there)
        return there

    def value(self, x: np.ndarray, delta: float = 0.0) -> float:
        """Sum of eta(H)^p at points x (n, 3); +inf at delta = 0 while any hex is inverted."""
        p, offset = self.power
        eta = energies(self._places(x), self.mesh.hexes, delta, self.left_out, offset)
        with np.errstate(over="ignore"):  # beside the barrier, and with a node far away: then it is infinite, too
            return float((np.square(eta) if p == 2 else np.power(eta, p)).sum())

    def gradient(self, x: np.ndarray, delta: float = 0.0) -> np.ndarray:
        """Derivative of `value` by the free nodes, (k, 3): (B.3), (B.21), (C.2)."""
        kernels.gradient(self._places(x), self.mesh.hexes, delta, self.power, self.left_out, self._shares)
        return self._gathered()

    def hessian(self, x: np.ndarray, delta: float = 0.0) -> Hessian:
        """Second derivative of `value` by the free nodes, at points x (n, 3)."""
        return Hessian(self, x, delta)

    def directional_derivative(self, x: np.ndarray, delta: float, step: np.ndarray, gradient: np.ndarray) -> float:
        """The slope of `value` along a step (k, 3) of the free nodes, `gradient` (k, 3) being its derivative at x."""
        return dot(step, gradient)

    def infeasible_nodes(self, x: np.ndarray, there: np.ndarray) -> np.ndarray | None:
        """Which nodes may not go from x (n, 3) to `there`, whatever their energy, (n,) bool; None where all may."""
        return None

    @property
    def _shares(self) -> np.ndarray:
        """Scratch for what each hex contributes at its corners, (m, 8, 3): each thread has its own."""
        if not hasattr(self._scratch, "shares"):
            self._scratch.shares = np.empty((self.mesh.n_hexes, 8, 3))
        return self._scratch.shares

    def _places(self, x: np.ndarray) -> np.ndarray:
        """Places of all nodes, (n, 3) float64; `MeshError` for an array of another shape or type."""
        return points_like(x, self.mesh.points.shape, "places of nodes")

    def _gathered(self) -> np.ndarray:
        """What the shares of the hexes come to at each free node, (k, 3)."""
        corners = self.mesh.topology.node_corners
        rows = np.empty((self.nodes.size, 3))
        kernels.gather(self._shares.reshape(-1, 3), corners.start, corners.items, self.nodes, rows)
        return rows


class Hessian(SymmetricOperator):
    """Hessian of a `MeshEnergy` at one place, (3 k, 3 k).

    Unknowns are x, y, z of the first free node, then of the second... `shift` is added to the diagonal.
    """

    def __init__(self, energy: MeshEnergy, x: np.ndarray, delta: float, shift: float = 0.0):
        super().__init__(3 * energy.nodes.size)
        self.energy, self.x, self.delta, self.shift = energy, energy._places(x), float(delta), float(shift)

    def shifted(self, shift: float) -> Hessian:
        """H + shift I."""
        return Hessian(self.energy, self.x, self.delta, self.shift + shift)

    def _product(self, v: np.ndarray) -> np.ndarray:
        energy, v = self.energy, v.reshape(-1, 3)
        kernels.hessian_product(
            self.x,
            energy.mesh.hexes,
            energy.slots,
            v,
            self.delta,
            energy.power,
            energy.left_out,
            energy._shares,
        )
        product = energy._gathered()
        if self.shift:
            product += self.shift * v
        return product.ravel()

    def assembled(self, dtype: type = np.float32, room: AssembledHessian | None = None) -> AssembledHessian:
        """The same matrix, assembled: many products, and a system to be solved.

        Parameters
        ----------
        dtype : numpy.float32 or numpy.float64
            Of the blocks. Where single precision cannot hold numbers so small (near the optimum of a high p), the
            matrix is assembled in double precision and scaled before it is rounded.
        room : AssembledHessian, optional
            Another matrix that is not needed any more: this one takes its place if its pattern and precision are the
            same. Memory that has been touched before is faster.
        """
        couplings = self.energy.couplings
        fits = room is not None and room.couplings is couplings and room.off.dtype == dtype
        matrix = room.reset() if fits else AssembledHessian.zero(couplings, dtype)
        self._assemble(matrix)
        if dtype == np.float32 and matrix.underflows():
            wide = AssembledHessian.zero(couplings, np.float64)
            self._assemble(wide)
            return wide.normalised(dtype)
        return matrix

    def _assemble(self, matrix: AssembledHessian) -> None:
        """Add this Hessian to a matrix of zeros."""
        energy, shares = self.energy, self.energy.couplings.shares(threads())
        assembly.assemble(self.x, self.delta, energy.power, energy.left_out, *shares, matrix.off, matrix.diagonal)
        matrix.diagonal += self.shift * np.array([1, 0, 0, 1, 0, 1], matrix.diagonal.dtype)
