"""Linear program of a step: displacements along given directions that maximise the least of linear models."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from hexmend.arrays import index_of
from hexmend.optimise.maxmin.directions import StepDirections

if TYPE_CHECKING:
    from scipy.sparse import csr_array

#: Cost, in scaled Jacobian, of moving all nodes by their shortest edge: nodes without effect stay.
MOVE_COST = 0.05
#: Distance of a model from its bound, in radii of the region, up to which the program begins with it.
INITIAL_MARGIN = 0.3
#: Violation from which on a model that was omitted is added.
MAX_VIOLATION = 1e-7
#: Options of HiGHS: its presolve takes longer than the solution of programs as small as these.
_HIGHS = {"presolve": False, "simplex_dual_edge_weight_strategy": "devex"}


@dataclass(frozen=True, eq=False)
class LinearConstraints:
    """Linear models of values that depend on four nodes each and have a lower bound.

    Parameters
    ----------
    nodes : (r, 4) int
    slack : (r,) float64
        Distance of the value above its bound.
    slopes : (r, 4, 3) float64
        Derivatives of the value by the nodes' places.
    has_gain : (r,) float64
        1 where the bound is the least of the corners, which is raised; 0 where it is constant.
    """

    nodes: np.ndarray
    slack: np.ndarray
    slopes: np.ndarray
    has_gain: np.ndarray

    def concatenate(self, other: LinearConstraints) -> LinearConstraints:
        """Append the models of another."""
        pairs = ((getattr(one, field.name) for one in (self, other)) for field in dataclasses.fields(self))
        return LinearConstraints(*(np.concatenate(list(pair)) for pair in pairs))


def lower_bounds(nodes: np.ndarray, slack: np.ndarray, slopes: np.ndarray) -> LinearConstraints:
    """Models with constant lower bounds; arrays as in `LinearConstraints`."""
    return LinearConstraints(nodes, slack, slopes, np.zeros(len(slack)))


def no_constraints() -> LinearConstraints:
    """An empty set of models."""
    return lower_bounds(np.empty((0, 4), np.int32), np.empty(0), np.empty((0, 4, 3)))


@dataclass(frozen=True, eq=False)
class LPSolution:
    """Solution of a program.

    Parameters
    ----------
    lengths : (u,) float64
        Length of the step of each unknown.
    gain : float
        Rise of the least by the models.
    multipliers : (r,) float64
        Of the models, not negative; those of the raised ones have the sum 1 where the gain is not bounded.
    """

    lengths: np.ndarray
    gain: float
    multipliers: np.ndarray


def solve(
    nodes: np.ndarray,
    directions: StepDirections,
    constraints: LinearConstraints,
    radius: float,
    may_decrease: bool = False,
) -> LPSolution | None:
    """Find the lengths of the steps that raise the least most; None where the program has no solution.

    Most models are far from their bounds and hold whatever the nodes do: the program begins with those that are near,
    and is solved again with those that turn out to be violated.

    Parameters
    ----------
    nodes : (k,) int
        The nodes that move.
    directions : StepDirections
        Of these nodes.
    constraints : LinearConstraints
    radius : float
        Longest step in a direction.
    may_decrease : bool
        The least may fall, so that the constant bounds can be kept.

    Returns
    -------
    LPSolution or None
    """
    from scipy.optimize import linprog

    cost, matrix, limits, bounds = build_program(nodes, directions, constraints, radius, may_decrease)
    taken = limits < INITIAL_MARGIN * radius
    while True:
        rows = np.flatnonzero(taken)
        solved = linprog(cost, matrix[rows], limits[rows], bounds=bounds, method="highs-ds", options=_HIGHS)
        if solved.status != 0:
            return None
        below = (matrix @ solved.x > limits + MAX_VIOLATION) & ~taken
        if not below.any():
            multipliers = np.zeros(limits.size)
            multipliers[rows] = -solved.ineqlin.marginals
            return LPSolution(solved.x[:-1], float(solved.x[-1]), multipliers)
        taken |= below


def build_program(
    nodes: np.ndarray, directions: StepDirections, constraints: LinearConstraints, radius: float, may_decrease: bool
) -> tuple[np.ndarray, csr_array, np.ndarray, np.ndarray]:
    """Build the linear program: costs (u,), matrix (r, u), its upper limits (r,), bounds (u, 2).

    Unknowns are the lengths in each direction, up to a radius, and the rise of the least, which comes last. A small
    price on each direction keeps nodes that need not move.
    """
    from scipy.sparse import coo_array

    node_index = index_of(nodes, int(constraints.nodes.max(initial=0)) + 1)[constraints.nodes]
    model, place = np.nonzero(node_index >= 0)
    node_index = node_index[model, place]
    first = np.searchsorted(directions.node_index, np.arange(nodes.size + 1))
    count = first[node_index + 1] - first[node_index]  # directions of the node
    pair = np.repeat(np.arange(node_index.size), count)
    direction = np.arange(pair.size) + np.repeat(first[node_index] - np.cumsum(count) + count, count)
    slopes = np.einsum("ki,ki->k", constraints.slopes[model[pair], place[pair]], directions.projected[direction])
    unknowns, models = directions.n_unknowns + 1, len(constraints.nodes)
    entries = np.concatenate([-slopes, constraints.has_gain])
    rows = np.concatenate([model[pair], np.arange(models)])
    columns = np.concatenate([directions.columns[direction], np.full(models, unknowns - 1)])
    cost = np.full(unknowns, MOVE_COST / max(nodes.size, 1))
    cost[-1] = -1.0
    bounds = np.zeros((unknowns, 2))
    bounds[:, 1] = radius
    bounds[-1] = -2.0 if may_decrease else 0.0, 2.0
    return cost, coo_array((entries, (rows, columns)), shape=(models, unknowns)).tocsr(), constraints.slack, bounds
