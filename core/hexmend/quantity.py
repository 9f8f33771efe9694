"""Declared quantities of meshes and runs, and formatting of their values."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Quantity:
    """Declaration of a quantity, used by every table, form and chart that shows it.

    Parameters
    ----------
    key : str
        Name in records.
    label : str
        Name in running text and tables.
    help : str
        Description in sentences.
    text : callable
        Function that formats a value.
    better : int
        1 if higher values are better, -1 if lower ones are, 0 if neither.
    part_of : str
        Key of the quantity of which it is a part; "" for none.
    """

    key: str
    label: str
    help: str
    text: Callable[[Any], str]
    better: int = 0
    part_of: str = ""

    @property
    def title(self) -> str:
        """Label with a capital at the beginning of a line.

        >>> [Quantity("", label, "", format_count).title for label in ("free nodes", "q min", "µs per node")]
        ['Free nodes', 'q min', 'µs per node']
        """
        first = self.label.split()[0]
        return self.label if len(first) < 3 else self.label[0].upper() + self.label[1:]

    def of(self, record: Mapping[str, Any]) -> str:
        """Format the value in a record; a dash stands for a missing or infinite one."""
        value = record.get(self.key)
        return "–" if value is None else self.text(value)


def format_count(value: int) -> str:
    """Format a whole number with separators of thousands.

    >>> format_count(31760)
    '31,760'
    """
    return f"{value:,}"


def format_quality(value: float) -> str:
    """Format a quality with four decimals.

    >>> format_quality(0.56741)
    '0.5674'
    """
    return f"{value:.4f}"


def format_significant(value: float, digits: int = 4) -> str:
    """Format a number with some significant digits, never with an exponent.

    >>> [format_significant(value) for value in (0.0012345, 19.522, 83960.9, 0)]
    ['0.001234', '19.52', '83,960', '0']
    """
    return f"{float(f'{value:.{digits}g}'):,.10f}".rstrip("0").rstrip(".")


def format_objective(value: float) -> str:
    """Format an objective with the digits in which two optima may differ.

    >>> format_objective(157.80185041)
    '157.8019'
    """
    return format_significant(value, digits=7)


def format_milliseconds(seconds: float) -> str:
    """Format seconds as milliseconds.

    >>> format_milliseconds(0.01463)
    '14.63'
    """
    return format_significant(seconds * 1e3)


def format_microseconds(seconds: float) -> str:
    """Format seconds as microseconds.

    >>> format_microseconds(6.755e-4)
    '675.5'
    """
    return format_significant(seconds * 1e6)
