"""Figures of a node's step, each with an explanation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.node_step import NodeStep, StepStatus
from hexmend.smoothers import METHODS
from hexmend_app.theme.palette import TEXT, WORSE, Role
from hexmend_app.widgets.wording import counted, figure, name_in_words, short_number

_DIRECTIONS = {
    "sd": ("steepest descent (A.2)", "Negative gradient of the p-th root of the energy."),
    "nr": ("Newton (A.3)", "To the minimum of the local quadratic model of the energy."),
    "mnr": (
        "modified Newton (A.4)",
        "Newton direction with the smallest eigenvalue increased to a thousandth of the largest.",
    ),
}

#: Largest move that counts as rounding, in mean edge lengths.
_NO_MOVE = 1e-9

#: Largest relative change of energy that counts as rounding.
_ROUNDING = 1e-12


@dataclass(frozen=True)
class Row:
    """A figure: its name, its value as text, its explanation, and the colour of the value."""

    name: str
    value: str
    meaning: str
    colour: Role = TEXT


def displayed_status(step: NodeStep) -> StepStatus:
    """Return the status of a step; a node that moves by rounding only is at its target."""
    moved = step.status in (StepStatus.MOVED, StepStatus.SHORTENED)
    return StepStatus.AT_TARGET if moved and step.move < _NO_MOVE else step.status


def rows(step: NodeStep) -> list[Row]:
    """Return the figures of a step, in the order of the algorithm."""
    has_direction = step.method.split("-")[-1] in _DIRECTIONS
    unit = f"In mean edge lengths of the {'mesh' if step.is_global else 'patch'}."
    return [
        _energy(step),
        *_slope(step),
        *([*_direction(step), *_line_search(step)] if has_direction else _target(step)),
        Row("Move", f"{figure(step.move, 3)} edges", unit),
        _delta(step, has_direction),
        *([] if has_direction else _diagnostics(step)),
    ]


def _power(step: NodeStep) -> str:
    p = step.norm.p
    return "²" if p == 2 else f"^{short_number(p)}"


def _energy(step: NodeStep) -> Row:
    before, after = _energy_text(step.energy), _energy_text(step.energy_after)
    hexes = "the whole mesh" if step.is_global else f"its {counted(step.hexes.size, 'hex')} (the patch)"
    cube = short_number(step.norm.cube_value)
    meaning = f"Sum of η(H){_power(step)} over {hexes}, in units of the mean edge length; a cube has {cube}."
    rises = step.move > 0 and step.energy_after > step.energy * (1 + _ROUNDING)
    if rises:
        reason = "other nodes move too" if METHODS[step.method].optimises else "this method does not evaluate it"
        meaning += f" It rises: {reason}."
    return Row("Energy", before if step.move == 0 else f"{before} → {after}", meaning, WORSE if rises else TEXT)


def _energy_text(value: float) -> str:
    return figure(value) if np.isfinite(value) else "∞"


def _delta(step: NodeStep, has_direction: bool) -> Row:
    if step.delta == 0:
        hexes = "hex" if has_direction else "hex of the patch"
        meaning = f"No {hexes} is inverted: inverting one would cost infinite energy."
    elif has_direction:
        meaning = "δ softens the barrier (3.2) while a hex is inverted; without it the energy would be infinite."
    else:
        meaning = "A hex of the patch is inverted; the energy shown is softened by this δ (3.2)."
    return Row("δ", figure(step.delta), meaning)


def _slope(step: NodeStep) -> list[Row]:
    if not np.isfinite(step.gradient).all():
        return []
    norm = figure(float(np.linalg.norm(step.gradient)))
    return [
        Row("Gradient |∇f|", norm, "Slope of the energy with respect to this node; its arrow points uphill."),
        _eigenvalues(step),
    ]


def _eigenvalues(step: NodeStep) -> Row:
    values = step.eigenvalues
    negative = int(np.count_nonzero(values < 0))
    if not np.isfinite(values).all():
        meaning = "The energy is infinite here and has no curvature."
    elif negative:
        meaning = (
            f"Curvatures of the energy (of the 3 × 3 Hessian). {negative} negative, as on a saddle: the Newton "
            "direction may lead uphill."
        )
    else:
        meaning = (
            "Curvatures of the energy (of the 3 × 3 Hessian). All positive: locally convex; the Newton direction "
            "leads to the minimum of the local quadratic model."
        )
        if values[2] > 100 * values[0]:
            meaning += " They differ strongly: a narrow valley, which steepest descent crosses in a zigzag."
    text = "  ".join(f"{v:.3g}".replace("e+0", "e").replace("e-0", "e-").replace("-", "−") for v in values)
    return Row("Eigenvalues", text, meaning, WORSE if negative else TEXT)


def _direction(step: NodeStep) -> list[Row]:
    kind = step.method.split("-")[-1]
    name, meaning = _DIRECTIONS[kind]
    if step.fallback:
        name, meaning = _DIRECTIONS["sd"][0], "Replaces the Newton direction, which would lead uphill."
    if step.is_global:
        meaning += " This is the node's component of the global search direction."
    rows = [Row("Direction", name, meaning, WORSE if step.fallback else TEXT)]
    if kind == "mnr":
        hessian = "Hessian of the whole mesh" if step.is_global else "Hessian"
        meaning = f"Added to the eigenvalues of the {hessian} (A.4); 0 if all are clearly positive."
        rows.append(Row("Shift", figure(step.shift), meaning))
    return rows


def _line_search(step: NodeStep) -> list[Row]:
    if not step.trials:
        return []
    meaning = (
        f"Line search (A.5): the first trial is α = {short_number(step.trials[0].alpha)}; a trial above the dashed "
        "line (Armijo) is cut. Long trials may be outside the plot."
    )
    text = (
        f"{step.alpha:.3g} after {counted(step.backtracks, 'cut')}" if step.alpha > 0 else f"none of {len(step.trials)}"
    )
    return [Row("Step α", text, meaning, TEXT if step.alpha > 0 else WORSE)]


def _target(step: NodeStep) -> list[Row]:
    if not step.pulls:
        return []
    by_node, count = step.pulls[0].kind == "node", len(step.pulls)
    positions = counted(count, "neighbour") if by_node else f"positions in {counted(count, 'hex')}"
    if step.pulls[0].weight is None:
        return [Row("Attracted by", positions, "The method moves one hex at a time, the worst of the mesh first.")]
    if by_node:
        meaning = f"Each has the weight 1/{count}; white balls in the view."
    else:
        weights = ", ".join(f"{pull.number:,}: {pull.weight:.3f}" for pull in step.pulls)
        meaning = f"Positions of the node in each hex made more regular, white balls in the view. Weights: {weights}."
    return [
        Row("Target", f"mean of {positions}", meaning),
        Row(
            "Step",
            f"{100 * step.alpha:.0f} %",
            "Fraction of the way to the target; smaller if the full step would lower the quality.",
        ),
    ]


def _diagnostics(step: NodeStep) -> list[Row]:
    """Describe the whole iteration by the method's diagnostics."""
    values = [
        f"{name_in_words(name).lower()} {_value_text(value)}"
        for name, value in step.diagnostics.items()
        if value is not None
    ]
    if not values:
        return []
    return [Row("Iteration", "", f"All nodes move at once. Diagnostics of the method: {', '.join(values)}.")]


def _value_text(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else f"{value:,}" if isinstance(value, int) else str(value)
