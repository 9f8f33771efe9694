"""Sets of numbers as texts of ranges, such as "0-120, 130"."""

from __future__ import annotations

import re

import numpy as np


def ranges_text(mask: np.ndarray) -> str:
    """Return the numbers that a mask, (m,) bool, marks, as text.

    >>> ranges_text(np.array([True, True, True, False, True]))
    '0-2, 4'
    """
    ends = np.flatnonzero(np.diff(mask, prepend=False, append=False)).reshape(-1, 2)
    ranges = ((int(first), int(end) - 1) for first, end in ends)
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in ranges)


def parse_ranges(text: str) -> tuple[tuple[int, int], ...]:
    """Return the first and last number of each range of a text, ascending.

    Raises
    ------
    ValueError
        If the text is not a list of ascending ranges.

    >>> parse_ranges("0-2, 4")
    ((0, 2), (4, 4))
    """
    ranges, previous = [], -1
    for part in text.split(","):
        match = re.fullmatch(r"\s*([0-9]{1,10})(?:-([0-9]{1,10}))?\s*", part)
        if match is None:
            raise ValueError(f"{part.strip()[:40]!r} is not a range of numbers: expected, for example, 0-120, 130")
        first, last = int(match[1]), int(match[2] or match[1])
        if not previous < first <= last:
            raise ValueError(f"hexes {first} to {last} follow {previous}: expected ascending ranges")
        ranges.append((first, last))
        previous = last
    return tuple(ranges)


def mask_of(ranges: tuple[tuple[int, int], ...], count: int) -> np.ndarray:
    """Return True for the numbers below a count that ranges contain, (count,) bool."""
    mask = np.zeros(count, dtype=bool)
    for first, last in ranges:
        mask[first : last + 1] = True
    return mask
