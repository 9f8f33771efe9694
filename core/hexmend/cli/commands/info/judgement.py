"""Judgement of a mesh by `hexmend info`: whether it is fit for solving, and the next command."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from hexmend.doctor import Finding
from hexmend.quality import METRICS, ElementQuality
from hexmend.terminal_text import count_phrase

if TYPE_CHECKING:
    from hexmend.locking import Locking
    from hexmend.solver_checks import Report


#: Conditions of a fit mesh by the problem that it has.
_CONDITIONS = {"parts": "its parts need not be connected", "unused-nodes": "its unused nodes may stay"}


@dataclass(frozen=True)
class Judgement:
    """Judgement of a mesh by its hexes.

    Parameters
    ----------
    fit : bool
        True if no hex is invalid, at its corners or between them, the doctor finds no problem but those in
        `_CONDITIONS`, and no check of the user's solver fails.
    sentence : str
    command : str
        The next command as a line for the shell; "" if none helps.
    """

    fit: bool
    sentence: str
    command: str

    @classmethod
    def of(
        cls,
        path: str,
        quality: ElementQuality,
        locking: Locking | None,
        findings: Sequence[Finding],
        checks: Report | None = None,
        *,
        words: tuple[str, str] = ("hex", "hexes"),
    ) -> Judgement:
        """Judge a mesh.

        Parameters
        ----------
        path : str
            Its file, for the command.
        quality : ElementQuality
        locking : Locking or None
        findings : sequence of Finding
        checks : Report, optional
            Checks of the user's solver.
        words : (str, str)
            Words for one of its cells and for several.
        """
        total, inverted = quality.inverted.size, int(np.count_nonzero(quality.inverted))
        later = ["mid-nodes"] if inverted else []  # which follow the corners when these are untangled
        later += _CONDITIONS
        if repairable := _kinds(finding for finding in findings if finding.mendable and finding.kind not in later):
            return cls(False, f"To be repaired before solving: {repairable}.", _command("repair", path))
        if inverted:
            verb = "is" if inverted == 1 else "are"
            sentence = f"Not fit for solving: {inverted:,} of {count_phrase(total, *words)} {verb} inverted."
            return cls(False, sentence, _untangling(path, quality, locking))
        if invalid := quality.n_invalid:
            counted = f"{invalid:,} of {count_phrase(total, *words)} {'is' if invalid == 1 else 'are'}"
            undecided = f" ({quality.n_undecided:,} of them undecided)" if quality.n_undecided else ""
            sentence = f"Not fit for solving: {counted} invalid inside, between positive corners{undecided}."
            is_bent = any(finding.kind == "mid-nodes" for finding in findings)
            return cls(False, sentence, shlex.join(["hexmend", path]) if is_bent else _command("smooth", path))
        if faults := [finding for finding in findings if finding.kind not in _CONDITIONS]:
            return cls(False, f"Not fit for solving: {_kinds(faults)}.", shlex.join(["hexmend", path]))
        if checks is not None and checks.verdict == "failed":
            return cls(False, f"Not fit for solving. {checks.sentence}", _command("smooth", path))
        conditions = [_CONDITIONS[finding.kind] for finding in findings]
        condition = f"if {' and '.join(conditions)}" if conditions else ""
        limit, _ = METRICS["scaled-jacobian"].acceptable
        poor = int(np.count_nonzero(quality.scaled_jacobian < limit))
        if poor:
            counted = f"{poor:,} of {count_phrase(total, *words)} {'has' if poor == 1 else 'have'}"
            but = f"but poor, and only {condition}" if condition else "but poor"
            sentence = f"Fit for solving, {but}: {counted} a scaled Jacobian below {limit:g}."
            return cls(True, sentence, _command("smooth", path))
        fit = f"Fit for solving, {condition}" if condition else "Fit for solving"
        sentence = f"{fit}: no {words[0]} is invalid or has a scaled Jacobian below {limit:g}."
        return cls(True, sentence, shlex.join(["hexmend", path]))

    @property
    def line(self) -> str:
        """The sentence and the command as one line."""
        return f"{self.sentence} Next: {self.command}" if self.command else self.sentence

    def to_dict(self) -> dict[str, object]:
        """Return the judgement as data for JSON; `next` is None where no command helps."""
        return {"fit": self.fit, "judgement": self.sentence, "next": self.command or None}


def _untangling(path: str, quality: ElementQuality, locking: Locking | None) -> str:
    """Return the command for inverted hexes: sliding or a layer where all of them are locked by the boundary."""
    if locking is None or not np.isin(np.flatnonzero(quality.inverted), locking.hexes).all():
        return _command("smooth", path)
    if locking.undecided.any():
        return _command("smooth", path, "--boundary", "slide")
    return _command("pad", path) if locking.needs_layer.any() else ""


def _command(name: str, path: str, *options: str) -> str:
    return shlex.join(["hexmend", name, path, "-o", "OUT", *options])


def _kinds(findings: Iterable[Finding]) -> str:
    return ", ".join(finding.kind.replace("-", " ") for finding in findings)
