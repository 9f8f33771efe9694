"""Tables of text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace


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
