"""A node's step in figures, each with a sentence that says what it means."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.node_step import NodeStep, StepStatus
from hexmend.smoothers import METHODS
from hexmend_app.theme.palette import TEXT, WORSE, Role
from hexmend_app.widgets.wording import counted, figure, name_in_words, short_number

_DIRECTIONS = {
    "sd": ("steepest descent (A.2)", "Straight downhill: minus the gradient of the p-th root of the energy."),
    "nr": ("Newton (A.3)", "To the bottom of the parabola that fits the energy here in slope and curvature."),
    "mnr": (
        "modified Newton (A.4)",
        "As Newton's, after the least eigenvalue was raised to a thousandth of the greatest.",
    ),
}

#: Mean edge lengths up to which a move is an error of rounding.
_NO_MOVE = 1e-9


@dataclass(frozen=True)
class Row:
    """A figure: its name, its value as text, what it means, and the colour of the value."""

    name: str
    value: str
    meaning: str
    colour: Role = TEXT


def verdict(step: NodeStep) -> StepStatus:
    """Describe the outcome for the node; a move within rounding counts as none."""
    moved = step.status in (StepStatus.MOVED, StepStatus.SHORTENED)
    return StepStatus.AT_TARGET if moved and step.move < _NO_MOVE else step.status


def rows(step: NodeStep) -> list[Row]:
    """Describe a step in the order of the algorithm."""
    searched = step.method.split("-")[-1] in _DIRECTIONS
    message = [_energy(step), *_slope(step)]
    if searched:
        message += [*_direction(step), *_line_search(step)]
    else:
        message += _places(step)
    message.append(Row("Move", f"{figure(step.move, 3)} edges", f"In mean edge lengths of the {_scale(step)}."))
    message.append(_delta(step, searched))
    message += _notes(step) if not searched else []
    return message


#: Share of an energy below which a difference is rounding.
_ROUNDING = 1e-12


def _scale(step: NodeStep) -> str:
    return "mesh" if step.is_global else "patch"


def _power(step: NodeStep) -> str:
    p = step.norm.p
    return "²" if p == 2 else f"^{short_number(p)}"


def _energy(step: NodeStep) -> Row:
    before, after = _finite(step.energy), _finite(step.energy_after)
    of = "of the whole mesh" if step.is_global else f"of its {counted(step.hexes.size, 'hex')}, the patch"
    least = short_number(step.norm.cube_value)
    meaning = f"The sum of η(H){_power(step)} {of}, in mean edge lengths of it; a cube has {least}."
    rises = step.move > 0 and step.energy_after > step.energy * (1 + _ROUNDING)
    if rises:
        reason = "other nodes move too" if METHODS[step.method].optimises else "this method does not look at it"
        meaning += f" It rises: {reason}."
    return Row("Energy", before if step.move == 0 else f"{before} → {after}", meaning, WORSE if rises else TEXT)


def _finite(value: float) -> str:
    return figure(value) if np.isfinite(value) else "∞"


def _delta(step: NodeStep, searched: bool) -> Row:
    if step.delta == 0:
        where = "" if searched else " here"
        meaning = f"No hex{where} is inverted: to invert one would cost infinite energy."
    elif searched:
        meaning = "While some hex is inverted, δ softens the barrier (3.2), or the energy would be infinite."
    else:
        meaning = "A hex here is inverted; what is shown is the energy softened by this δ (3.2)."
    return Row("δ", figure(step.delta), meaning)


def _slope(step: NodeStep) -> list[Row]:
    if not np.isfinite(step.gradient).all():
        return []
    size = figure(float(np.linalg.norm(step.gradient)))
    return [
        Row("Gradient |∇f|", size, "How steep the energy is for this node; its arrow points uphill."),
        _eigenvalues(step),
    ]


def _eigenvalues(step: NodeStep) -> Row:
    values = step.eigenvalues
    below = int(np.count_nonzero(values < 0))
    if not np.isfinite(values).all():
        meaning = "The energy is infinite here and has no curvature."
    elif below:
        meaning = (
            f"Curvatures of the energy (of its 3 × 3 Hessian). {below} of them below 0: that way the energy bends "
            "downwards, as on a saddle, and Newton's direction may lead uphill."
        )
    else:
        meaning = "Curvatures of the energy (of its 3 × 3 Hessian). All above 0: a bowl, whose bottom Newton aims at."
        if values[2] > 100 * values[0]:
            meaning += " Far apart: a narrow valley, across which steepest descent zigzags."
    text = "  ".join(f"{v:.3g}".replace("e+0", "e").replace("e-0", "e-").replace("-", "−") for v in values)
    return Row("Eigenvalues", text, meaning, WORSE if below else TEXT)


def _direction(step: NodeStep) -> list[Row]:
    kind = step.method.split("-")[-1]
    name, meaning = _DIRECTIONS[kind]
    if step.fallback:
        name, meaning = _DIRECTIONS["sd"][0], "Newton's direction would lead uphill; steepest descent takes its place."
    if step.is_global:
        meaning += " The node's part of the direction of all nodes, which depend on each other."
    rows = [Row("Direction", name, meaning, WORSE if step.fallback else TEXT)]
    if kind == "mnr":
        whose = "the whole mesh's" if step.is_global else "its"
        rows.append(
            Row("Shift", figure(step.shift), f"What A.4 adds to {whose} eigenvalues; 0 where all are well above 0.")
        )
    return rows


def _line_search(step: NodeStep) -> list[Row]:
    if not step.trials:
        return []
    meaning = (
        f"Line search (A.5): the first trial is α = {short_number(step.trials[0].alpha)}; one that does not come below "
        "the dashed line (Armijo) is cut, and tried again. The longest may lie beyond the plot."
    )
    text = (
        f"{step.alpha:.3g} after {counted(step.backtracks, 'cut')}" if step.alpha > 0 else f"none of {len(step.trials)}"
    )
    return [Row("Step α", text, meaning, TEXT if step.alpha > 0 else WORSE)]


def _places(step: NodeStep) -> list[Row]:
    if not step.pulls:
        return []
    rows = []
    count = (
        counted(len(step.pulls), "neighbour") if step.pulls[0].kind == "node" else f"{len(step.pulls)} hexes' places"
    )
    if step.pulls[0].weight is None:
        rows.append(Row("Drawn by", count, "One hex at a time takes its step, the worst of the mesh first."))
    elif step.pulls[0].kind == "node":
        rows.append(Row("Goes to", f"mean of {count}", f"Each weighs 1/{len(step.pulls)}; white balls in the view."))
    else:
        weights = ", ".join(f"{pull.number:,}: {pull.weight:.3f}" for pull in step.pulls)
        meaning = f"Each hex, made more regular by itself, has a place for the node, a white ball. Weights: {weights}."
        rows.append(Row("Goes to", f"mean of {count}", meaning))
    if step.pulls[0].weight is not None:
        rows.append(Row("Taken", f"{100 * step.alpha:.0f} %", "Of the way; less where the whole would do harm."))
    return rows


def _notes(step: NodeStep) -> list[Row]:
    """Describe the whole iteration from the method's diagnostics."""
    lines = [
        f"{name_in_words(name).lower()} {_note(value)}" for name, value in step.diagnostics.items() if value is not None
    ]
    if not lines:
        return []
    return [Row("Iteration", "", f"It moves all nodes at once. The method tells of it: {', '.join(lines)}.")]


def _note(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else f"{value:,}" if isinstance(value, int) else str(value)
