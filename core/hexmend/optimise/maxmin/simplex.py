"""Linear programs that grow: rows are added to a program that is solved already, and few steps lead on from there.

A program can also begin where an earlier one, about other unknowns and rows with the same names, has ended.
"""

from __future__ import annotations

import highspy
import numpy as np

_OPTIONS = {
    "output_flag": False,
    "presolve": "off",  # takes longer than the solution of programs as small as these
    "solver": "simplex",
    "simplex_strategy": 1,  # the dual method
    "simplex_dual_edge_weight_strategy": 1,  # Devex
    "threads": 1,
}


_LOWER, _BASIC, _UPPER = (getattr(highspy.HighsBasisStatus, name) for name in ("kLower", "kBasic", "kUpper"))
_OF_UNKNOWN, _OF_ROW = np.array([_LOWER, _BASIC, _UPPER], dtype=object), np.array([_BASIC, _UPPER], dtype=object)


class _Quiet(highspy.Highs):
    def __init__(self) -> None:
        super(highspy.Highs, self).__init__()  # that of Highs registers callbacks, which prints a line


class GrowingProgram:
    """Minimise cost · x with lower <= x <= upper and rows A x <= limits that are added step by step.

    Parameters
    ----------
    cost, lower, upper : (u,) float64
    """

    def __init__(self, cost: np.ndarray, lower: np.ndarray, upper: np.ndarray):
        self._solver = _Quiet()
        for name, value in _OPTIONS.items():
            self._solver.setOptionValue(name, value)
        no_rows = np.zeros(cost.size, np.int32), np.empty(0, np.int32), np.empty(0)
        self._solver.addCols(cost.size, cost, lower, upper, 0, *no_rows)

    def add_rows(self, start: np.ndarray, columns: np.ndarray, values: np.ndarray, limits: np.ndarray) -> None:
        """Add rows: start (r,) int of each in columns (k,) int and values (k,) float64, and their limits (r,)."""
        below = np.full(limits.size, -np.inf)
        start, columns = start.astype(np.int32), columns.astype(np.int32)
        status = self._solver.addRows(limits.size, below, limits, columns.size, start, columns, values)
        if status == highspy.HighsStatus.kError:
            raise ValueError("HiGHS refuses the rows: expected columns that exist, each once in a row")

    def begin_at(self, unknowns: np.ndarray, rows: np.ndarray) -> None:
        """Begin at a vertex: unknowns (u,) int that are at their lower bound (0), at none (1) or at the upper one (2).

        Of the rows, (r,) bool, some are at their limits. Where this is not the vertex of a basis, the nearest one is.
        """
        basis = highspy.HighsBasis()
        basis.col_status, basis.row_status = _OF_UNKNOWN[unknowns].tolist(), _OF_ROW[rows.astype(int)].tolist()
        basis.valid = basis.alien = True
        self._solver.setBasis(basis)

    def solve(self) -> tuple[np.ndarray, np.ndarray] | None:
        """Return x (u,) and the multipliers of the rows in the order in which they were added, not negative.

        None where there is no solution.
        """
        self._solver.run()
        if self._solver.getModelStatus() != highspy.HighsModelStatus.kOptimal:
            return None
        found = self._solver.getSolution()
        return np.array(found.col_value), -np.array(found.row_dual)
