"""Declarations of the figures of an iteration: those of every history, and the diagnostics of methods."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from hexmend.quality.summary import SUMMARY_QUANTITIES
from hexmend.quantity import Quantity, format_count, format_objective, format_significant

#: The columns of a history, in order; a row of it is `Iteration.row`.
HISTORY: dict[str, Quantity] = {
    figure.key: figure
    for figure in (
        Quantity("iteration", "iteration", "Number of the iteration; 0 is the mesh before the first.", format_count),
        Quantity("seconds", "seconds", "Time in the method since its preparation ended.", format_significant, -1),
        Quantity(
            "objective",
            "objective",
            "The objective that the method minimises at this step, Σ η(H)^p with its p and offset (3.3): infinite "
            "while any element is inverted. Steps that raise the least scaled Jacobian do not minimise it.",
            format_objective,
            -1,
        ),
        SUMMARY_QUANTITIES["q_min"],
        SUMMARY_QUANTITIES["q_mean"],
        SUMMARY_QUANTITIES["inverted"],
        Quantity(
            "largest_move",
            "largest move",
            "Longest move of a node, in mean edge lengths; Algorithm A.1 compares it with the tolerance.",
            format_significant,
        ),
    )
}


def objective_changes(rows: Sequence[Mapping[str, Any]]) -> list[int]:
    """Find the rows of a history from which on the objective is another one: there its curve is interrupted.

    >>> objective_changes([{"objective_formula": "Σ η²"}, {"objective_formula": "Σ η⁴"}, {"objective_formula": "Σ η⁴"}])
    [1]
    """
    formulas = [row.get("objective_formula") for row in rows]
    return [k for k in range(1, len(rows)) if formulas[k] != formulas[k - 1]]


#: Diagnostics of a step that charts and tables show.
NOTES: dict[str, Quantity] = {
    figure.key: figure
    for figure in (
        Quantity(
            "gradient_norm", "gradient norm", "Norm of the objective's gradient before the step.", format_significant
        ),
        Quantity(
            "step_length",
            "step length",
            "α, the share of the search direction that was gone (A.5).",
            format_significant,
        ),
        Quantity(
            "solver_iterations",
            "solver iterations",
            "Iterations of the linear solver that the Newton direction took (A.3, A.4).",
            format_count,
        ),
        Quantity("cuts", "line search cuts", "How often the line search cut the step (A.5).", format_count),
        Quantity(
            "delta", "delta", "δ, the softness of the barrier (3.2); 0 once no element is inverted.", format_significant
        ),
    )
}
