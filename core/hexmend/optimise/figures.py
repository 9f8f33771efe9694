"""The figures of an iteration: those of every history, and what a method may note beside them."""

from __future__ import annotations

from hexmend.figures import Figure, count, significant
from hexmend.quality.summary import FIGURES

#: The columns of a history, in order; a row of it is `Iteration.row`.
HISTORY: dict[str, Figure] = {
    figure.key: figure
    for figure in (
        Figure("iteration", "iteration", "Number of the iteration; 0 is the mesh before the first.", count),
        Figure("seconds", "seconds", "Time in the method since its preparation ended.", significant, -1),
        FIGURES["objective"],
        FIGURES["q_min"],
        FIGURES["q_mean"],
        FIGURES["inverted"],
        Figure(
            "largest_move",
            "largest move",
            "How far the node went that went furthest, in mean edge lengths: what Algorithm A.1 stops at.",
            significant,
        ),
    )
}

#: What methods note of a step.
NOTES: dict[str, Figure] = {
    figure.key: figure
    for figure in (
        Figure("gradient_norm", "gradient norm", "Norm of the objective's gradient before the step.", significant),
        Figure("step_length", "step length", "α, the share of the search direction that was gone (A.5).", significant),
        Figure(
            "solver_iterations",
            "solver iterations",
            "Iterations of the linear solver that the Newton direction took (A.3, A.4).",
            count,
        ),
        Figure("cuts", "line search cuts", "How often the line search cut the step (A.5).", count),
        Figure("delta", "delta", "δ, the softness of the barrier (3.2); 0 once no element is inverted.", significant),
    )
}
