"""Tables of text, and how figures become text."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any


@dataclass(frozen=True)
class Table:
    """A table to be read; `hexmend.report.markdown` and `hexmend.report.latex` draw it.

    Parameters
    ----------
    title : str
    head : sequence of str
        Of the columns, the first being that of the labels.
    rows : sequence of sequence of str
        As long as `head` each.
    notes : sequence of str
        Sentences below the table.
    """

    title: str
    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    notes: Sequence[str] = ()

    @property
    def transposed(self) -> Table:
        """The same with rows and columns exchanged."""
        head, *rows = (list(column) for column in zip(self.head, *self.rows, strict=True))
        return replace(self, head=head, rows=rows)

    def parts(self, width: int, gap: int) -> Iterator[Table]:
        """The table in parts of so many columns as go into `width` letters, each with the labels.

        Parameters
        ----------
        width : int
        gap : int
            Letters that a column takes beside its text.
        """
        columns = list(zip(self.head, *self.rows, strict=True))
        labels, *others = ((gap + max(map(len, column)), column) for column in columns)
        while others:
            taken, left = [labels[1]], width - labels[0]
            while others and (others[0][0] <= left or len(taken) == 1):
                wide, column = others.pop(0)
                taken.append(column)
                left -= wide
            head, *rows = zip(*taken, strict=True)
            yield replace(self, head=head, rows=rows)


@dataclass(frozen=True)
class Figure:
    """A line of a table of results: which figure, what it is called, and how it is written."""

    key: str
    label: str
    text: Callable[[Any], str]


def of(record: Mapping[str, Any], figure: Figure) -> str:
    """The figure's text, a dash where the record does not have it."""
    value = record.get(figure.key)
    return "–" if value is None else figure.text(value)


def count(value: int) -> str:
    """
    >>> count(31760)
    '31,760'
    """
    return f"{value:,}"


def quality(value: float) -> str:
    """
    >>> quality(0.56741)
    '0.5674'
    """
    return f"{value:.4f}"


def significant(value: float, digits: int = 4) -> str:
    """So many significant figures, never with an exponent.

    >>> [significant(value) for value in (0.0012345, 19.522, 83960.9, 0)]
    ['0.001234', '19.52', '83,960', '0']
    """
    return f"{float(f'{value:.{digits}g}'):,.10f}".rstrip("0").rstrip(".")


def objective(value: float) -> str:
    """With the digits in which two optima may differ.

    >>> objective(157.80185041)
    '157.8019'
    """
    return significant(value, digits=7)


def milli(seconds: float) -> str:
    """Seconds as milliseconds.

    >>> milli(0.01463)
    '14.63'
    """
    return significant(seconds * 1e3)


def micro(seconds: float) -> str:
    """Seconds as microseconds.

    >>> micro(6.755e-4)
    '675.5'
    """
    return significant(seconds * 1e6)
