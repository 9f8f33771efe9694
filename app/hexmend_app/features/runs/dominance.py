"""Dominance of results: one is as good as another in every key figure, and better in one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from hexmend.quality.summary import SUMMARY_QUANTITIES

#: Figures that are compared.
KEY_FIGURES = ("inverted", "invalid", "q_min", "q_mean", "scaled_jacobian_min")

#: Largest difference by rounding alone.
_ROUNDING = 1e-12


def dominates(one: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    """Return True if a result is as good as another one in all of `KEY_FIGURES`, and better in at least one.

    Parameters
    ----------
    one, other : mapping of str to number
        Values of the figures, such as `Summary.to_dict` returns.

    Examples
    --------
    >>> given = {"inverted": 0, "invalid": 0, "q_min": 0.4, "q_mean": 0.89, "scaled_jacobian_min": 0.2}
    >>> dominates(given | {"q_min": 0.5}, given), dominates(given | {"q_min": 0.5, "q_mean": 0.8}, given)
    (True, False)
    """
    gains = [SUMMARY_QUANTITIES[key].better * (one[key] - other[key]) for key in KEY_FIGURES]
    return min(gains) >= -_ROUNDING and max(gains) > _ROUNDING


def dominating(results: Sequence[Mapping[str, Any]]) -> list[list[int]]:
    """Return for each result the positions of the results that dominate it.

    >>> figures = {"inverted": 0, "invalid": 0, "q_min": 0.4, "q_mean": 0.89, "scaled_jacobian_min": 0.2}
    >>> dominating([figures, figures | {"inverted": 2}, figures | {"q_min": 0.5, "q_mean": 0.8}])
    [[], [0], []]
    """
    return [[at for at, one in enumerate(results) if dominates(one, other)] for other in results]
