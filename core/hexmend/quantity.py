"""What a figure of a mesh or of a run declares of itself: what it is called, how it is written, which way is better."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Quantity:
    """A figure; every table, form and chart that shows it takes its words from here.

    Parameters
    ----------
    key : str
        Its name in records.
    label : str
        As it stands in the middle of a line, such as a table's.
    help : str
        What it is, in sentences.
    text : callable
        How its value is written.
    better : int
        1 where higher values are better, -1 where lower ones are, 0 where neither is.
    part_of : str
        The key of the figure that it is a part of; "" for none.
    """

    key: str
    label: str
    help: str
    text: Callable[[Any], str]
    better: int = 0
    part_of: str = ""

    @property
    def title(self) -> str:
        """The label as it begins a line.

        >>> [Quantity("", label, "", format_count).title for label in ("free nodes", "q min", "µs per node")]
        ['Free nodes', 'q min', 'µs per node']
        """
        first = self.label.split()[0]
        return self.label if len(first) < 3 else self.label[0].upper() + self.label[1:]

    def of(self, record: Mapping[str, Any]) -> str:
        """The text of the figure in a record, a dash where there is none or it is infinite."""
        value = record.get(self.key)
        return "–" if value is None else self.text(value)


def format_count(value: int) -> str:
    """
    >>> format_count(31760)
    '31,760'
    """
    return f"{value:,}"


def format_quality(value: float) -> str:
    """
    >>> format_quality(0.56741)
    '0.5674'
    """
    return f"{value:.4f}"


def format_significant(value: float, digits: int = 4) -> str:
    """So many significant figures, never with an exponent.

    >>> [format_significant(value) for value in (0.0012345, 19.522, 83960.9, 0)]
    ['0.001234', '19.52', '83,960', '0']
    """
    return f"{float(f'{value:.{digits}g}'):,.10f}".rstrip("0").rstrip(".")


def format_objective(value: float) -> str:
    """With the digits in which two optima may differ.

    >>> format_objective(157.80185041)
    '157.8019'
    """
    return format_significant(value, digits=7)


def format_milliseconds(seconds: float) -> str:
    """Seconds as milliseconds.

    >>> format_milliseconds(0.01463)
    '14.63'
    """
    return format_significant(seconds * 1e3)


def format_microseconds(seconds: float) -> str:
    """Seconds as microseconds.

    >>> format_microseconds(6.755e-4)
    '675.5'
    """
    return format_significant(seconds * 1e6)
