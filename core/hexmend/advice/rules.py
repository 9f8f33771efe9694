"""What to try next: one rule for each thing that helps, the most urgent first.

Each rule says nothing unless what it suggests betters the mesh; the tests follow every suggestion on gallery meshes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from hexmend.advice.limits import keeping_last, raised_limits
from hexmend.advice.situation import Situation
from hexmend.advice.suggestion import Suggestion
from hexmend.iteration import Outcome, StoppingCriteria
from hexmend.smoothers import METHODS

Mend, SequentialGETMe, SmartLaplacian = METHODS["mend"], METHODS["getme-sequential"], METHODS["smart-laplacian"]

#: Least q(H) from which there is nothing left to gain, and from which the worst hexes need no care of their own.
PERFECT, GOOD = 0.99, 0.9
#: The highest p that is worth its price.
HIGH_P = 16.0

Rule = Callable[[Situation], Suggestion | None]


def unpin(now: Situation) -> Suggestion | None:
    """Pins that hold hexes in inversion."""
    resisting = now.loose[: None if _is_mend(now) and not now.cut_short else 0]
    pins = now.pins_of(np.concatenate([now.locked, resisting]))
    if not pins.size:
        return None
    one = pins.size == 1
    return Suggestion(
        "Unpin, then Mend",
        f"Unpin {'the node' if one else f'the {pins.size:,} nodes'} of inverted hexes that only "
        f"{'a pin holds' if one else 'pins hold'}, then run Mend: it can move {'it' if one else 'them'} then.",
        "inverted",
        Mend(**now.objective),
        unpin=pins,
    )


def untangle(now: Situation) -> Suggestion | None:
    """Inverted hexes that are not locked, left by a method that does not care for them."""
    if not now.loose.size or _is_mend(now):
        return None
    return Suggestion(
        "Mend",
        "Run Mend: it untangles whatever the fixed nodes allow, which no other method does as surely.",
        "inverted",
        Mend(**now.objective),
    )


def slide(now: Situation) -> Suggestion | None:
    """Locked hexes that are free to be mended once the boundary slides."""
    if not now.locked.size or now.result.surface is not None or now.smoother.slides or not now.freed:
        return None
    many = now.locked.size
    which = "The locked hex can" if many == 1 else f"{now.freed:,} of the {many:,} locked hexes can"
    return Suggestion(
        "Mend, boundary slides",
        f"Run Mend with boundary = slide. {which} be freed where nodes of the boundary slide on its surface; where "
        "that is not enough, Mend takes nodes off it within surface_tolerance.",
        "inverted",
        Mend(**now.objective, boundary="slide"),
    )


def undo_harm(now: Situation) -> Suggestion | None:
    """A method that inverted hexes of a sound mesh."""
    if now.result.before.inverted or not now.loose.size:
        return None
    return Suggestion(
        "Smart Laplacian from before the run",
        "Begin again from before the run: no hex was inverted then. Smart Laplacian takes back every "
        "move that would invert one.",
        "inverted",
        SmartLaplacian(),
        undo=True,
    )


def go_on(now: Situation) -> Suggestion | None:
    """An optimiser that was cut short while it still gained."""
    if not now.cut_short or not now.smoother.optimises or (now.loose.size and not _is_mend(now)) or not now.improving:
        return None
    stop, more = raised_limits(now)
    stop, keeping = keeping_last(now, stop)
    gain = "inverted" if now.loose.size else now.aim
    gained = {
        "inverted": "fewer hexes were inverted",
        "objective": "the objective fell",
        "energy": "nodes moved down the energy",
        "q_norm": "the quality rose",
    }
    text = f"Run the same again{more}: it goes on from here, and {gained[gain]} until its last iterations.{keeping}"
    return Suggestion("Go on", text, gain, now.smoother, stop)


def begin_again(now: Situation) -> Suggestion | None:
    """A mend that was cut short on a detour, of which nothing is kept that it could go on from."""
    limited = now.result.outcome in (Outcome.MAX_ITERATIONS, Outcome.MAX_SECONDS)
    detours = _is_mend(now) and (now.smoother.slides or now.smoother.goal != "shape")
    if not (limited and detours) or go_on(now) is not None:
        return None
    stop, more = raised_limits(now)
    return Suggestion(
        "The same from before the run, longer",
        f"Begin the same again from before the run{more}: it was cut short before it had raised the worst corners, and "
        "what comes between is worse for a while, so that going on from here would do that once more.",
        "inverted",
        now.smoother,
        stop,
        undo=True,
    )


def faster(now: Situation) -> Suggestion | None:
    """An optimiser that is too slow for its limit."""
    if not now.cut_short or not now.smoother.optimises or now.loose.size or _is_mend(now) or not now.improving:
        return None
    return Suggestion(
        "Mend",
        f"Run Mend: its Newton steps go to the same optimum as {now.smoother.title} in far fewer iterations.",
        now.aim,
        Mend(**now.objective),
    )


def tighten(now: Situation) -> Suggestion | None:
    """An optimiser that was content early."""
    usual = StoppingCriteria().tolerance
    if now.result.outcome is not Outcome.CONVERGED or not now.smoother.optimises or now.loose.size:
        return None
    if now.stop.tolerance <= usual or not now.improving:
        return None
    stop, keeping = keeping_last(now, replace(now.stop, tolerance=usual))
    return Suggestion(
        "Tighter tolerance",
        f"Run the same again with a tolerance of {usual:g} in place of {now.stop.tolerance:g}: it still gained."
        f"{keeping}",
        now.aim,
        now.smoother,
        stop,
    )


def optimum(now: Situation) -> Suggestion | None:
    """A heuristic, which knows no optimum."""
    heuristic = not now.smoother.optimises and not isinstance(now.smoother, SequentialGETMe)
    if not (heuristic or now.result.outcome is Outcome.SUFFICIENT) or not _sound_below(now, PERFECT):
        return None
    return Suggestion(
        "Mend",
        "Run Mend: it goes on to the optimum of the objective, where the worst hexes gain most; the mean may fall a "
        "little.",
        "objective",
        Mend(**now.objective),
    )


def lift_the_worst(now: Situation) -> Suggestion | None:
    """An optimum whose worst hexes could be better."""
    if not _at_an_optimum(now) or not _sound_below(now, GOOD) or now.max_p >= HIGH_P:
        return None
    return Suggestion(
        "GETMe, sequential",
        "Run sequential GETMe: it lifts the worst hexes one by one and leaves the mean nearly as it is.",
        "q_min",
        SequentialGETMe(),
    )


def raise_p(now: Situation) -> Suggestion | None:
    """An optimum for the mean, where the worst hexes matter more."""
    if not _at_an_optimum(now) or not _sound_below(now, GOOD) or now.max_p >= HIGH_P:
        return None
    return Suggestion(
        f"Mend, p up to {HIGH_P:g}",
        f"Run Mend with p raised up to {HIGH_P:g}: the worst hexes rise at the expense of the mean.",
        "q_min",
        Mend(**now.objective, max_p=HIGH_P),
        StoppingCriteria(max_iterations=max(500, now.stop.max_iterations)),
    )


def guard(now: Situation) -> Suggestion | None:
    """An optimum for which the least quality had to fall."""
    before, after = now.result.before, now.result.after
    if not _is_mend(now) or now.smoother.guard or before.inverted or after.inverted or after.q_min >= before.q_min:
        return None
    return Suggestion(
        "Guarded Mend from before the run",
        f"Begin again from before the run, as q min fell from {before.q_min:.3f} to {after.q_min:.3f}, with Mend's "
        "guard: it keeps the best iterate that lowers neither q min nor the least scaled Jacobian.",
        "q_min",
        replace(now.smoother, guard=True),
        undo=True,
    )


def soften(now: Situation) -> Suggestion | None:
    """A barrier without delta, of which inverted hexes have no gradient."""
    if not now.loose.size or getattr(now.smoother, "delta", None) != 0 or now.smoother.delta_policy != "fixed":
        return None
    usual = type(now.smoother)().delta
    return Suggestion(
        f"δ = {usual:g}",
        f"Run the same with δ = {usual:g}: with δ = 0 the energy of an inverted hex is infinite, and no step descends.",
        "inverted",
        replace(now.smoother, delta=usual),
    )


RULES: tuple[Rule, ...] = (
    unpin, untangle, slide, soften, undo_harm, go_on, begin_again, faster, tighten, guard, optimum, lift_the_worst,
    raise_p,
)  # fmt: skip


def _is_mend(now: Situation) -> bool:
    return isinstance(now.smoother, Mend)


def _sound_below(now: Situation, quality: float) -> bool:
    """Whether no hex is inverted but what is locked, and the worst can still be made better."""
    return not now.loose.size and not now.locked.size and now.result.after.q_min < quality and now.worst_can_move


def _at_an_optimum(now: Situation) -> bool:
    return now.smoother.optimises and now.result.outcome in (Outcome.CONVERGED, Outcome.NO_DESCENT)
