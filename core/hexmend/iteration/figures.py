"""Declarations of the figures of an iteration: those of every history, and the diagnostics of methods."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from hexmend.quality.summary import SUMMARY_QUANTITIES
from hexmend.quantity import Quantity, format_count, format_objective, format_significant

_HISTORY = (
    Quantity("iteration", "iteration", "Number of the iteration; 0 is the mesh before the first.", format_count),
    Quantity("seconds", "seconds", "Time in the method since its preparation ended.", format_significant, -1),
    Quantity(
        "objective",
        "objective",
        "The objective that the method minimises at this step, Σ η(H)^p with its p and offset (3.3), and with "
        "surface_weight that of boundary quads: infinite while any element is inverted. Steps that raise the minimum "
        "scaled Jacobian or time step do not minimise it.",
        format_objective,
        -1,
    ),
    *(SUMMARY_QUANTITIES[key] for key in ("q_min", "q_mean", "scaled_jacobian_min", "inverted", "invalid")),
    Quantity(
        "largest_move",
        "largest move",
        "Longest move of a node, in mean edge lengths; Algorithm A.1 compares it with the tolerance.",
        format_significant,
    ),
)
#: The columns of a history, in order; a row of it is `Iteration.row`.
HISTORY = {figure.key: figure for figure in _HISTORY}


def objective_changes(rows: Sequence[Mapping[str, Any]]) -> list[int]:
    """Find the rows of a history from which on the objective is another one: there its curve is interrupted.

    >>> objective_changes([{"objective_formula": "Σ η²"}, {"objective_formula": "Σ η⁴"}, {"objective_formula": "Σ η⁴"}])
    [1]
    """
    formulas = [row.get("objective_formula") for row in rows]
    return [k for k in range(1, len(rows)) if formulas[k] != formulas[k - 1]]


_NOTES = (
    ("gradient_norm", "Norm of the objective's gradient before the step.", format_significant),
    ("step_length", "α, the share of the search direction that was taken (A.5).", format_significant),
    ("solver_iterations", "Iterations of the linear solver that the Newton direction took (A.3, A.4).", format_count),
    ("backtracks", "Number of backtracks of the line search (A.5).", format_count),
    ("delta", "δ, the softness of the barrier (3.2); 0 once no element is inverted.", format_significant),
)
#: Diagnostics of a step that charts and tables show.
DIAGNOSTICS = {key: Quantity(key, key.replace("_", " "), text, form) for key, text, form in _NOTES}
