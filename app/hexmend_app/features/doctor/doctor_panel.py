"""Panel of mesh problems: a paragraph for each finding, with links to show and repair it."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend.doctor import PROBLEMS, Finding
from hexmend.mesh.mesh import Mesh
from hexmend_app.theme.spacing import fill
from hexmend_app.translation import tr
from hexmend_app.widgets.form import scrolled
from hexmend_app.widgets.link_label import LinkLabel


class DoctorPanel(QWidget):
    """Panel that lists findings, and says what helps against inverted hexes.

    Attributes
    ----------
    text : LinkLabel
        Its links are "show" with the index of a finding, "repair" with a kind of problem or alone for all problems,
        "smooth" and "pad".
    """

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.text = LinkLabel()
        self.text.setWordWrap(True)
        self.text.setAlignment(Qt.AlignmentFlag.AlignTop)
        self.text.setMargin(8)
        self.text.setAccessibleName(tr("Findings"))
        self.text.setTextInteractionFlags(
            self.text.textInteractionFlags() | Qt.TextInteractionFlag.TextSelectableByMouse
        )
        fill(QVBoxLayout(self), scrolled(self.text), margins=(0, 0, 0, 0))
        self.show_findings(None)

    def show_findings(
        self,
        findings: Sequence[Finding] | None,
        problem: str = "",
        mesh: Mesh | None = None,
        inverted: int = 0,
        notes: Sequence[str] = (),
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
        notes : sequence of str
            What was changed when the file was read.
        """
        paragraphs = []
        if notes:
            paragraphs.append(escape(tr("Changed on reading: {changes}", changes=" ".join(notes))))
        if findings is None:
            paragraphs.append(escape(problem or tr("Checking the mesh…")))
        if inverted:
            links = {"smooth": f'<a href="smooth">{tr("Smooth")}</a>', "pad": f'<a href="pad">{tr("Pad")}</a>'}
            hexes = tr("1 hex is") if inverted == 1 else tr("{count:,} hexes are", count=inverted)
            paragraphs.append(tr("{hexes} inverted: {smooth} or {pad}.", hexes=hexes, **links))
        elif findings is not None and not findings:
            paragraphs.append(tr("No problems found."))
        paragraphs += [_paragraph(at, finding, mesh) for at, finding in enumerate(findings or ())]
        if sum(finding.mendable for finding in findings or ()) > 1:
            paragraphs.append(f'&#8203;<a href="repair">{tr("Repair all")}</a>')
        self.text.setText("".join(f'<p style="margin: 0 0 8px">{text}</p>' for text in paragraphs))


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
