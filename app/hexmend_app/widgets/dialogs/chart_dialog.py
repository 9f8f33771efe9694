"""Dialog for the style and path of an exported chart, with a preview."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QFormLayout, QHBoxLayout, QLabel, QLineEdit, QVBoxLayout, QWidget

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


class ChartDialog(SaveDialog):
    """Dialog that edits title, names, style and path of an exported chart, next to a preview.

    Parameters
    ----------
    chart : Convergence or Histogram
    subject, name, kinds : str
        See `SaveDialog`.
    style : ChartStyle
        Initial values.
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
        super().__init__(subject, name, kinds, parent)
        self._chart, self._style = chart, style
        self.title = QLineEdit(chart.title)
        self.title.setMaxLength(_MAX_LENGTH)
        self.title.setCursorPosition(0)
        set_help(self.title, tr("Title"), tr("Text above the chart; leave empty for no title."))
        self.names = {default: QLineEdit(style.names.get(default) or default) for default in chart.names}
        for default, line in self.names.items():
            line.setMaxLength(_MAX_LENGTH)
            set_help(line, tr("Name of {default}", default=default), tr("Name in the exported file."))
        self.preview = Preview(tr("Preview of the exported figure."))
        self.preview.drawn.connect(self.refuse)
        self.form = ParameterForm(declared(ChartStyle))
        self.form.set_values(style.values())
        self.form.changed.connect(self._changed)
        for line in (self.title, *self.names.values()):
            line.textEdited.connect(self._changed)
        self.target.edited.connect(self._changed)
        self._lay_out()
        self.show_preview()

    def _lay_out(self) -> None:
        settings = QWidget()
        rows = apply_spacing(QFormLayout())
        rows.addRow(tr("Title"), self.title)
        if self.names:
            rows.addRow(QLabel(tr("<b>Names</b>")))
        for default, line in self.names.items():
            label = QLabel(default)
            label.setTextFormat(Qt.TextFormat.PlainText)
            rows.addRow(label, line)
        fill(QVBoxLayout(settings), self.form, rows, None)
        area = scrolled(settings)
        area.setMinimumWidth(max(280, settings.sizeHint().width() + 28))
        self.lay_out_below(fill(QHBoxLayout(), (self.preview, 1), area))
        self.resize(960, 560)

    def chosen(self) -> ChartStyle:
        """Return the edited style.

        Raises
        ------
        ParameterError
            If a value is invalid.
        """
        for problem in self.form.problems().values():
            raise ParameterError(problem)
        names = {default: line.text().strip() for default, line in self.names.items()}
        changed = {default: name for default, name in names.items() if name and name != default}
        return replace(self._style, title=self.title.text().strip(), names=changed, **self.form.values())

    def _changed(self) -> None:
        self.refuse("")
        self.show_preview()

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

    def check(self) -> None:
        """Raise `FileError` or `ParameterError` if the settings cannot be written to the path."""
        suffix_for(self.target.path(), self._subject, self.suffixes)
        self.chosen()


def answer(dialog: ChartDialog) -> tuple[Path, ChartStyle] | None:
    """Run a dialog and delete it; return the path and the style, or None if it was cancelled."""
    accepted = dialog.exec()
    dialog.deleteLater()
    return (dialog.target.path(), dialog.chosen()) if accepted else None
