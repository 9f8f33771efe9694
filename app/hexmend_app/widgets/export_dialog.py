"""Asks what a chart or a table is to be like and where it goes, and shows it before."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QImage, QPixmap, QResizeEvent
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QSizePolicy,
    QTextBrowser,
    QVBoxLayout,
    QWidget,
)

from hexmend.errors import FileError, HexmendError, ParameterError
from hexmend.io.suffixes import suffix_for
from hexmend.parameters import declared
from hexmend.report.charts import FIGURE_SUFFIXES, MM_PER_INCH, ChartStyle, Draw, chart_png
from hexmend_app.widgets.parameter_form import ParameterForm
from hexmend_app.widgets.scrolled import scrolled
from hexmend_app.widgets.style import WORSE, explain, note
from hexmend_app.widgets.target_row import TargetRow

#: Milliseconds after the last change until it is shown.
_PAUSE = 150

#: Letters of a title or a name at most.
_LONGEST = 200


class ExportDialog(QDialog):
    """Edits what is called what and where it goes, beside a preview that others fill.

    Parameters
    ----------
    what : str
        What is saved, such as "the histogram".
    name : str
        The file name proposed.
    kinds : str
        Kinds of file, as Qt's dialogs take them.
    suffixes : sequence of str
        Those that can be written.
    style : ChartStyle
        Its values are shown first.
    title : str
        What is written above by itself.
    names : sequence of str
        What curves or methods call themselves.
    """

    def __init__(
        self,
        what: str,
        name: str,
        kinds: str,
        suffixes: Sequence[str],
        style: ChartStyle,
        title: str,
        names: Sequence[str],
        parent: QWidget | None = None,
    ):
        super().__init__(parent)
        self.setWindowTitle(f"Save {what}")
        self._what, self._suffixes, self._style = what, suffixes, style
        self.target = TargetRow(f"Save {what} as", name, kinds, f"Where {what} goes: {', '.join(suffixes)}.")
        self.title = QLineEdit(title)
        self.title.setMaxLength(_LONGEST)
        self.title.setCursorPosition(0)
        explain(self.title, "Title", "What stands above it; nothing, where this is empty.")
        self.names = {own: QLineEdit(style.names.get(own) or own) for own in names}
        for own, line in self.names.items():
            line.setMaxLength(_LONGEST)
            explain(line, f"Name of {own}", "What this is called in the file.")
        self._problem = note("", WORSE)
        self._problem.setAccessibleName("What is wrong")
        self._soon = QTimer(self, interval=_PAUSE, singleShot=True)
        self._soon.timeout.connect(self.show_preview)

    def lay_out(self, preview: QWidget, *forms: QWidget) -> None:
        """Put a preview beside forms and the names, and what is edited before that into effect."""
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
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Save | QDialogButtonBox.StandardButton.Cancel)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.addLayout(both, 1)
        layout.addWidget(self.target)
        layout.addWidget(self._problem)
        layout.addWidget(buttons)
        self.refuse("")
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
        """Show what would be written."""
        raise NotImplementedError

    def changed(self, *_: Any) -> None:
        """Show it anew soon."""
        self.refuse("")
        self._soon.start()

    def accept(self) -> None:
        """Close where it can be written to the path; or say why not."""
        if self.target.empty:
            self.refuse(f"Name the file that {self._what} goes to.")
            return
        try:
            suffix_for(self.target.path(), self._what, self._suffixes)
            self.chosen()
        except (FileError, ParameterError) as error:
            self.refuse(str(error))
            return
        if self.target.settled():
            super().accept()

    def refuse(self, problem: str) -> None:
        """Say what is wrong; nothing, where it is empty."""
        self._problem.setText(problem)
        self._problem.setVisible(bool(problem))


class ChartDialog(ExportDialog):
    """Edits the style of a chart, with a preview.

    Parameters
    ----------
    draw : callable
        Draws it in a style.
    *arguments
        As of `ExportDialog`.
    """

    def __init__(self, draw: Draw, *arguments: Any, parent: QWidget | None = None):
        super().__init__(*arguments, parent)
        self._draw = draw
        self._picture = QPixmap()
        self.preview = QLabel(alignment=Qt.AlignmentFlag.AlignCenter)
        self.preview.setMinimumSize(360, 260)
        self.preview.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Ignored)
        explain(self.preview, "Preview", "The figure as it will be.")
        self.form = ParameterForm(declared(ChartStyle))
        self.form.set_values(self._style.values())
        self.form.changed.connect(self.changed)
        self.lay_out(self.preview, self.form)

    def chosen(self) -> ChartStyle:
        """The style as it is chosen; raises `ParameterError` where a value cannot be used."""
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
        room = self.preview.contentsRect().size() * ratio
        try:
            style = self.chosen()
            data = chart_png(self._draw, style, max(10.0, room.width() / style.width * MM_PER_INCH))
        except HexmendError as error:
            self.refuse(str(error))
            return
        image = QImage.fromData(data)
        if image.height() > room.height() or image.width() > room.width():
            aspect = Qt.AspectRatioMode.KeepAspectRatio
            image = image.scaled(room, aspect, Qt.TransformationMode.SmoothTransformation)
        picture = QPixmap.fromImage(image)
        picture.setDevicePixelRatio(ratio)
        self.preview.setPixmap(picture)


class TableDialog(ExportDialog):
    """Edits what is called what in a table, with a preview.

    Parameters
    ----------
    text : callable
        The table as Markdown; raises `ParameterError` where it cannot be made with what is chosen.
    *arguments
        As of `ExportDialog`.
    """

    def __init__(self, text: Callable[[ChartStyle], str], *arguments: Any, parent: QWidget | None = None):
        super().__init__(*arguments, parent)
        self._text = text
        self.preview = QTextBrowser()
        self.preview.setMinimumSize(360, 200)
        explain(self.preview, "Preview", "The table as it will be.")
        self.lay_out(self.preview)

    def chosen(self) -> ChartStyle:
        """The style as it is chosen; raises `ParameterError` where two are called the same."""
        style = super().chosen()
        self._text(style)
        return style

    def show_preview(self) -> None:
        """Show the table."""
        try:
            self.preview.setMarkdown(self._text(self.chosen()))
        except ParameterError as error:
            self.refuse(str(error))
