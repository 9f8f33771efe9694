"""The linear program of a step: nodes that go certain directions, and what depends on their places by linear models."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from hexmend.optimise.maxmin.directions import StepDirections

if TYPE_CHECKING:
    from scipy.sparse import csr_array

#: Share of the gain that may be given away so that nodes stay which need not move.
IDLE = 0.05
#: How near to their bounds, in radii of the region, the models are that the program begins with; what counts as below.
NEAR, BELOW = 0.3, 1e-7
#: Of HiGHS: programs as small as these are solved before its presolve has made them smaller.
_HIGHS = {"presolve": False, "simplex_dual_edge_weight_strategy": "devex"}


@dataclass(frozen=True, eq=False)
class LinearConstraints:
    """Linear models of what depends on the places of four nodes each.

    Parameters
    ----------
    ends : (r, 4)
        The nodes.
    above : (r,)
        How far the value is above its bound.
    slopes : (r, 4, 3)
        Its derivatives by their places.
    rises : (r,)
        1 where the bound is to rise, as the least of the corners is; 0 where it stands.
    """

    ends: np.ndarray
    above: np.ndarray
    slopes: np.ndarray
    rises: np.ndarray

    def joined(self, other: LinearConstraints) -> LinearConstraints:
        """These, and others behind them."""
        pairs = ((getattr(one, field.name) for one in (self, other)) for field in dataclasses.fields(self))
        return LinearConstraints(*(np.concatenate(list(pair)) for pair in pairs))


def lower_bounds(ends: np.ndarray, above: np.ndarray, slopes: np.ndarray) -> LinearConstraints:
    """Models of what is not to fall below its bound; arrays as of `LinearConstraints`."""
    return LinearConstraints(ends, above, slopes, np.zeros(len(above)))


def no_constraints() -> LinearConstraints:
    """None of them."""
    return lower_bounds(np.empty((0, 4), np.int32), np.empty(0), np.empty((0, 4, 3)))


@dataclass(frozen=True, eq=False)
class LPSolution:
    """The solution of a program.

    Parameters
    ----------
    lengths : (w,)
        How far to go each way.
    gain : float
        What the least rises by, as the models say.
    multipliers : (r,)
        Of the models, not negative: those of the ones that rise have the sum 1 where the gain has no bound.
    """

    lengths: np.ndarray
    gain: float
    multipliers: np.ndarray


def solve(
    nodes: np.ndarray, directions: StepDirections, models: LinearConstraints, radius: float, falls: bool = False
) -> LPSolution | None:
    """Find how far nodes (k,) are to go for the least to rise most; None where the program has no solution.

    Most models are far from their bounds, and hold whatever the nodes do: the program begins with those that are near,
    and is solved again with those that turn out to fall below.

    Parameters
    ----------
    nodes : (k,) int
    directions : StepDirections
    models : LinearConstraints
    radius : float
        How far a node may go each way.
    falls : bool
        Whether the least may fall, so that all else can be kept to.
    """
    from scipy.optimize import linprog

    cost, matrix, limits, bounds = build_program(nodes, directions, models, radius, falls)
    taken = limits < NEAR * radius
    while True:
        rows = np.flatnonzero(taken)
        solved = linprog(cost, matrix[rows], limits[rows], bounds=bounds, method="highs-ds", options=_HIGHS)
        if solved.status != 0:
            return None
        below = (matrix @ solved.x > limits + BELOW) & ~taken
        if not below.any():
            multipliers = np.zeros(limits.size)
            multipliers[rows] = -solved.ineqlin.marginals
            return LPSolution(solved.x[:-1], float(solved.x[-1]), multipliers)
        taken |= below


def build_program(
    nodes: np.ndarray, directions: StepDirections, models: LinearConstraints, radius: float, falls: bool
) -> tuple[np.ndarray, csr_array, np.ndarray, np.ndarray]:
    """The linear program of a step: costs (u,), matrix (r, u), its upper limits (r,), bounds (u, 2).

    Unknowns are how far nodes (k,) go in each of their directions, up to a radius, and what the least rises by. A small
    price on each direction keeps nodes that need not move.
    """
    from scipy.sparse import coo_array

    ends = models.ends
    slot = np.full(int(ends.max(initial=0)) + 1, -1)
    slot[nodes] = np.arange(nodes.size)
    slots = slot[ends]
    row, end = np.nonzero(slots >= 0)
    own = slots[row, end]
    start = np.searchsorted(directions.owner, np.arange(nodes.size + 1))
    count = start[own + 1] - start[own]
    pair = np.repeat(np.arange(own.size), count)
    column = np.arange(pair.size) + np.repeat(start[own] - np.cumsum(count) + count, count)
    slopes = np.einsum("ki,ki->k", models.slopes[row[pair], end[pair]], directions.effective[column])
    unknowns, rows = directions.owner.size + 1, len(ends)
    entries = np.concatenate([-slopes, models.rises])
    at = np.concatenate([row[pair], np.arange(rows)]), np.concatenate([column, np.full(rows, unknowns - 1)])
    cost = np.full(unknowns, IDLE / max(nodes.size, 1))
    cost[-1] = -1.0
    bounds = np.zeros((unknowns, 2))
    bounds[:, 1] = radius
    bounds[-1] = -2.0 if falls else 0.0, 2.0
    return cost, coo_array((entries, at), shape=(rows, unknowns)).tocsr(), models.above, bounds
