"""In what a mesh is worse than it was, of the figures that analysts judge it by."""

from __future__ import annotations

from hexmend.quality.summary import SUMMARY_QUANTITIES, Summary

#: The figures by the names that reports use, and their keys in a summary.
REGRESSION_KEYS = {"inverted": "inverted", "q_min": "q_min", "scaled_jacobian": "scaled_jacobian_min"}

#: What a figure may differ by from rounding alone, as where a perfect grid is smoothed.
_ROUNDING = 1e-12


def regressions(before: Summary, after: Summary) -> tuple[str, ...]:
    """The names in `REGRESSION_KEYS` of the figures that are worse, in that order.

    Examples
    --------
    >>> import dataclasses
    >>> from hexmend.gallery import make
    >>> from hexmend.quality import summarise
    >>> before = summarise(make("five-side", size=500))
    >>> regressions(before, dataclasses.replace(before, inverted=2, q_mean=0.0, q_min=0.9))
    ('inverted',)
    """
    return tuple(
        name
        for name, key in REGRESSION_KEYS.items()
        if SUMMARY_QUANTITIES[key].better * (getattr(after, key) - getattr(before, key)) < -_ROUNDING
    )


def describe_regressions(before: Summary, after: Summary) -> str:
    """The same as a sentence; "" where nothing is worse.

    Examples
    --------
    >>> import dataclasses
    >>> from hexmend.gallery import make
    >>> from hexmend.quality import summarise
    >>> before = dataclasses.replace(summarise(make("cube", size=8)), q_min=0.40351)
    >>> describe_regressions(before, dataclasses.replace(before, inverted=4, q_min=0.40349))
    'Worse than at the start: inverted 0 → 4, q min 0.40351 → 0.40349.'
    """
    keys = [REGRESSION_KEYS[name] for name in regressions(before, after)]
    falls = [f"{SUMMARY_QUANTITIES[key].label} {_apart(getattr(before, key), getattr(after, key))}" for key in keys]
    return f"Worse than at the start: {', '.join(falls)}." if falls else ""


def _apart(was: float, now: float) -> str:
    """Both values, with as many decimals, four at least, as tell them apart."""
    if isinstance(was, int):
        return f"{was:,} → {now:,}"
    digits = next((digits for digits in range(4, 17) if f"{was:.{digits}f}" != f"{now:.{digits}f}"), 17)
    return f"{was:.{digits}f} → {now:.{digits}f}"
