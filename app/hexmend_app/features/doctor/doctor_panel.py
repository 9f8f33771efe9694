"""Panel of mesh problems: a row for each finding, with buttons to show and repair it."""

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
from hexmend.mesh.mesh import Mesh
from hexmend_app.theme.spacing import clear, fill, on_grid
from hexmend_app.theme.style import icon, note, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.form_grid import scrolled
from hexmend_app.widgets.wording import counted

_CHECKING = "Checking the mesh…"
_HEALTHY = "No problems found. The doctor does not check the quality of the hexes."


class DoctorPanel(QWidget):
    """Panel that lists findings.

    Signals
    -------
    show_requested(int)
        The user pressed Show of the finding with this index.
    repair_requested(list)
        The user repairs these kinds of problem; an empty list means all.
    """

    show_requested = Signal(int)
    repair_requested = Signal(list)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._head = note(tr(_CHECKING))
        self._all = QPushButton(icon("bandage"), tr("Repair all"))
        set_help(self._all, tr("Repair all"), tr("Repair all problems that can be repaired. Can be undone."))
        self._all.clicked.connect(lambda: self.repair_requested.emit([]))
        self._notes = note()
        self._notes.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._notes.hide()
        self._rows = on_grid(QGridLayout())
        self._rows.setColumnStretch(0, 1)
        self._rows.setVerticalSpacing(8)
        self._repair_buttons: list[QPushButton] = []
        inside = QWidget()
        head = fill(QHBoxLayout(), (self._head, 1), self._all)
        fill(QVBoxLayout(inside), head, self._notes, self._rows, None, margins=(8, 8, 8, 8))
        fill(QVBoxLayout(self), scrolled(inside), margins=(0, 0, 0, 0))
        self.show_findings(None)

    def show_findings(self, findings: Sequence[Finding] | None, problem: str = "", mesh: Mesh | None = None) -> None:
        """List the findings in a mesh; None while it is being checked, with `problem` if the check failed."""
        clear(self._rows)
        self._repair_buttons = []
        if findings is None:
            self._head.setText(problem or tr(_CHECKING))
        else:
            count = len(findings)
            self._head.setText(tr("{findings}:", findings=counted(count, "finding")) if count else tr(_HEALTHY))
        for row, finding in enumerate(findings or ()):
            self._add(row, finding, mesh)
        self._all.setVisible(len(self._repair_buttons) > 1)

    def show_notes(self, notes: Sequence[str]) -> None:
        """Show what was changed when the file was read."""
        self._notes.setText(tr("Changed on reading: {changes}", changes=" ".join(notes)))
        self._notes.setVisible(bool(notes))

    def set_busy(self, busy: bool) -> None:
        """Disable the repair buttons while the mesh cannot be edited."""
        for button in (self._all, *self._repair_buttons):
            button.setEnabled(not busy)

    def _add(self, row: int, finding: Finding, mesh: Mesh | None) -> None:
        problem, location = PROBLEMS[finding.kind], finding.location_text(mesh=mesh)
        text = QLabel(
            f"<b>{escape(problem.title)}.</b> {escape(finding.message)} {escape(finding.remedy)}"
            + (f"<br>{escape(location).capitalize()}" if location else "")
        )
        text.setTextFormat(Qt.TextFormat.RichText)
        text.setWordWrap(True)
        text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._rows.addWidget(text, row, 0)
        if location:
            show = QPushButton(icon("eye-outline"), tr("Show"))
            help = tr("Show only these hexes and their neighbours. Press Esc to show all.")
            set_help(show, tr("Show: {title}", title=problem.title), help)
            show.clicked.connect(lambda: self.show_requested.emit(row))
            self._rows.addWidget(show, row, 1, Qt.AlignmentFlag.AlignTop)
        if finding.mendable:
            repair = QPushButton(icon("bandage"), tr("Repair"))
            action = f"{problem.action[:1].upper()}{problem.action[1:]}"
            set_help(repair, tr("Repair: {title}", title=problem.title), tr("{action}. Can be undone.", action=action))
            repair.clicked.connect(lambda: self.repair_requested.emit([finding.kind]))
            self._rows.addWidget(repair, row, 2, Qt.AlignmentFlag.AlignTop)
            self._repair_buttons.append(repair)
