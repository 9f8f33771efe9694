"""A run that ended, explained."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.advice.rules import RULES
from hexmend.advice.situation import Situation
from hexmend.advice.suggestion import Suggestion
from hexmend.iteration import Outcome, Result
from hexmend.quality import describe_regressions
from hexmend.run.messages import kept_message


@dataclass(frozen=True, eq=False)
class Advice:
    """Why a run ended and what to do.

    Parameters
    ----------
    why : str
        The outcome, as sentences, and which iteration is kept if not the last.
    left : str
        What the run left, as sentences.
    worse : str
        In what that is worse than what the run was given, as a sentence; "" where it is not.
    locked, loose : (k,) int64
        Numbers, from 0, of the inverted hexes that fixed nodes hold in inversion, and of the other inverted ones.
    surface : str
        How far its boundary is from where it was, as a sentence; "" where no method let it slide.
    limiting, held : (k,) int64
        Hexes whose corners let the least rise no further, in one place or in several, and those with a corner that is
        lower yet, whose nodes are all fixed.
    suggestions : tuple of Suggestion
        The most urgent first; empty where nothing is known to help.
    nothing : str
        What to say where there is no suggestion; "" where nothing can be said, as nothing was tried.
    """

    why: str
    left: str
    worse: str
    locked: np.ndarray
    loose: np.ndarray
    surface: str
    limiting: np.ndarray
    held: np.ndarray
    suggestions: tuple[Suggestion, ...]
    nothing: str


def advise(result: Result) -> Advice:
    """Explain a run that ended."""
    now = Situation(result)
    told = [suggestion for rule in RULES if (suggestion := rule(now)) is not None]
    if result.outcome is Outcome.NOTHING_FREE:
        told = [one for one in told if one.unpin.size]
    untried = result.outcome is Outcome.STOPPED and not result.iterations
    nothing = "" if untried else "Nothing is known that would better this mesh."
    fallen = describe_regressions(result.before, result.after)
    limits, none = result.limits, np.empty(0, dtype=np.int64)
    return Advice(
        why=_why(now),
        left=_left(now),
        worse=fallen,
        locked=now.locked,
        loose=now.loose,
        surface="" if result.surface is None else result.surface.sentence,
        limiting=none if limits is None else np.unique(limits.hexes),
        held=none if limits is None else limits.locked[~now.figures.inverted[limits.locked]],
        suggestions=tuple(told),
        nothing=nothing,
    )


def _why(now: Situation) -> str:
    several = len({stage.stage for stage in now.result.stages}) > 1
    why = f"The last stage, {now.smoother.title}: {_end(now)}" if several else _end(now)
    return why if now.result.kept == now.result.iterations else f"{why} {kept_message(now.result.kept)}"


def _end(now: Situation) -> str:
    result, stop = now.result, now.stop
    move = result.history[-1]["largest_move"]
    still = f" The last one still moved a node by {move:.2g} mean edge lengths." if move > stop.tolerance else ""
    stage = result.stages[-1].stage
    many = sum(one.iterations for one in result.stages if one.stage == stage)
    count = f"{many:,} iteration{'s' * (many != 1)}"
    if result.outcome is Outcome.CONVERGED and many:
        return (
            f"Converged: in the last of {count} no node moved further than {stop.tolerance:g} mean edge lengths."
            if move < stop.tolerance
            else f"Converged after {count}: what another step could gain is less than rounding."
        )
    if result.outcome is Outcome.MAX_ITERATIONS:
        return f"Stopped at the limit of {stop.max_iterations:,} iterations before it converged.{still}"
    if result.outcome is Outcome.MAX_SECONDS:
        return f"Stopped at the limit of {stop.max_seconds:g} s, after {count}, before it converged.{still}"
    if result.outcome is Outcome.STOPPED and not result.iterations:
        return "Stopped by you before its first iteration: no node has moved. Run begins again."
    if result.outcome is Outcome.STOPPED:
        return f"Stopped by you after {count}.{still}"
    return result.outcome.value


def _left(now: Situation) -> str:
    """What is inverted, and by whose fault; else how good the worst hex is."""
    before, after = now.result.before, now.result.after
    if not after.inverted:
        done = " It can hardly be better." if after.q_min >= 0.99 else ""
        count = before.inverted
        mended = f" {count:,} {'was' if count == 1 else 'were'} inverted at the start." if count else ""
        least = f"{after.q_min:.3f}"
        if now.result.limits is not None:
            least += f", the least scaled Jacobian is {after.scaled_jacobian_min:.4f}"
        return f"No hex is inverted; the worst has q = {least}.{mended}{done}"
    words = [f"{after.inverted:,} of {after.hexes:,} hexes {'is' if after.inverted == 1 else 'are'} inverted."]
    if before.inverted != after.inverted:
        words.append(f"{_inverted(before.inverted)} at the start.")
    if now.locked.size:
        words.append(_locked(now))
    return " ".join(words)


def _inverted(count: int) -> str:
    return f"{count:,} {'was' if count == 1 else 'were'}" if count else "None was"


def _locked(now: Situation) -> str:
    many, one = now.locked.size, now.locked.size == 1
    every = many == now.result.after.inverted
    which = ("It is" if one else "All of them are") if every else f"{many:,} of them {'is' if one else 'are'}"
    said = f"{which} locked: fixed nodes alone hold {'it' if one else 'them'} in inversion"
    if now.result.surface is None:
        freed = now.freed
        if not freed:
            said += f", and sliding alone does not free {'it' if one else 'them'}."
            remedy = " Correct the boundary where the mesh was made, or try mend with boundary = slide:"
            remedy += " it also takes nodes off the surface within its tolerance."
        else:
            said += ", and no method moves these unless the boundary slides: "
            rest = f", {many - freed:,} cannot" if freed < many else ""
            said += f"then {freed:,} can be freed by sliding alone{rest}."
            remedy = " Let it slide (boundary = slide), or correct it where the mesh was made."
    else:
        said += f" where the boundary is fixed, and sliding has not freed these{' so far' * now.cut_short}."
        remedy = "" if now.cut_short else " Correct the boundary where the mesh was made."
    if not now.pins_of(now.locked).size:
        said += remedy
    return said
