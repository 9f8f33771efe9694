"""What a claim of the thesis is, and how one is judged."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import wraps
from typing import Any, TypeVar

T = TypeVar("T")

#: Whether a claim holds, None where that cannot be judged; and what was measured, or why not, in sentences.
Finding = tuple[bool | None, str]


@dataclass(frozen=True)
class Claim:
    """A claim and what was found.

    Parameters
    ----------
    section : str
        Where the thesis makes it.
    claim : str
        The thesis's, in a sentence.
    reproduced : bool or None
        None where what it needs was not measured.
    figures : str
        What was measured, in a sentence.
    """

    section: str
    claim: str
    reproduced: bool | None
    figures: str

    def record(self) -> dict[str, Any]:
        return asdict(self)


def judges(section: str, claim: str) -> Callable[[Callable[[Sequence[T]], Finding]], Callable[[Sequence[T]], Claim]]:
    """Make a function from what was measured to a `Finding` the judge of a claim."""

    def made(judge: Callable[[Sequence[T]], Finding]) -> Callable[[Sequence[T]], Claim]:
        @wraps(judge)
        def judged(measured: Sequence[T]) -> Claim:
            return Claim(section, claim, *judge(measured))

        return judged

    return made


def tally(cases: Sequence[tuple[bool, str]], otherwise: str, *, most: bool = False) -> Finding:
    """A claim that holds if it holds in every case, or in most of them.

    Parameters
    ----------
    cases : sequence of (held, told)
        Whether it holds in a case, and the case's figures.
    otherwise : str
        Why it is not judged, where there is no case.
    most : bool
        Whether more than half of the cases suffice.

    Examples
    --------
    >>> tally([(True, "a: 1"), (False, "b: 2")], "Nothing ran.")
    (False, 'So in 1 of 2 cases. a: 1. b: 2.')
    """
    if not cases:
        return None, otherwise
    held = sum(holds for holds, _ in cases)
    told = ". ".join(words for _, words in cases)
    return held > len(cases) / 2 if most else held == len(cases), f"So in {held} of {len(cases)} cases. {told}."
