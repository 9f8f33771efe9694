"""Figures of a node's step, each with an explanation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.smoothers import METHODS
from hexmend_app.state.node_step import NodeStep
from hexmend_app.theme.palette import TEXT, WORSE, Role
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import counted, figure, name_in_words, short_number

_DIRECTIONS = {
    "sd": ("steepest descent (A.2)", "Negative gradient of the p-th root of the energy."),
    "nr": ("Newton (A.3)", "To the minimum of the local quadratic model of the energy."),
    "mnr": (
        "modified Newton (A.4)",
        "Newton direction with the smallest eigenvalue increased to a thousandth of the largest.",
    ),
}


@dataclass(frozen=True)
class Row:
    """A figure: its name, its value as text, its explanation, and the colour of the value."""

    name: str
    value: str
    meaning: str
    colour: Role = TEXT


def rows(step: NodeStep) -> list[Row]:
    """Return the figures of a step, in the order of the algorithm."""
    has_direction = step.method.split("-")[-1] in _DIRECTIONS
    unit = tr("In mean edge lengths of the mesh.") if step.is_global else tr("In mean edge lengths of the patch.")
    return [
        _energy(step),
        *_slope(step),
        *([*_direction(step), *_line_search(step)] if has_direction else _target(step)),
        Row(tr("Move"), tr("{move} edges", move=figure(step.move, 3)), unit),
        _delta(step, has_direction),
        *([] if has_direction else _diagnostics(step)),
    ]


def _power(step: NodeStep) -> str:
    p = step.norm.p
    return "²" if p == 2 else f"^{short_number(p)}"


def _energy(step: NodeStep) -> Row:
    before, after = _energy_text(step.energy), _energy_text(step.energy_after)
    patch = tr("its {hexes} (the patch)", hexes=counted(step.hexes.size, "hex"))
    meaning = tr(
        "Sum of η(H){power} over {part}, in units of the mean edge length; a cube has {cube}.",
        power=_power(step),
        part=tr("the whole mesh") if step.is_global else patch,
        cube=short_number(step.norm.cube_value),
    )
    if step.raises_energy:
        optimises = METHODS[step.method].optimises
        meaning += " " + (
            tr("It rises: other nodes move too.") if optimises else tr("It rises: this method does not evaluate it.")
        )
    return Row(
        tr("Energy"),
        before if step.move == 0 else f"{before} → {after}",
        meaning,
        WORSE if step.raises_energy else TEXT,
    )


def _energy_text(value: float) -> str:
    return figure(value) if np.isfinite(value) else "∞"


def _delta(step: NodeStep, has_direction: bool) -> Row:
    if step.delta == 0:
        meaning = tr("No hex is inverted: inverting one would cost infinite energy.")
    elif has_direction:
        meaning = tr("δ softens the barrier (3.2) while a hex is inverted; without it the energy would be infinite.")
    else:
        meaning = tr("A hex of the patch is inverted; the energy shown is softened by this δ (3.2).")
    return Row("δ", figure(step.delta), meaning)


def _slope(step: NodeStep) -> list[Row]:
    if not np.isfinite(step.gradient).all():
        return []
    norm = figure(float(np.linalg.norm(step.gradient)))
    if step.descent.any():
        meaning = tr("Slope of the energy with respect to this node; the arrow of steepest descent points downhill.")
    else:
        norm, meaning = tr("0"), tr("The gradient is within rounding: it has no direction, and no arrow is drawn.")
    return [Row(tr("Gradient |∇f|"), norm, meaning), _eigenvalues(step)]


def _eigenvalues(step: NodeStep) -> Row:
    values = step.eigenvalues
    negative = int(np.count_nonzero(values < 0))
    if not np.isfinite(values).all():
        meaning = tr("The energy is infinite here and has no curvature.")
    elif negative:
        meaning = tr(
            "Curvatures of the energy (of the 3 × 3 Hessian). {count} negative, as on a saddle: the Newton direction "
            "may lead uphill.",
            count=negative,
        )
    else:
        meaning = tr(
            "Curvatures of the energy (of the 3 × 3 Hessian). All positive: locally convex; the Newton direction "
            "leads to the minimum of the local quadratic model."
        )
        if values[2] > 100 * values[0]:
            meaning += " " + tr("They differ strongly: a narrow valley, which steepest descent crosses in a zigzag.")
    text = "  ".join(f"{v:.3g}".replace("e+0", "e").replace("e-0", "e-").replace("-", "−") for v in values)
    return Row(tr("Eigenvalues"), text, meaning, WORSE if negative else TEXT)


def _direction(step: NodeStep) -> list[Row]:
    kind = step.method.split("-")[-1]
    name, meaning = map(tr, _DIRECTIONS[kind])
    if step.fallback:
        name, meaning = tr(_DIRECTIONS["sd"][0]), tr("Replaces the Newton direction, which would lead uphill.")
    if step.is_global:
        meaning += " " + tr("This is the node's component of the global search direction.")
    rows = [Row(tr("Direction"), name, meaning, WORSE if step.fallback else TEXT)]
    if kind == "mnr":
        meaning = tr("Added to the eigenvalues of the Hessian (A.4); 0 if all are clearly positive.")
        rows.append(Row(tr("Shift"), figure(step.shift), meaning))
    return rows


def _line_search(step: NodeStep) -> list[Row]:
    if not step.trials:
        return []
    meaning = tr(
        "Line search (A.5): the first trial is α = {alpha}; a trial above the dashed line (Armijo) is cut. Long trials "
        "may be outside the plot.",
        alpha=short_number(step.trials[0].alpha),
    )
    if step.alpha > 0:
        text = tr("{alpha:.3g} after {cuts}", alpha=step.alpha, cuts=counted(step.backtracks, "cut"))
    else:
        text = tr("none of {count}", count=len(step.trials))
    return [Row(tr("Step α"), text, meaning, TEXT if step.alpha > 0 else WORSE)]


def _target(step: NodeStep) -> list[Row]:
    if not step.pulls:
        return []
    by_node, count = step.pulls[0].kind == "node", len(step.pulls)
    sources = counted(count, "neighbour") if by_node else tr("positions in {hexes}", hexes=counted(count, "hex"))
    if step.pulls[0].weight is None:
        meaning = tr("The method moves one hex at a time, the worst of the mesh first.")
        return [Row(tr("Attracted by"), sources, meaning)]
    target = tr("mean of {sources}", sources=sources)
    if by_node:
        meaning = tr("Each has the weight 1/{count}; white balls in the view.", count=count)
    else:
        meaning = tr(
            "Positions of the node in each hex made more regular, white balls in the view. Weights: {weights}.",
            weights=", ".join(f"{pull.number}: {pull.weight:.3f}" for pull in step.pulls),
        )
    fraction = tr("Fraction of the way to the target; smaller if the full step would lower the quality.")
    return [Row(tr("Target"), target, meaning), Row(tr("Step"), f"{100 * step.alpha:.0f} %", fraction)]


def _diagnostics(step: NodeStep) -> list[Row]:
    """Describe the whole iteration by the method's diagnostics."""
    values = [
        f"{name_in_words(name).lower()} {_value_text(value)}"
        for name, value in step.diagnostics.items()
        if value is not None
    ]
    if not values:
        return []
    meaning = tr("All nodes move at once. Diagnostics of the method: {values}.", values=", ".join(values))
    return [Row(tr("Iteration"), "", meaning)]


def _value_text(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else f"{value:,}" if isinstance(value, int) else str(value)
