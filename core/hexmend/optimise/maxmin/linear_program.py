"""Linear program of a step: displacements along given directions that maximise the least of linear models."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from hexmend.arrays import index_of
from hexmend.kernels import linear_program as kernels
from hexmend.optimise.maxmin.directions import StepDirections
from hexmend.optimise.maxmin.vertex import Vertex, names_of_models, names_of_unknowns

#: Cost, in scaled Jacobian, of moving all nodes by their shortest edge: nodes without effect stay.
MOVE_COST = 0.05
#: Distance of a model from its bound, in radii of the region, up to which the program begins with it: by default, and
#: where few of the others turn out to be violated.
INITIAL_MARGIN, SMALL_MARGIN = 0.3, 0.1
#: Violation from which on a model that was omitted is added.
MAX_VIOLATION = 1e-7
#: Coefficient from which on HiGHS refuses a row (its option large_matrix_value).
MAX_COEFFICIENT = 1e15


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
    margin: float = INITIAL_MARGIN,
    vertex: Vertex | None = None,
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
    margin : float
        Distance of a model from its bound, in radii, up to which the program begins with it.
    vertex : Vertex, optional
        Where an earlier program ended, and this one begins; changed to where this one ends.

    Returns
    -------
    LPSolution or None
    """
    program = build_program(nodes, directions, constraints, radius, may_decrease)
    if not np.abs(program.matrix.values).max(initial=0.0) < MAX_COEFFICIENT:
        return None  # a node is so far away that no step can be found with the others
    vertex = vertex or Vertex()
    names, row_names = names_of_unknowns(nodes, directions), names_of_models(constraints.nodes, constraints.has_gain)
    begin = (vertex.unknowns(names), vertex.rows(row_names)) if vertex.is_known else None
    solved = _solve_with_needed_rows(program, program.limits < margin * radius, begin)
    if solved is None:
        return None
    x, multipliers = solved
    at = np.where(x <= program.lower, 0, np.where(x >= program.upper, 2, 1))
    vertex.remember(names, at, row_names, multipliers > 0)
    return LPSolution(x[:-1], float(x[-1]), multipliers)


def _solve_with_needed_rows(
    program: LinearProgram, taken: np.ndarray, begin: tuple[np.ndarray, np.ndarray] | None
) -> tuple[np.ndarray, np.ndarray] | None:
    """Return x (u,) and the multipliers (r,) of a program that begins with some rows (r,), bool; None if there is none.

    It begins at a vertex: the unknowns (u,) and rows (r,) that are at their bounds, as `Vertex` has them.
    """
    from hexmend.optimise.maxmin.simplex import GrowingProgram  # 10 ms that a command without such steps saves

    limits, matrix, solver = program.limits, program.matrix, GrowingProgram(program.cost, program.lower, program.upper)
    if begin is not None:
        taken = taken | begin[1]
    order, added = list[np.ndarray](), np.flatnonzero(taken)
    while True:
        solver.add_rows(*matrix.rows(added), limits[added])
        if begin is not None and not order:
            solver.begin_at(begin[0], begin[1][added])
        order.append(added)
        solved = solver.solve()
        if solved is None:
            return None
        x, multipliers = solved
        below = (matrix.product(x) > limits + MAX_VIOLATION) & ~taken
        if not below.any():
            of_all = np.zeros(limits.size)
            of_all[np.concatenate(order)] = multipliers
            return x, of_all
        taken, added = taken | below, np.flatnonzero(below)


@dataclass(frozen=True, eq=False)
class SparseRows:
    """Sparse matrix by rows, none of which is empty.

    Parameters
    ----------
    start : (r + 1,) int
        Where each row begins in the others.
    columns : (k,) int
    values : (k,) float64
    """

    start: np.ndarray
    columns: np.ndarray
    values: np.ndarray

    def product(self, x: np.ndarray) -> np.ndarray:
        """Multiply by a vector (u,), (r,)."""
        if self.start.size == 1:
            return np.empty(0)
        return np.add.reduceat(self.values * x[self.columns], self.start[:-1])

    def summed(self, width: int) -> SparseRows:
        """Add values at one place; the matrix has so many columns."""
        count = self.start.size - 1
        row = np.repeat(np.arange(count), np.diff(self.start))
        place, entry = np.unique(row * width + self.columns, return_inverse=True)
        row, column = np.divmod(place, width)
        values = np.bincount(entry, self.values, place.size)
        return SparseRows(np.searchsorted(row, np.arange(count + 1)), column, values)

    def rows(self, which: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the start, columns and values of some rows (j,); a start for each."""
        first, count = self.start[which], np.diff(self.start)[which]
        start = np.cumsum(count) - count
        at = np.arange(count.sum()) + np.repeat(first - start, count)
        return start, self.columns[at], self.values[at]


@dataclass(frozen=True, eq=False)
class LinearProgram:
    """Minimise cost · x with lower <= x <= upper and matrix x <= limits.

    Parameters
    ----------
    cost, lower, upper : (u,) float64
    matrix : SparseRows
        Of (r, u) numbers.
    limits : (r,) float64
    """

    cost: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    matrix: SparseRows
    limits: np.ndarray


def build_program(
    nodes: np.ndarray, directions: StepDirections, constraints: LinearConstraints, radius: float, may_decrease: bool
) -> LinearProgram:
    """Build the linear program of a step.

    Unknowns are the lengths in each direction, up to a radius, and the rise of the least, which comes last. A small
    price on each direction keeps nodes that need not move.
    """
    greatest = max(nodes.max(initial=0), constraints.nodes.max(initial=0))  # a node may be without a constraint
    first = np.searchsorted(directions.node_index, np.arange(nodes.size + 1))
    unknowns = directions.n_unknowns + 1
    matrix = SparseRows(
        *kernels.rows(
            np.ascontiguousarray(constraints.nodes, dtype=np.int32),
            np.ascontiguousarray(constraints.slopes).reshape(-1, 12),
            constraints.has_gain,
            index_of(nodes, int(greatest) + 1),
            first,
            np.ascontiguousarray(directions.projected),
            directions.columns,
            unknowns - 1,
        )
    )
    if directions.unknown is not None:  # tied nodes share a column
        matrix = matrix.summed(unknowns)
    cost = np.full(unknowns, MOVE_COST / max(nodes.size, 1))
    lower, upper = np.zeros(unknowns), np.full(unknowns, radius)
    cost[-1], lower[-1], upper[-1] = -1.0, -2.0 if may_decrease else 0.0, 2.0
    return LinearProgram(cost, lower, upper, matrix, constraints.slack)
