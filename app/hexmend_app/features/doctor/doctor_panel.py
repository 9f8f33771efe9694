"""Panel of mesh problems: one row for each finding, with buttons to show and repair it."""

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
from hexmend_app.theme.style import icon, note, set_help
from hexmend_app.widgets.scrolled import scrolled

_LOOKING = "Checking the mesh…"
_HEALTHY = "No problems found. The doctor does not check the quality of the hexes."


class DoctorPanel(QWidget):
    """Lists findings.

    Signals
    -------
    show_requested(int)
        The user wants to see this finding, counted from 0.
    mend_requested(list)
        The user wants these kinds of problem repaired; an empty list means all.
    """

    show_requested = Signal(int)
    mend_requested = Signal(list)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._head = note(_LOOKING)
        self._all = QPushButton(icon("bandage"), "Repair all")
        set_help(
            self._all, "Repair all", "Repair all problems that can be repaired, in the right order; Undo reverts it."
        )
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
        """List the findings; None while the mesh is being checked, with `problem` if the check failed."""
        while (item := self._rows.takeAt(0)) is not None:
            item.widget().hide()
            item.widget().deleteLater()
        self._mends = []
        if findings is None:
            self._head.setText(problem or _LOOKING)
        else:
            count = len(findings)
            self._head.setText(f"{count} finding{'s' * (count != 1)}:" if count else _HEALTHY)
        for row, one in enumerate(findings or ()):
            self._add(row, one)
        self._all.setVisible(len(self._mends) > 1)

    def set_busy(self, busy: bool) -> None:
        """Disable the repair buttons while the mesh cannot be edited."""
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
            set_help(show, f"Show: {title}", "Show only these hexes and their neighbours; Esc shows all.")
            show.clicked.connect(lambda _=False, row=row: self.show_requested.emit(row))
            self._rows.addWidget(show, row, 1, Qt.AlignmentFlag.AlignTop)
        if one.mendable:
            mend = QPushButton(icon("bandage"), "Repair")
            action = PROBLEMS[one.kind].action
            set_help(mend, f"Repair: {title}", f"{action[:1].upper()}{action[1:]}. Undo reverts it.")
            mend.clicked.connect(lambda _=False, kind=one.kind: self.mend_requested.emit([kind]))
            self._rows.addWidget(mend, row, 2, Qt.AlignmentFlag.AlignTop)
            self._mends.append(mend)
