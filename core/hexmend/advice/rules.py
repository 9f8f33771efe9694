"""Rules for suggestions: one for each remedy, the most urgent first.

Each rule says nothing unless what it suggests betters the mesh; the tests follow every suggestion on gallery meshes.

Limits of suggested runs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from hexmend.advice.situation import Situation
from hexmend.advice.suggestion import Suggestion
from hexmend.iteration import Outcome, StoppingCriteria
from hexmend.smoothers import METHODS
from hexmend.smoothers.base_optimiser import Optimiser
from hexmend.terminal_text import count_phrase


def larger_limits(now: Situation) -> tuple[StoppingCriteria, str]:
    """Raise the limit that has ended the run; return all limits and the words for the suggestion."""
    stop = now.stop
    if now.result.outcome is Outcome.MAX_ITERATIONS:
        stop = replace(stop, max_iterations=min(max(2 * stop.limit_of(now.smoother), 100), 1_000_000))
        return stop, f" with a limit of {stop.max_iterations:,} iterations"
    if now.result.outcome is Outcome.MAX_SECONDS:
        stop = replace(stop, max_seconds=min(2 * stop.max_seconds, 1e7))
        return stop, f" with a limit of {stop.max_seconds:g} s"
    return stop, ""


def with_last_kept(now: Situation, stop: StoppingCriteria) -> tuple[StoppingCriteria, str]:
    """Return the limits with `keep_last` for a method that descends, and the sentence for the suggestion.

    Near the optimum the least q(H) varies a little while the objective falls. If it happens to be high at the beginning
    of a run, every later iteration would count as worse, and the mesh would stay as it was.
    """
    if now.result.after.inverted or not isinstance(now.smoother, Optimiser):  # with delta more may be inverted
        return stop, ""
    return replace(stop, keep_last=True), " The last iteration is kept: of all it has the lowest objective."


Mend, SequentialGETMe, SmartLaplacian = METHODS["mend"], METHODS["getme-sequential"], METHODS["smart-laplacian"]

#: Least q(H) above which no method can gain anything.
PERFECT = 0.99

#: Least q(H) above which the worst hexes need no special treatment.
GOOD = 0.9

Rule = Callable[[Situation], Suggestion | None]


def unpin(now: Situation) -> Suggestion | None:
    """Suggest to unpin nodes that keep hexes inverted."""
    pins = now.pinned_nodes
    if not pins.size:
        return None
    nodes, fixed, them = f"{pins.size:,} nodes", "are fixed only by pins", "them"
    if pins.size == 1:
        nodes, fixed, them = "node", "is fixed only by a pin", "it"
    text = f"Unpin the {nodes} of inverted hexes that {fixed}, then run Mend, which can move {them} then."
    return Suggestion("Unpin, then Mend", text, "inverted", Mend(**now.objective), unpin=pins)


def release(now: Situation) -> Suggestion | None:
    """Suggest a run without the rules that fix the nodes of sets, and so keep hexes inverted."""
    names = now.fixing_sets
    if not names:
        return None
    rules = now.mesh.node_rules.rules
    named = " and ".join(f"{name!r}" for name in names)
    text = f"Run Mend without the rule that fixes the nodes of {named} (fix): it keeps hexes inverted."
    left = replace(rules, fix=tuple(name for name in rules.fix if name not in names))
    smoother = Mend(**now.objective, **now.sliding)
    return Suggestion("Mend without the fixed sets", text, "inverted", smoother, rules=left)


def widen(now: Situation) -> Suggestion | None:
    """Suggest a larger part of the mesh for a run whose part ends at inverted hexes."""
    if not now.outside_nodes.size:
        return None
    text = (
        f"Run Mend on a larger part of the mesh: {count_phrase(now.outside_nodes.size, 'node')} of inverted hexes "
        f"{'is' if now.outside_nodes.size == 1 else 'are'} outside of this one."
    )
    return Suggestion("Mend on a larger part", text, "inverted", Mend(**now.objective, **now.sliding), widen=True)


def untangle(now: Situation) -> Suggestion | None:
    """Suggest Mend for invalid hexes that are not locked, after another method."""
    if not now.unlocked.size + now.inside.size or _is_mend(now):
        return None
    text = "Run Mend: it untangles all hexes that the fixed nodes allow, more reliably than other methods."
    return Suggestion("Mend", text, "inverted" if now.unlocked.size else "invalid", Mend(**now.objective))


def slide(now: Situation) -> Suggestion | None:
    """Suggest a sliding boundary for locked hexes that it can free."""
    if not now.locked.size or now.result.surface is not None or now.smoother.slides or not now.freed:
        return None
    if now.fixing_sets or now.outside_nodes.size:  # which are to be released first
        return None
    many = now.locked.size
    which = "The locked hex can" if many == 1 else f"{now.freed:,} of the {many:,} locked hexes can"
    text = (
        f"Run Mend with boundary = slide. {which} be freed where nodes of the boundary slide on its surface; where "
        "that is not enough, Mend moves nodes off it within the surface tolerance."
    )
    return Suggestion("Mend with sliding boundary", text, "inverted", Mend(**now.objective, boundary="slide"))


def slide_near_invalid(now: Situation) -> Suggestion | None:
    """Suggest a sliding boundary for hexes that Mend has left invalid although they are not locked."""
    if not now.slidable_nodes or not _is_mend(now) or now.cut_short or now.smoother.slides or now.can_release:
        return None
    if now.locked.size and now.freed:  # `slide` suggests it
        return None
    nodes = count_phrase(now.slidable_nodes, "fixed node", "fixed nodes")
    where = "" if now.mesh.materials is None else ", on the boundary and on the interfaces between materials"
    text = f"Run Mend with boundary = slide: {nodes} of invalid hexes may slide then{where}."
    gain = "inverted" if now.unlocked.size else "invalid"
    return Suggestion("Mend with sliding boundary", text, gain, Mend(**now.objective, boundary="slide"))


def undo_inversion(now: Situation) -> Suggestion | None:
    """Suggest a safe method after a method that inverted hexes."""
    if now.result.before.inverted or not now.unlocked.size:
        return None
    text = (
        "Undo the run, before which no hex was inverted, and run Smart Laplacian: it rejects every move that would "
        "invert a hex."
    )
    return Suggestion("Undo, then Smart Laplacian", text, "inverted", SmartLaplacian(), undo=True)


def continue_run(now: Situation) -> Suggestion | None:
    """Suggest to continue an optimiser that was ended while it still improved the mesh.

    A run that balances the figures, and has begun to raise the least of them, would begin that again: see
    `restart_longer`.
    """
    if not _still_optimises(now) or (now.unlocked.size and not _is_mend(now)):
        return None
    if now.balances and not (now.unlocked.size or now.at_least_objective):
        return None
    stop, more = larger_limits(now)
    stop, keeping = with_last_kept(now, stop)
    gain = "inverted" if now.unlocked.size else "figures" if now.balances else now.aim
    gained = {
        "inverted": "fewer hexes were inverted",
        "objective": "the objective fell",
        "figures": "the objective fell",
        "energy": "nodes moved down the energy",
        "q_norm": "the quality rose",
    }
    text = f"Run it once more{more}: it continues from here, and {gained[gain]} up to its last iterations.{keeping}"
    return Suggestion("Continue", text, gain, now.smoother, stop)


def resume(now: Situation) -> Suggestion | None:
    """Suggest to continue a run that the user stopped, unless its last iterations were worse than the kept one."""
    result = now.result
    if result.outcome is not Outcome.STOPPED or not result.iterations or result.kept != result.iterations:
        return None
    if continue_run(now) is not None:
        return None
    text = "Run it again: it had not converged when you stopped it, and continues from here."
    return Suggestion("Continue", text, "figures" if now.balances else now.aim, now.smoother, now.stop)


def restart_longer(now: Situation) -> Suggestion | None:
    """Suggest larger limits for Mend if it ended during a phase whose iterations are not kept."""
    limited = now.result.outcome in (Outcome.MAX_ITERATIONS, Outcome.MAX_SECONDS)
    if not (limited and _detours(now)) or continue_run(now) is not None:
        return None
    stop, more = larger_limits(now)
    text = (
        f"Undo the run and repeat it{more}: it ended before the worst corners had improved. The method "
        "makes the mesh worse before it improves it, and a run from here would do so again."
    )
    return Suggestion("Undo, then the same with larger limits", text, "inverted", now.smoother, stop, undo=True)


def suggest_newton(now: Situation) -> Suggestion | None:
    """Suggest Mend for a slower optimiser that reached its limit."""
    if not _still_optimises(now) or now.unlocked.size or _is_mend(now):
        return None
    text = (
        f"Run Mend with goal = shape: its Newton steps reach the same optimum as {now.smoother.title} in far fewer "
        "iterations."
    )
    return Suggestion("Mend, goal = shape", text, now.aim, Mend(**{**now.objective, "goal": "shape"}))


def optimum(now: Situation) -> Suggestion | None:
    """Suggest Mend after a heuristic."""
    heuristic = not now.smoother.optimises and not isinstance(now.smoother, SequentialGETMe)
    if not (heuristic or now.result.outcome is Outcome.SUFFICIENT) or not _sound_below(now, PERFECT):
        return None
    text = "Run Mend: it raises q min, q mean and the minimum scaled Jacobian together; none of them falls."
    return Suggestion("Mend", text, "figures", Mend(**now.objective))


def improve_worst(now: Situation) -> Suggestion | None:
    """Suggest a method for the worst hexes of an optimised mesh."""
    at_optimum = now.smoother.optimises and now.result.outcome in (Outcome.CONVERGED, Outcome.NO_DESCENT)
    if not at_optimum or not _sound_below(now, GOOD):
        return None
    text = "Run sequential GETMe: it improves the worst hexes one by one and hardly changes the mean."
    return Suggestion("GETMe, sequential", text, "q_min", SequentialGETMe())


RULES: tuple[Rule, ...] = (
    unpin,
    release,
    widen,
    untangle,
    slide,
    slide_near_invalid,
    undo_inversion,
    continue_run,
    resume,
    restart_longer,
    suggest_newton,
    optimum,
    improve_worst,
)


def _is_mend(now: Situation) -> bool:
    return isinstance(now.smoother, Mend)


def _detours(now: Situation) -> bool:
    """Return True if the mesh may be worse for a while before the run ends."""
    return _is_mend(now) and (now.smoother.slides or now.smoother.goal != "shape")


def _sound_below(now: Situation, quality: float) -> bool:
    """Return True if no hex is invalid and the worst one, below this quality, has a free node."""
    invalid = now.locked.size + now.unlocked.size + now.inside.size
    return not invalid and now.result.after.q_min < quality and now.worst_can_move


def _still_optimises(now: Situation) -> bool:
    return now.cut_short and now.smoother.optimises and now.improving
