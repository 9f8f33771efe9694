"""Claims of the thesis and their judgement by measured figures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import wraps
from types import ModuleType
from typing import Any, TypeVar

T = TypeVar("T")

#: True if a claim holds, None if that cannot be judged; and the measured figures, or the reason why there are none.
Finding = tuple[bool | None, str]


@dataclass(frozen=True)
class Claim:
    """Claim of the thesis with its judgement.

    Parameters
    ----------
    section : str
        Section of the thesis.
    claim : str
        The claim in a sentence.
    reproduced : bool or None
        None if the figures that it needs were not measured.
    figures : str
        The measured figures in a sentence.
    """

    section: str
    claim: str
    reproduced: bool | None
    figures: str

    def record(self) -> dict[str, Any]:
        """Return the fields for JSON."""
        return asdict(self)


Judge = Callable[[Sequence[T]], Finding]

#: All functions that `claim` has decorated, in the order of their modules' lines.
_DECLARED: list[Callable[..., Claim]] = []


def claim(section: str, sentence: str) -> Callable[[Judge[T]], Callable[[Sequence[T]], Claim]]:
    """Decorator: turn a function from results to a `Finding` into one from results to a `Claim`.

    Parameters
    ----------
    section : str
        Section of the thesis.
    sentence : str
        The claim.
    """

    def decorate(judge: Judge[T]) -> Callable[[Sequence[T]], Claim]:
        @wraps(judge)
        def judged(results: Sequence[T]) -> Claim:
            return Claim(section, sentence, *judge(results))

        _DECLARED.append(judged)
        return judged

    return decorate


def claims_of(*modules: ModuleType) -> tuple[Callable[..., Claim], ...]:
    """Return the claims that modules declare, in the order of the modules and of their lines."""
    return tuple(one for module in modules for one in _DECLARED if one.__module__ == module.__name__)


def tally(cases: Sequence[tuple[bool, str]], otherwise: str, *, most: bool = False) -> Finding:
    """Judge a claim that holds if it holds in all cases, or in most of them.

    Parameters
    ----------
    cases : sequence of (bool, str)
        True if it holds in a case, and the figures of the case.
    otherwise : str
        Reason why it is not judged, if there is no case.
    most : bool
        More than half of the cases suffice.

    Returns
    -------
    Finding

    Examples
    --------
    >>> tally([(True, "a: 1"), (False, "b: 2")], "Nothing ran.")
    (False, 'So in 1 of 2 cases. a: 1. b: 2.')
    """
    if not cases:
        return None, otherwise
    count = sum(holds for holds, _ in cases)
    details = ". ".join(text for _, text in cases)
    return count > len(cases) / 2 if most else count == len(cases), f"So in {count} of {len(cases)} cases. {details}."
