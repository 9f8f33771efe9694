"""Dialog for the style and path of an exported chart or table, with a preview."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import (
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QTextBrowser,
    QVBoxLayout,
    QWidget,
)

from hexmend.errors import ParameterError
from hexmend.io.storage.suffixes import suffix_for
from hexmend.parameters import declared
from hexmend_app.report.charts import FIGURE_SUFFIXES, MM_PER_INCH, ChartStyle, chart_png
from hexmend_app.report.convergence import Convergence
from hexmend_app.report.histogram import Histogram
from hexmend_app.theme.spacing import apply_spacing, fill
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.preview import Preview
from hexmend_app.widgets.dialogs.save_dialog import SaveDialog
from hexmend_app.widgets.form import scrolled
from hexmend_app.widgets.inputs.parameter_form import ParameterForm

#: Maximum length of a title or a name.
_MAX_LENGTH = 200


class ExportDialog(SaveDialog):
    """Base of dialogs that edit title, names and path of an export next to a preview.

    Parameters
    ----------
    subject, name, kinds : str
        See `SaveDialog`.
    style : ChartStyle
        Initial values.
    title : str
        Default title.
    names : sequence of str
        Default names of curves or methods.
    """

    def __init__(
        self,
        subject: str,
        name: str,
        kinds: str,
        style: ChartStyle,
        title: str,
        names: Sequence[str],
        parent: QWidget | None = None,
    ):
        super().__init__(subject, name, kinds, parent)
        self._style = style
        self.title = QLineEdit(title)
        self.title.setMaxLength(_MAX_LENGTH)
        self.title.setCursorPosition(0)
        set_help(self.title, tr("Title"), tr("Text above the chart or table; leave empty for no title."))
        self.names = {default: QLineEdit(style.names.get(default) or default) for default in names}
        for default, line in self.names.items():
            line.setMaxLength(_MAX_LENGTH)
            set_help(line, tr("Name of {default}", default=default), tr("Name in the exported file."))

    def lay_out(self, preview: QWidget, *forms: QWidget) -> None:
        """Lay out a preview next to forms, title and names."""
        settings = QWidget()
        column = fill(QVBoxLayout(settings), *forms)
        rows = apply_spacing(QFormLayout())
        rows.addRow(tr("Title"), self.title)
        if self.names:
            rows.addRow(QLabel(tr("<b>Names</b>")))
        for default, line in self.names.items():
            label = QLabel(default)
            label.setTextFormat(Qt.TextFormat.PlainText)
            rows.addRow(label, line)
        column.addLayout(rows)
        column.addStretch()
        area = scrolled(settings)
        area.setMinimumWidth(max(280, settings.sizeHint().width() + 28))
        upper = fill(QHBoxLayout(), (preview, 1), area)
        self.lay_out_below(upper)
        for line in (self.title, *self.names.values()):
            line.textEdited.connect(self.changed)
        self.target.edited.connect(self.changed)
        self.resize(960, 560)
        self.show_preview()

    def chosen(self) -> ChartStyle:
        """Return the edited style.

        Raises
        ------
        ParameterError
            If a value is invalid.
        """
        names = {default: line.text().strip() for default, line in self.names.items()}
        changed = {default: name for default, name in names.items() if name and name != default}
        return replace(self._style, title=self.title.text().strip(), names=changed)

    def show_preview(self) -> None:
        """Update the preview."""
        raise NotImplementedError

    def changed(self, *_: Any) -> None:
        """Update the preview."""
        self.refuse("")
        self.show_preview()

    def check(self) -> None:
        """Raise `FileError` or `ParameterError` if the settings cannot be written to the path."""
        suffix_for(self.target.path(), self._subject, self.suffixes)
        self.chosen()


def answer(dialog: ExportDialog) -> tuple[Path, ChartStyle] | None:
    """Run a dialog and delete it; return the path and the style, or None if it was cancelled."""
    accepted = dialog.exec()
    dialog.deleteLater()
    return (dialog.target.path(), dialog.chosen()) if accepted else None


class ChartDialog(ExportDialog):
    """Dialog that edits the style of a chart, with a preview.

    Parameters
    ----------
    chart : Convergence or Histogram
    subject, name, kinds, style
        See `ExportDialog`.
    """

    def __init__(
        self,
        chart: Convergence | Histogram,
        subject: str,
        name: str,
        kinds: str,
        style: ChartStyle,
        parent: QWidget | None = None,
    ):
        super().__init__(subject, name, kinds, style, chart.title, chart.names, parent)
        self._chart = chart
        self.preview = Preview(tr("Preview of the exported figure."))
        self.preview.drawn.connect(self.refuse)
        self.form = ParameterForm(declared(ChartStyle))
        self.form.set_values(self._style.values())
        self.form.changed.connect(self.changed)
        self.lay_out(self.preview, self.form)

    def chosen(self) -> ChartStyle:
        """Return the edited style; raise `ParameterError` if a value is invalid."""
        for problem in self.form.problems().values():
            raise ParameterError(problem)
        return replace(super().chosen(), **self.form.values())

    def show_preview(self) -> None:
        """Draw the figure as large as possible."""
        is_figure = self.target.path().suffix.lower() in FIGURE_SUFFIXES
        self.form.setEnabled(is_figure)
        if is_figure:
            self.preview.draw_soon(self._draw)
        else:
            self.preview.stop()
            self.preview.setText(tr("Table of values; no preview."))

    def _draw(self, size: QSize) -> QImage:
        style = self.chosen()
        return QImage.fromData(chart_png(self._chart.draw, style, max(10.0, size.width() / style.width * MM_PER_INCH)))


class TableDialog(ExportDialog):
    """Dialog that edits the title and the names in a table, with a preview.

    Parameters
    ----------
    text : callable
        Returns the table in a style as Markdown; raises `ParameterError` if the style is invalid.
    subject, name, kinds, style, title, names
        See `ExportDialog`.
    """

    def __init__(
        self,
        text: Callable[[ChartStyle], str],
        subject: str,
        name: str,
        kinds: str,
        style: ChartStyle,
        title: str,
        names: Sequence[str],
        parent: QWidget | None = None,
    ):
        super().__init__(subject, name, kinds, style, title, names, parent)
        self._text = text
        self.preview = QTextBrowser()
        self.preview.setMinimumSize(360, 200)
        set_help(self.preview, tr("Preview"), tr("Preview of the exported table."))
        self.lay_out(self.preview)

    def chosen(self) -> ChartStyle:
        """Return the edited style; raise `ParameterError` if names are equal."""
        style = super().chosen()
        self._text(style)
        return style

    def show_preview(self) -> None:
        """Show the table."""
        try:
            self.preview.setMarkdown(self._text(self.chosen()))
        except ParameterError as error:
            self.refuse(str(error))
