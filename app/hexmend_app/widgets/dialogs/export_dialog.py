"""Dialog for the style and path of an exported chart or table, with a preview."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QImage, QPixmap, QResizeEvent
from PySide6.QtWidgets import (
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QSizePolicy,
    QTextBrowser,
    QVBoxLayout,
    QWidget,
)

from hexmend.errors import HexmendError, ParameterError
from hexmend.io.storage.suffixes import suffix_for
from hexmend.parameters import declared
from hexmend.report.charts import FIGURE_SUFFIXES, MM_PER_INCH, Chart, ChartStyle, chart_png
from hexmend_app.theme.style import set_help
from hexmend_app.widgets.dialogs.save_dialog import SaveDialog
from hexmend_app.widgets.inputs.parameter_form import ParameterForm
from hexmend_app.widgets.scrolled import scrolled

#: Milliseconds from the last change to the preview.
_PAUSE = 150

#: Maximum length of a title or a name.
_LONGEST = 200


class ExportDialog(SaveDialog):
    """Edits what is called what and where it goes, beside a preview.

    Parameters
    ----------
    what, name, kinds : str
        As of `SaveDialog`.
    style : ChartStyle
        Its values are shown first.
    title : str
        What is written above by itself.
    names : sequence of str
        What curves or methods call themselves.
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
        self.title.setMaxLength(_LONGEST)
        self.title.setCursorPosition(0)
        set_help(self.title, "Title", "What stands above it; nothing, where this is empty.")
        self.names = {own: QLineEdit(style.names.get(own) or own) for own in names}
        for own, line in self.names.items():
            line.setMaxLength(_LONGEST)
            set_help(line, f"Name of {own}", "What this is called in the file.")
        self._soon = QTimer(self, interval=_PAUSE, singleShot=True)
        self._soon.timeout.connect(self.show_preview)

    def lay_out(self, preview: QWidget, *forms: QWidget) -> None:
        """Put a preview beside forms and the names, and show what would be written."""
        settings = QWidget()
        column = QVBoxLayout(settings)
        for form in forms:
            column.addWidget(form)
        rows = QFormLayout()
        rows.addRow("Title", self.title)
        if self.names:
            rows.addRow(QLabel("<b>Names</b>"))
        for own, line in self.names.items():
            called = QLabel(own)
            called.setTextFormat(Qt.TextFormat.PlainText)
            rows.addRow(called, line)
        column.addLayout(rows)
        column.addStretch()
        area = scrolled(settings)
        area.setMinimumWidth(max(280, settings.sizeHint().width() + 28))
        both = QHBoxLayout()
        both.addWidget(preview, 1)
        both.addWidget(area)
        self.lay_out_below(both)
        for line in (self.title, *self.names.values()):
            line.textEdited.connect(self.changed)
        self.target.edited.connect(self.changed)
        self.resize(960, 560)
        self._soon.start()

    def chosen(self) -> ChartStyle:
        """The style as it is chosen.

        Raises
        ------
        ParameterError
            Where a value cannot be used.
        """
        names = {own: line.text().strip() for own, line in self.names.items()}
        known = {own: name for own, name in names.items() if name and name != own}
        return replace(self._style, title=self.title.text().strip(), names=known)

    def show_preview(self) -> None:
        """Update the preview."""
        raise NotImplementedError

    def changed(self, *_: Any) -> None:
        """Update the preview after a delay."""
        self.refuse("")
        self._soon.start()

    def check(self) -> None:
        """Raise `FileError` or `ParameterError` if the settings cannot be written to the path."""
        suffix_for(self.target.path(), self._subject, self.suffixes)
        self.chosen()


def answer(dialog: ExportDialog) -> tuple[Path, ChartStyle] | None:
    """Show a dialog: where the file goes and what it is to be like, None for nowhere. Nothing is left of the dialog."""
    meant = dialog.exec()
    dialog.deleteLater()
    return (dialog.target.path(), dialog.chosen()) if meant else None


class ChartDialog(ExportDialog):
    """Edits the style of a chart, with a preview.

    Parameters
    ----------
    chart : Chart
    what, name, kinds, style
        As of `ExportDialog`.
    """

    def __init__(
        self, chart: Chart, topic: str, name: str, kinds: str, style: ChartStyle, parent: QWidget | None = None
    ):
        super().__init__(topic, name, kinds, style, chart.title, chart.names, parent)
        self._chart = chart
        self.preview = QLabel(alignment=Qt.AlignmentFlag.AlignCenter)
        self.preview.setMinimumSize(360, 260)
        self.preview.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Ignored)
        set_help(self.preview, "Preview", "The figure as it will be.")
        self.form = ParameterForm(declared(ChartStyle))
        self.form.set_values(self._style.values())
        self.form.changed.connect(self.changed)
        self.lay_out(self.preview, self.form)

    def chosen(self) -> ChartStyle:
        """The style as it is chosen; raises `ParameterError` for an invalid value."""
        for problem in self.form.problems().values():
            raise ParameterError(problem)
        return replace(super().chosen(), **self.form.values())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Draw as large as there is room."""
        super().resizeEvent(event)
        self._soon.start()

    def show_preview(self) -> None:
        """Draw the figure as large as there is room."""
        drawn = self.target.path().suffix.lower() in FIGURE_SUFFIXES
        self.form.setEnabled(drawn)
        if not drawn:
            self.preview.setText("A table of the figures, without a picture.")
            return
        ratio = self.devicePixelRatioF()
        space = self.preview.contentsRect().size() * ratio
        try:
            style = self.chosen()
            data = chart_png(self._chart.draw, style, max(10.0, space.width() / style.width * MM_PER_INCH))
        except HexmendError as error:
            self.refuse(str(error))
            return
        image = QImage.fromData(data)
        if image.height() > space.height() or image.width() > space.width():
            aspect = Qt.AspectRatioMode.KeepAspectRatio
            image = image.scaled(space, aspect, Qt.TransformationMode.SmoothTransformation)
        picture = QPixmap.fromImage(image)
        picture.setDevicePixelRatio(ratio)
        self.preview.setPixmap(picture)


class TableDialog(ExportDialog):
    """Edits what is called what in a table, with a preview.

    Parameters
    ----------
    text : callable
        The table as Markdown; raises `ParameterError` where it cannot be made with what is chosen.
    what, name, kinds, style, title, names
        As of `ExportDialog`.
    """

    def __init__(
        self,
        text: Callable[[ChartStyle], str],
        label: str,
        name: str,
        kinds: str,
        style: ChartStyle,
        title: str,
        names: Sequence[str],
        parent: QWidget | None = None,
    ):
        super().__init__(label, name, kinds, style, title, names, parent)
        self._text = text
        self.preview = QTextBrowser()
        self.preview.setMinimumSize(360, 200)
        set_help(self.preview, "Preview", "The table as it will be.")
        self.lay_out(self.preview)

    def chosen(self) -> ChartStyle:
        """The style as it is chosen; raises `ParameterError` for equal names."""
        style = super().chosen()
        self._text(style)
        return style

    def show_preview(self) -> None:
        """Show the table."""
        try:
            self.preview.setMarkdown(self._text(self.chosen()))
        except ParameterError as error:
            self.refuse(str(error))
