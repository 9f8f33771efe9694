"""Tables of text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Table:
    """A table of text; `hexmend.report.markdown` and `hexmend.report.latex` write it.

    Parameters
    ----------
    title : str
    head : sequence of str
        Heads of the columns; the first column has the labels.
    rows : sequence of sequence of str
        Each as long as `head`.
    notes : sequence of str
        Sentences below the table.
    """

    title: str
    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    notes: Sequence[str] = ()

    @property
    def transposed(self) -> Table:
        """The table with rows and columns exchanged."""
        head, *rows = (list(column) for column in zip(self.head, *self.rows, strict=True))
        return replace(self, head=head, rows=rows)

    def parts(self, width: int, gap: int) -> Iterator[Table]:
        """Split the table into parts that fit into `width` characters, each with the column of labels.

        Parameters
        ----------
        width : int
        gap : int
            Characters of a column in addition to its text.
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
