"""Table model of the list of the worst hexes."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Any

import numpy as np
from PySide6.QtCore import QModelIndex, QObject, QPersistentModelIndex, Qt
from PySide6.QtGui import QBrush, QColor

from hexmend.io.storage.suffixes import suffix_for
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.report.documents import write_text
from hexmend_app.state.mesh.worst_hexes import WorstHexes
from hexmend_app.theme.palette import INVERTED_TEXT
from hexmend_app.translation import tr
from hexmend_app.widgets.tables.row_model import RowModel
from hexmend_app.widgets.wording import figure

_TITLES = ("Hex", "In the file", "", "Scaled Jacobian", "State")
#: Columns of the table.
HEX, ID, VALUE, JACOBIAN, STATE = range(5)


class WorstModel(RowModel):
    """Table model with one row per hex.

    Attributes
    ----------
    worst : WorstHexes
        The hexes, whose numbers are the rows.
    metric : str
        Title of the metric that sorts the list.
    """

    worst: WorstHexes

    def __init__(self, parent: QObject | None = None):
        super().__init__(len(_TITLES), (STATE,), parent)
        self.rows = np.empty(0, np.int64)
        self.metric = ""

    def fill(self, worst: WorstHexes, metric: str) -> None:
        """Show the worst hexes by the metric with a title."""
        self.worst, self.metric = worst, metric
        self.set_rows(worst.hexes, len(worst.hexes) == len(self.rows))

    def title(self, column: int) -> str:
        """Return the title of a column."""
        return self.metric if column == VALUE else tr(_TITLES[column])

    def data(self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        row, column, worst = index.row(), index.column(), self.worst
        if role == Qt.ItemDataRole.DisplayRole:
            if column == HEX:
                return str(worst.hexes[row])
            if column == ID:
                return "" if worst.ids is None else str(worst.ids[row])
            if column == STATE:
                return tr(worst.states[row])
            return figure(float((worst.values if column == VALUE else worst.jacobians)[row]))
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return self.alignment(column)
        if role == Qt.ItemDataRole.ForegroundRole and column == STATE:
            return QBrush(QColor(str(INVERTED_TEXT)))
        return None


def write_worst(path: str | Path, mesh: Mesh, metric: str = "q") -> None:
    """Write the worst hexes of a mesh as CSV: number, metric, scaled Jacobian, state, number in the file if it has one.

    Parameters
    ----------
    path : path-like
    mesh : Mesh
    metric : str
        A name of `hexmend.quality.METRICS`.

    Raises
    ------
    FileError
        If the suffix is not .csv or the file cannot be written; an existing file is left unchanged.
    """
    suffix_for(Path(path), "a list", (".csv",))
    worst, out = WorstHexes.of(mesh, measure(mesh.points, mesh.hexes, mesh.mid_nodes), metric), io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["hex", metric, "scaled-jacobian", "state", *(["id"] if worst.ids is not None else [])])
    columns = [worst.hexes.tolist(), worst.values.tolist(), worst.jacobians.tolist(), worst.states]
    columns += [worst.ids.tolist()] if worst.ids is not None else []
    writer.writerows(zip(*columns, strict=True))
    write_text(Path(path), out.getvalue())
