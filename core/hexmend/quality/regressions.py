"""Regressions: quantities of a mesh that are worse than before."""

from __future__ import annotations

from hexmend.quality.summary import SUMMARY_QUANTITIES, Summary

#: Quantities that must not become worse: name in reports, and key in `Summary`.
REGRESSION_KEYS = {
    "inverted": "inverted",
    "invalid": "invalid",
    "q_min": "q_min",
    "scaled_jacobian": "scaled_jacobian_min",
}

#: Difference of q and scaled Jacobian, whose range is 1, from which on a value counts as worse: the last digits of a
#: result depend on the tolerance of the run and on rounding.
WORSE_BY = 1e-7

#: Name of the least q of target in reports, which takes the place of "q_min" where hexes are not to be cubes.
Q_OF_TARGET = "q_of_target"


def regressions(before: Summary, after: Summary, target_q: tuple[float, float] | None = None) -> tuple[str, ...]:
    """Return the names in `REGRESSION_KEYS` of the quantities that are worse by more than `WORSE_BY`, in that order.

    Parameters
    ----------
    before, after : Summary
    target_q : (float, float), optional
        Least q of target before and after, of a run with a target: it is compared in place of q min, and named
        `Q_OF_TARGET`.

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> import dataclasses
    >>> from hexmend.gallery import make
    >>> from hexmend.quality import summarise
    >>> before = summarise(make("five-side", size=500))
    >>> regressions(before, dataclasses.replace(before, inverted=2, q_mean=0.0, q_min=0.9))
    ('inverted',)
    """
    names = [
        name
        for name, key in REGRESSION_KEYS.items()
        if SUMMARY_QUANTITIES[key].better * (getattr(after, key) - getattr(before, key)) < -WORSE_BY
    ]
    if target_q is not None:
        names = [name for name in names if name != "q_min"]
        names += [Q_OF_TARGET] * (target_q[1] - target_q[0] < -WORSE_BY)
    return tuple(names)


def describe_regressions(before: Summary, after: Summary, target_q: tuple[float, float] | None = None) -> str:
    """Describe the regressions of a mesh as a sentence; "" if there are none.

    Parameters
    ----------
    before, after, target_q
        See `regressions`.

    Returns
    -------
    str

    Examples
    --------
    >>> import dataclasses
    >>> from hexmend.gallery import make
    >>> from hexmend.quality import summarise
    >>> before = dataclasses.replace(summarise(make("cube", size=8)), q_min=0.40351)
    >>> describe_regressions(before, dataclasses.replace(before, inverted=4, q_min=0.40349))
    'Worse than at the start: inverted 0 → 4, q min 0.40351 → 0.40349.'
    """
    names = regressions(before, after, target_q)
    keys = [REGRESSION_KEYS[name] for name in names if name != Q_OF_TARGET]
    changes = [f"{SUMMARY_QUANTITIES[key].label} {_change(getattr(before, key), getattr(after, key))}" for key in keys]
    if target_q is not None and Q_OF_TARGET in names:
        changes.append(f"q of target min {_change(*target_q)}")
    return f"Worse than at the start: {', '.join(changes)}." if changes else ""


def _change(was: float, now: float) -> str:
    """Both values, with at least four decimals, and as many as distinguish them."""
    if isinstance(was, int):
        return f"{was:,} → {now:,}"
    digits = next((digits for digits in range(4, 17) if f"{was:.{digits}f}" != f"{now:.{digits}f}"), 17)
    return f"{was:.{digits}f} → {now:.{digits}f}"
