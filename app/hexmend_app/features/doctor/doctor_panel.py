"""What is wrong with the mesh besides its shape: a row for each finding, with what shows it and what mends it."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from hexmend.doctor import PROBLEMS, Finding
from hexmend_app.widgets.scrolled import scrolled
from hexmend_app.widgets.style import explain, icon, note

_LOOKING = "The mesh is being examined."
_HEALTHY = "Nothing is wrong with the mesh but, perhaps, the shape of its hexes."


class DoctorPanel(QWidget):
    """Lists findings.

    Signals
    -------
    show_requested(int)
        The user wants to see where this finding is, counted from 0.
    mend_requested(list)
        The user wants these kinds of trouble mended; all that can be if it is empty.
    """

    show_requested = Signal(int)
    mend_requested = Signal(list)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._head = note(_LOOKING)
        self._all = QPushButton(icon("bandage"), "Mend all")
        explain(self._all, "Mend all", "Mend whatever can be mended, in the right order; Undo takes it back.")
        self._all.clicked.connect(lambda: self.mend_requested.emit([]))
        self._rows = QGridLayout()
        self._rows.setColumnStretch(0, 1)
        self._rows.setVerticalSpacing(8)
        self._mends: list[QPushButton] = []
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(8, 6, 8, 6)
        head = QHBoxLayout()
        head.addWidget(self._head, 1)
        head.addWidget(self._all)
        column.addLayout(head)
        column.addLayout(self._rows)
        column.addStretch()
        outside = QVBoxLayout(self)
        outside.setContentsMargins(0, 0, 0, 0)
        outside.addWidget(scrolled(inside))
        self.show_findings(None)

    def show_findings(self, findings: Sequence[Finding] | None, problem: str = "") -> None:
        """List these; None while the mesh is being examined, or why it could not be."""
        while (item := self._rows.takeAt(0)) is not None:
            item.widget().hide()
            item.widget().deleteLater()
        self._mends = []
        if findings is None:
            self._head.setText(problem or _LOOKING)
        else:
            count = len(findings)
            self._head.setText(f"{count} thing{'s' * (count != 1)} to know of this mesh:" if count else _HEALTHY)
        for row, one in enumerate(findings or ()):
            self._add(row, one)
        self._all.setVisible(len(self._mends) > 1)

    def set_busy(self, busy: bool) -> None:
        """Say whether the mesh may be changed by hand now."""
        for button in (self._all, *self._mends):
            button.setEnabled(not busy)

    def _add(self, row: int, one: Finding) -> None:
        text = QLabel(
            f"<b>{escape(PROBLEMS[one.kind].title)}.</b> {escape(one.message)} {escape(one.remedy)}"
            + (f"<br>{escape(one.location_text()).capitalize()}" if one.location_text() else "")
        )
        text.setTextFormat(Qt.TextFormat.RichText)
        text.setWordWrap(True)
        text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._rows.addWidget(text, row, 0)
        title = PROBLEMS[one.kind].title
        if one.location_text():
            show = QPushButton(icon("eye-outline"), "Show")
            explain(show, f"Show: {title}", "Show nothing but these hexes and their neighbours; Esc brings all back.")
            show.clicked.connect(lambda _=False, row=row: self.show_requested.emit(row))
            self._rows.addWidget(show, row, 1, Qt.AlignmentFlag.AlignTop)
        if one.mendable:
            mend = QPushButton(icon("bandage"), "Mend")
            action = PROBLEMS[one.kind].action
            explain(mend, f"Mend: {title}", f"{action[:1].upper()}{action[1:]}. Undo takes it back.")
            mend.clicked.connect(lambda _=False, kind=one.kind: self.mend_requested.emit([kind]))
            self._rows.addWidget(mend, row, 2, Qt.AlignmentFlag.AlignTop)
            self._mends.append(mend)
