"""A node's patch, ready to be asked: what `hexmend.numba_kernels.local.sweep` works out of it, one thing at a time."""

from __future__ import annotations

import numpy as np

from hexmend.numba_kernels import local, patch, serial
from hexmend.mesh import Mesh
from hexmend.node_step.record import Trial
from hexmend.quality.measure import read_only

#: Places at which a curve is drawn, and how far it reaches: so many times the step that was accepted, or a little more
#: than the first trial.
PLACES, FAR, MORE = 96, 6.0, 1.05


class Patch:
    """The energy of one free node.

    Parameters
    ----------
    mesh : Mesh
    points : (n, 3) float64
        Of all nodes.
    node : int
    p, delta : float
    unit : float, optional
        The length that is taken for 1; without it, the mean edge length of the patch.

    Attributes
    ----------
    hexes : (k,) int32
    unit : float
        0 where the patch has no extent.
    energy : float
    gradient, hessian : (3,), (3, 3) float64
    """

    def __init__(self, mesh: Mesh, points: np.ndarray, node: int, p: float, delta: float, unit: float | None = None):
        rows = mesh.topology.node_corners
        begin, self._size = int(rows.start[node]), int(rows.start[node + 1] - rows.start[node])
        self.hexes = rows[node] // 8
        self.p, self.delta = float(p), float(delta)
        self._table = np.empty(patch.TABLE * patch.blocks_of(self._size))
        self._factor, self.energy, *rest = _look(
            read_only(points), mesh.hexes, rows.items, begin, self._size, 1 / unit if unit else 0.0, self.delta, self.p,
            self._table,
        )  # fmt: skip
        self.unit = 1 / self._factor if self._factor else 0.0
        self.gradient = np.array(rest[:3])
        xx, xy, xz, yy, yz, zz = rest[3:]
        self.hessian = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])

    def search(
        self, direction: int, first: float, shrink: float, c1: float, cuts: int
    ) -> tuple[np.ndarray, float, bool, float, tuple[Trial, ...]]:
        """The search direction, in `unit`, its slope, whether it fell back to steepest descent; alpha; its trials."""
        h = self.hessian
        rows = np.empty((cuts + 1, 3))
        dx, dy, dz, slope, fallback, alpha, count = _search(
            self._table, self._size, self.energy, *self.gradient, *h[0], *h[1, 1:], h[2, 2],
            direction, self.delta, self.p, first, shrink, c1, cuts, rows,
        )  # fmt: skip
        trials = tuple(Trial(*row) for row in rows[:count].tolist())
        return np.array([dx, dy, dz]), float(slope), bool(fallback), float(alpha), trials

    def moved(self, before: np.ndarray, direction: np.ndarray, alpha: float) -> np.ndarray:
        """Where alpha of a direction, in `unit`, leads from `before`, (3,) in the mesh's unit."""
        return before + alpha * direction / self._factor

    def curve(self, direction: np.ndarray, reach: float) -> np.ndarray:
        """The energy along a direction, in `unit`, from alpha = 0 to `reach`: alpha, energy, (PLACES, 2)."""
        answer = np.empty((PLACES, 2))
        answer[:, 0] = np.linspace(0, reach, PLACES)
        _along(self._table, self._size, *direction, self.delta, self.p, answer)
        return answer

    def value(self, direction: np.ndarray, alpha: float) -> float:
        """The energy at alpha of a direction, in `unit`."""
        answer = np.array([[alpha, 0.0]])
        _along(self._table, self._size, *direction, self.delta, self.p, answer)
        return float(answer[0, 1])


def reach_of(first: float, alpha: float) -> float:
    """How far the curve is drawn beside a line search that accepted `alpha`."""
    return MORE * (min(first, FAR * alpha) if alpha > 0 else first)


@serial
def _look(points, hexes, corners, begin, size, factor, delta, p, table):
    """What a visit of `local.sweep` begins with; with a factor, lengths are multiplied by that instead of its own.

    Returns the factor, value, gradient and Hessian.
    """
    patch.load(points, hexes, corners, begin, size, table)
    if factor == 0:
        factor = patch.rescale(table, size)
    else:
        for block in range(patch.blocks_of(size)):
            for i in range(3 * 8 * patch.HEXES):
                table[block * patch.TABLE + i] *= factor
    patch.tabulate(table, size, delta)
    f, gx, gy, gz = patch.value_and_gradient(table, size, delta, p)
    xx, xy, xz, yy, yz, zz = patch.hessian(table, size, p)
    return factor, f, gx, gy, gz, xx, xy, xz, yy, yz, zz


@serial
def _search(table, size, f, gx, gy, gz, xx, xy, xz, yy, yz, zz, direction, delta, p, first, shrink, c1, cuts, trials):
    """The direction and the line search of a visit of `local.sweep`; writes alpha, energy and bound of each trial."""
    dx, dy, dz = 0.0, 0.0, 0.0
    if direction != local.STEEPEST_DESCENT:
        dx, dy, dz = local.newton((xx, xy, xz, yy, yz, zz), gx, gy, gz, direction == local.MODIFIED_NEWTON)
    slope = gx * dx + gy * dy + gz * dz
    steepest = not slope < 0
    if steepest:
        dx, dy, dz = local.steepest_descent(f, gx, gy, gz, p)
        slope = gx * dx + gy * dy + gz * dz
    alpha = local.back_line_search(table, size, delta, p, f, slope, dx, dy, dz, first, shrink, c1, cuts)
    at, count = first, 0
    while count <= cuts:
        trials[count, 0] = at
        trials[count, 1] = patch.value(table, size, at * dx, at * dy, at * dz, delta, p)
        trials[count, 2] = f + c1 * at * slope
        count += 1
        if at == alpha:
            break
        at *= shrink
    return dx, dy, dz, slope, steepest and direction != local.STEEPEST_DESCENT, alpha, count


@serial
def _along(table, size, dx, dy, dz, delta, p, curve):
    for k in range(len(curve)):
        alpha = curve[k, 0]
        curve[k, 1] = patch.value(table, size, alpha * dx, alpha * dy, alpha * dz, delta, p)
