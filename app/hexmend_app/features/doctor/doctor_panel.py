"""Panel of mesh problems: a paragraph for each finding, with links to show and repair it."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from hexmend.doctor import PROBLEMS, Finding
from hexmend.mesh.mesh import Mesh
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, note, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.form_grid import scrolled
from hexmend_app.widgets.link_label import LinkLabel

_CHECKING = "Checking the mesh…"


class DoctorPanel(QWidget):
    """Panel that lists findings, and says what helps against inverted hexes.

    Signals
    -------
    show_requested(int)
        The user follows the link Show of the finding with this index.
    repair_requested(list)
        The user repairs these kinds of problem; an empty list means all.
    smooth_requested, pad_requested
        The user follows one of these links.
    """

    show_requested = Signal(int)
    repair_requested = Signal(list)
    smooth_requested = Signal()
    pad_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.text = LinkLabel()
        self.text.setWordWrap(True)
        self.text.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.text.setAccessibleName(tr("Findings"))
        self.text.setTextInteractionFlags(
            self.text.textInteractionFlags() | Qt.TextInteractionFlag.TextSelectableByMouse
        )
        self.text.linkActivated.connect(self._follow)
        self._all = QPushButton(icon("bandage"), tr("Repair all"))
        set_help(self._all, tr("Repair all"), tr("Repair all problems that can be repaired. Can be undone."))
        self._all.clicked.connect(lambda: self.repair_requested.emit([]))
        self._notes = note()
        self._notes.hide()
        inside = QWidget()
        head = fill(QHBoxLayout(), (self._notes, 1), None, self._all)
        fill(QVBoxLayout(inside), head, (self.text, 1), margins=(8, 8, 8, 8))
        fill(QVBoxLayout(self), scrolled(inside), margins=(0, 0, 0, 0))
        self.show_findings(None)

    def show_findings(
        self, findings: Sequence[Finding] | None, problem: str = "", mesh: Mesh | None = None, inverted: int = 0
    ) -> None:
        """List the findings in a mesh.

        Parameters
        ----------
        findings : sequence of Finding or None
            None while the mesh is being checked.
        problem : str
            Why the check failed.
        mesh : Mesh, optional
        inverted : int
            Number of inverted hexes, which are no finding of the doctor.
        """
        paragraphs = []
        if findings is None:
            paragraphs.append(escape(problem or tr(_CHECKING)))
        if inverted:
            links = {"smooth": f'<a href="smooth">{tr("Smooth")}</a>', "pad": f'<a href="pad">{tr("Pad")}</a>'}
            hexes = tr("1 hex is") if inverted == 1 else tr("{count:,} hexes are", count=inverted)
            paragraphs.append(tr("{hexes} inverted: {smooth} or {pad}.", hexes=hexes, **links))
        elif findings is not None and not findings:
            paragraphs.append(tr("No problems found."))
        paragraphs += [_paragraph(at, finding, mesh) for at, finding in enumerate(findings or ())]
        self.text.setText("".join(f'<p style="margin: 0 0 8px">{text}</p>' for text in paragraphs))
        self._all.setVisible(sum(finding.mendable for finding in findings or ()) > 1)

    def show_notes(self, notes: Sequence[str]) -> None:
        """Show what was changed when the file was read."""
        self._notes.setText(tr("Changed on reading: {changes}", changes=" ".join(notes)))
        self._notes.setVisible(bool(notes))

    def set_busy(self, busy: bool) -> None:
        """Disable repairs while the mesh cannot be edited."""
        self._all.setEnabled(not busy)

    def _follow(self, link: str) -> None:
        command, _, argument = link.partition(" ")
        if command == "show":
            self.show_requested.emit(int(argument))
        elif command == "repair":
            self.repair_requested.emit([argument])
        else:
            (self.smooth_requested if command == "smooth" else self.pad_requested).emit()


def _paragraph(at: int, finding: Finding, mesh: Mesh | None) -> str:
    """Return a finding as HTML, with links to show its hexes and to repair it."""
    problem, location = PROBLEMS[finding.kind], finding.location_text(mesh=mesh)
    text = f"<b>{escape(problem.title)}.</b> {escape(finding.message)} {escape(finding.remedy)}"
    links = []
    if location:
        text += f" {escape(location).capitalize()}."
        links.append(f'<a href="show {at}">{tr("Show")}</a>')
    if finding.mendable:
        links.append(f'<a href="repair {finding.kind}">{tr("Repair: {action}", action=escape(problem.action))}</a>')
    return " · ".join([text, *links])
