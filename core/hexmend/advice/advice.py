"""The explanation of a run that ended."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.advice.rules import RULES
from hexmend.advice.situation import Situation
from hexmend.advice.suggestion import Suggestion
from hexmend.iteration import Outcome, Result
from hexmend.layers import describe_losses
from hexmend.quality import describe_regressions
from hexmend.run.messages import kept_message
from hexmend.terminal_text import count_phrase


@dataclass(frozen=True, eq=False)
class Advice:
    """Explanation of a run that ended.

    Parameters
    ----------
    reason : str
        Reason of the end, as sentences, with the iteration that was kept if it is not the last.
    state : str
        State of the mesh after the run, as sentences.
    regressions : str
        Figures that are worse than before the run, as a sentence; may be empty.
    locked, unlocked : (k,) int64
        Numbers, from 0, of the inverted hexes that no move of free nodes can repair, and of the other inverted ones.
    surface : str
        Change of the boundary, as a sentence; empty if no method let it slide.
    limiting, locked_below : (k,) int64
        Hexes whose corners prevent the minimum scaled Jacobian (or time step) from rising further, and hexes with a
        lower corner whose nodes are all fixed.
    suggestions : tuple of Suggestion
        The most urgent first; may be empty.
    no_suggestion : str
        Text for the place of suggestions if there is none; empty after a run without an iteration.
    """

    reason: str
    state: str
    regressions: str
    locked: np.ndarray
    unlocked: np.ndarray
    surface: str
    limiting: np.ndarray
    locked_below: np.ndarray
    suggestions: tuple[Suggestion, ...]
    no_suggestion: str


def advise(result: Result, outside: np.ndarray | None = None) -> Advice:
    """Explain a run that ended.

    Parameters
    ----------
    result : Result
    outside : (n,) bool, optional
        Nodes pinned for this run alone, outside of the part of the mesh to which it was limited.

    Returns
    -------
    Advice
    """
    now = Situation(result, outside)
    suggestions = [suggestion for rule in RULES if (suggestion := rule(now)) is not None]
    if result.outcome is Outcome.NOTHING_FREE:
        suggestions = [one for one in suggestions if one.releases]
    untried = result.outcome is Outcome.STOPPED and not result.iterations
    worse = describe_regressions(result.before, result.after, result.target_q), describe_losses(result.layers)
    limits, none = result.active, np.empty(0, dtype=np.int64)
    return Advice(
        reason=_reason(now),
        state=_state(now),
        regressions=" ".join(filter(None, worse)),
        locked=now.locked,
        unlocked=now.unlocked,
        surface=result.surface_sentence,
        limiting=none if limits is None else np.unique(limits.hexes),
        locked_below=none if limits is None else limits.locked[~now.quality.inverted[limits.locked]],
        suggestions=tuple(suggestions),
        no_suggestion="" if untried else "No further suggestions.",
    )


def _reason(now: Situation) -> str:
    several = len({stage.stage for stage in now.result.stages}) > 1
    reason = f"The last stage, {now.smoother.title}: {_end(now)}" if several else _end(now)
    return reason if now.result.kept == now.result.iterations else f"{reason} {kept_message(now.result.kept)}"


def _end(now: Situation) -> str:
    result, stop = now.result, now.stop
    move = result.history[-1]["largest_move"]
    still = f" The last one still moved a node by {move:.2g} mean edge lengths." if move > stop.tolerance else ""
    stage = result.stages[-1].stage
    many = sum(one.iterations for one in result.stages if one.stage == stage)
    count = count_phrase(many, "iteration")
    if result.outcome is Outcome.CONVERGED and many:
        return (
            f"Converged: in the last of {count} no node moved further than {stop.tolerance:g} mean edge lengths."
            if move < stop.tolerance
            else f"Converged after {count}: a further step would gain less than the rounding error."
        )
    if result.outcome is Outcome.MAX_ITERATIONS:
        return f"Stopped at the limit of {count_phrase(many, 'iteration')} before it converged.{still}"
    if result.outcome is Outcome.MAX_SECONDS:
        return f"Stopped at the limit of {stop.max_seconds:g} s, after {count}, before it converged.{still}"
    if result.outcome is Outcome.STOPPED and not result.iterations:
        return "Stopped by you before its first iteration: no node has moved. Press Run to start again."
    if result.outcome is Outcome.STOPPED:
        return f"Stopped by you after {count}.{still}"
    return result.outcome.value


def _state(now: Situation) -> str:
    """Describe the invalid hexes and why they are inverted; else the quality of the worst hex."""
    before, after = now.result.before, now.result.after
    if not after.inverted:
        done = " This is close to the best possible." if after.q_min >= 0.99 else ""
        mended = f" {count_phrase(before.inverted, 'was', 'were')} inverted at the start." if before.inverted else ""
        least = f"{after.q_min:.3f}"
        if now.result.active is not None:
            least += f", the minimum scaled Jacobian is {after.scaled_jacobian_min:.4f}"
        if after.invalid:
            inside = count_phrase(after.invalid, "hex is", "hexes are")
            return f"No hex is inverted, but {inside} invalid inside; the worst has q = {least}.{mended}"
        return f"No hex is invalid; the worst has q = {least}.{mended}{done}"
    hexes = f"of {count_phrase(after.hexes, 'hex', 'hexes')}"
    words = [f"{count_phrase(after.inverted, f'{hexes} is', f'{hexes} are')} inverted."]
    if before.inverted != after.inverted:
        earlier = count_phrase(before.inverted, "was", "were") if before.inverted else "None was"
        words.append(f"{earlier} at the start.")
    if now.locked.size:
        words.append(_locked(now))
    return " ".join(words)


#: Advice to lay a layer of hexes, as a part of a sentence.
_PAD = ", or keep it and insert a layer of hexes under it (Pad, hexmend pad)"


def _locked(now: Situation) -> str:
    many = now.locked.size
    them = "it" if many == 1 else "them"
    which = count_phrase(many, "of them is", "of them are")
    if many == now.result.after.inverted:
        which = "It is" if many == 1 else "All of them are"
    if now.fixing_sets or now.outside_nodes.size:  # suggestions say how to release these
        return f"{which} locked: fixed nodes alone keep {them} inverted."
    if now.result.surface is not None:
        rest = f" where the boundary is fixed, and sliding has not freed these{' so far' * now.cut_short}."
        remedy = "" if now.cut_short else f" Correct the boundary where the mesh was made{_PAD}."
    elif now.freed:
        others = f", {many - now.freed:,} cannot" if now.freed < many else ""
        rest = ", and no method moves these unless the boundary slides: "
        rest += f"then {now.freed:,} can be freed by sliding alone{others}."
        remedy = f" Let it slide (boundary = slide), or correct it where the mesh was made{_PAD}."
    else:
        rest = f", and sliding alone does not free {them}."
        remedy = (
            f" Correct the boundary where the mesh was made{_PAD}, or try mend with boundary = slide: it also moves"
        )
        remedy += " nodes off the surface within the tolerance."
    text = f"{which} locked: fixed nodes alone keep {them} inverted{rest}"
    return text if now.pinned_nodes.size else text + remedy
