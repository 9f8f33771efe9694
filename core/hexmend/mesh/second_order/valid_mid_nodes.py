"""Positions of mid-nodes that raise the least det J of second-order hexes whose corners stay.

The Bernstein coefficients of det J, over the mean determinant at the hex's corners, have a logarithmic barrier above a
floor, which is the least coefficient of their hex, at most `_GOAL`. The barrier is minimised, the floors rise to what
was reached, and so on until hexes gain no more: the method of centres (Huard 1967). No hex falls below its floor.

Toulorge, Geuzaine, Remacle, Lambrechts: Robust untangling of curvilinear meshes, J. Comput. Phys. 254 (2013).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hexmend.arrays import mask
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.mesh.second_order import MID_NODE_WEIGHTS
from hexmend.mesh.second_order.bernstein import coefficients, completion, gradient, least_coefficients

#: Least coefficient from which on a hex gains nothing: the least acceptable scaled Jacobian of corners.
_GOAL = 0.2

#: Distance above its floor at which a coefficient's barrier begins to be a parabola, so that it is finite everywhere;
#: a smaller mean gain of the hexes below the goal ends the raising.
_MARGIN = 0.01

#: Iterations after which the floors rise: patches whose hexes can be valid need 10 to 20.
_ITERATIONS = 20

#: Hexes of a patch above which its mid-nodes are only put halfway: the others take seconds.
_LARGEST_PATCH = 500


class Patch:
    """Second-order hexes around free mid-nodes.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (k, 8) int32
    mid_nodes : (k, 19) int32
    free : (n,) bool
        Mid-nodes that are moved.

    Attributes
    ----------
    nodes : (f,) int64
        Free mid-nodes of the hexes, ascending.
    start : (f, 3) float64
        Their positions as given.
    """

    def __init__(self, points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray, free: np.ndarray):
        rows = np.concatenate([hexes, mid_nodes], axis=1)
        used, local = np.unique(rows, return_inverse=True)  # the first may be -1, whose position has no weight
        self._local, self._free = local.reshape(rows.shape), (used >= 0) & free[used]
        self._sizes = _sizes(points, hexes)
        self._unit = np.cbrt(self._sizes.mean())
        self._weights, self._points = completion(mid_nodes), points[used]
        self.nodes, self.start = used[self._free], self._points[self._free]
        # Coefficients that free nodes change: those that differ between two positions at random.
        self._points, given = np.random.default_rng(0).normal(size=self._points.shape), self._points
        one, other = self.coefficients(self.start)[0], self.coefficients(1 + self.start[::-1])[0]
        self._points, self._changes = given, np.abs(one - other) > 1e-6 * np.abs(one).max()

    def coefficients(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Compute the coefficients (k, 216) at positions x (f, 3), over the sizes of hexes, and the cofactors."""
        points = self._points.copy()
        points[self._free] = x
        values, cofactors = coefficients(self._weights @ points[self._local])
        return values / self._sizes, cofactors

    def least(self, x: np.ndarray) -> np.ndarray:
        """Compute the least coefficient of each hex that free nodes change, at most the goal, at x (f, 3), (k,)."""
        return np.where(self._changes, self.coefficients(x)[0], np.inf).min(axis=1, initial=_GOAL)

    def barrier(self, x: np.ndarray, floors: np.ndarray) -> tuple[float, np.ndarray]:
        """Compute the barrier of floors (k,) at positions x (f, 3), and its gradient (f, 3)."""
        values, cofactors = self.coefficients(x)
        low, band = floors[:, None] - _MARGIN, 2 * _GOAL - floors[:, None] + _MARGIN
        y, least = (values - low) / band, _MARGIN / band
        y = np.where(self._changes, np.minimum(y, 1), 1)
        at, below = np.maximum(y, least), np.minimum(y - least, 0)
        slope, curvature = 2 - at - 1 / at, 1 / at**2 - 1
        value = (-np.log(at) + at - 1 - (at - 1) ** 2 / 2 + slope * below + curvature * below**2 / 2).sum()
        weights = (slope + curvature * below) / (band * self._sizes)
        by_node = np.einsum("kij,kix->kjx", self._weights, gradient(weights, cofactors))
        places = (3 * self._local[..., None] + np.arange(3)).ravel()
        total = np.bincount(places, by_node.ravel(), minlength=self._points.size).reshape(-1, 3)
        return float(value), total[self._free]

    def improved(self, halfway: np.ndarray) -> np.ndarray:
        """Find positions (f, 3) at which no hex is lower than as given; they begin as given, or at others (f, 3)."""
        floors = self.least(self.start)
        x = self.without_lower(halfway)
        begin = min(x, halfway, key=lambda each: self.barrier(each, floors)[0])
        while (floors := self.least(x)).min() < _GOAL:
            new = self._minimised(begin, floors)
            steps = [self._without_lower(x + 0.5**k * (new - x), x, floors) for k in range(5)]
            x = begin = max(steps, key=lambda step: self.least(step).sum())
            if (self.least(x) - floors)[floors < _GOAL].mean() < _MARGIN:
                break
        return x

    def without_lower(self, new: np.ndarray) -> np.ndarray:
        """Return new positions (f, 3), but those as given of nodes of hexes that would be lower than as given."""
        return self._without_lower(new, self.start, self.least(self.start))

    def _without_lower(self, new: np.ndarray, x: np.ndarray, floors: np.ndarray) -> np.ndarray:
        """Return new positions (f, 3), but those at x (f, 3) of nodes of hexes that would be below their floor (k,)."""
        new = new.copy()
        while (lower := self.least(new) < floors).any():
            back = mask(self._local[lower].ravel(), self._free.size)[self._free]
            new[back] = x[back]
        return new

    def _minimised(self, begin: np.ndarray, floors: np.ndarray) -> np.ndarray:
        """Minimise the barrier of floors (k,) from positions (f, 3); the unknowns are moves in edge lengths."""

        from scipy.optimize import minimize  # not loaded with the doctor

        def barrier(moves: np.ndarray) -> tuple[float, np.ndarray]:
            value, slopes = self.barrier(begin + self._unit * moves.reshape(-1, 3), floors)
            return value, self._unit * slopes.ravel()

        options = {"maxiter": _ITERATIONS}
        found = minimize(barrier, np.zeros(begin.size), jac=True, method="L-BFGS-B", options=options)
        return begin + self._unit * found.x.reshape(-1, 3)


def _sizes(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Compute the mean determinant at the corners of hexes (k, 8), by the amounts, (k, 1); 1 for flat hexes."""
    corners = points[hexes][:, CORNER_TETRAHEDRA]
    sizes = np.abs(np.linalg.det(corners[:, :, 1:] - corners[:, :, :1])).mean(axis=1, keepdims=True)
    return np.where(sizes > 0, sizes, 1.0)


def are_low(points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray) -> np.ndarray:
    """Mark the hexes whose least coefficient is below the goal, (k,) bool; parameters are those of `Patch`."""
    return least_coefficients(points, hexes, mid_nodes) < _GOAL * _sizes(points, hexes)[:, 0]


def valid_mid_nodes(
    points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray, low: np.ndarray, kept: np.ndarray, rings: int | None
) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Find positions of mid-nodes around hexes that raise their least det J.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    mid_nodes : (m, 19) int32
    low : (m,) bool
        The hexes. Their mid-nodes begin as given or halfway between the corners, where that is better.
    kept : (n,) bool
        Mid-nodes that stay.
    rings : int or None
        Rings of hexes, each sharing mid-nodes with the last, whose mid-nodes move too. None puts mid-nodes of the hexes
        halfway, where that makes no hex lower, and minimises nothing.

    Yields
    ------
    hexes : (k,) int64
        Hexes of a patch, which shares no node that moves with others.
    nodes : (f,) int64
        Mid-nodes that move.
    positions : (f, 3) float64
        At which no hex has a lower least coefficient than as given, or one above the goal.
    """
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import connected_components

    free = np.append(~kept, False)  # the last for the number -1
    rows, columns = np.nonzero(low[:, None] & free[mid_nodes])
    halfway, region = points.copy(), low
    halfway[mid_nodes[rows, columns]] = np.einsum("kc,kcx->kx", MID_NODE_WEIGHTS[columns], points[hexes[rows]])
    for _ in range(rings or 0):
        region = (mask(mid_nodes[region], free.size)[mid_nodes] & (mid_nodes >= 0)).any(axis=1)
    free &= mask(mid_nodes[region], free.size)
    rows, columns = np.nonzero(free[mid_nodes])
    uses = csr_matrix((np.ones(rows.size), (rows, mid_nodes[rows, columns])), shape=(len(hexes), free.size))
    patches, some = connected_components(uses @ uses.T)[1], np.unique(rows)
    for number in np.unique(patches[some]):
        patch = some[patches[some] == number]
        found = Patch(points, hexes[patch], mid_nodes[patch], free)
        start = halfway[found.nodes]
        minimise = rings is not None and patch.size <= _LARGEST_PATCH
        yield patch, found.nodes, found.improved(start) if minimise else found.without_lower(start)
