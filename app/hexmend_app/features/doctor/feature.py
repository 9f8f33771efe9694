"""Feature that finds and repairs problems of the mesh other than its quality."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend.doctor import PROBLEMS, Finding
from hexmend.mesh.mesh import Mesh
from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace
from hexmend_app.host import ChangeReport
from hexmend_app.theme.spacing import fill
from hexmend_app.translation import tr
from hexmend_app.widgets.form import scrolled
from hexmend_app.widgets.link_label import LinkLabel


class FeatureDoctor(Feature):
    """Checks the mesh while the panel is visible, shows the problems, and repairs them."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._listed: tuple[Finding, ...] = ()
        self.panel = DoctorPanel()
        self.panel.text.linkActivated.connect(self._follow)
        ChangeReport(
            host,
            self.session.repairer,
            key="repair",
            working=tr("Repairing mesh…"),
            cancel_help=tr("Cancel the repair. The mesh does not change."),
            failed=tr("Mesh not repaired"),
            cancelled=tr("Repair cancelled."),
        )
        self.session.repairer.ended.connect(self._on_ended)

    def actions(self) -> Iterable[Action]:
        """Yield the actions that open the panel and repair all problems."""
        yield Action(
            id="doctor",
            text=tr("&Doctor"),
            menu="Edit",
            section=1,
            icon="stethoscope",
            help=tr("Find problems other than quality: numbering, unmerged blocks, duplicates."),
            handle=lambda: self.host.show_panel("doctor"),
        )
        yield Action(
            id="repair",
            text=tr("&Repair mesh"),
            menu="Edit",
            section=1,
            icon="bandage",
            help=tr("Repair numbering, unmerged blocks, duplicates and unused nodes. Can be undone."),
            handle=lambda: self.session.commands.repair([]),
            enabled=lambda: self.session.editable and self._can_repair(),
        )

    def panels(self) -> Iterable[Panel]:
        """Yield the panel of findings."""
        yield Panel(
            id="doctor",
            title=tr("Doctor"),
            widget=self.panel,
            place=PanelPlace.DRAWER,
            order=60,
            help=tr("Problems other than quality, with their location and remedy."),
        )

    def refresh(self) -> None:
        """List the findings of the current mesh if the panel is visible."""
        session = self.session
        if not session.document.is_open or not self.panel.isVisible() or session.run.busy:
            return
        mesh = session.document.now.mesh
        session.mesh_checker.ask(mesh)
        findings, error = session.mesh_checker.of(mesh), session.mesh_checker.error
        notes = session.document.start.mesh.notes
        if self._seen.changed("findings", findings, error, mesh, notes):
            self._listed = findings or ()
            problem = tr("Mesh not checked: {error}", error=error) if error else ""
            self.panel.show_findings(findings, problem, mesh, session.document.now.summary.inverted, notes)

    def _can_repair(self) -> bool:
        """Return True unless the doctor has found nothing that can be repaired."""
        findings = self.session.mesh_checker.of(self.session.document.now.mesh)
        return findings is None or any(finding.mendable for finding in findings)

    def _follow(self, link: str) -> None:
        command, _, argument = link.partition(" ")
        if command == "show":
            self._show(int(argument))
        elif command == "smooth":
            self.host.show_panel("run")
        elif command == "pad":
            self.host.action("pad").trigger()
        else:
            self.session.commands.repair([argument] if argument else [])

    def _show(self, row: int) -> None:
        finding, mesh = self._listed[row], self.session.document.now.mesh
        hexes = finding.hexes
        if not len(hexes):
            is_named = np.zeros(mesh.n_nodes, dtype=bool)
            is_named[finding.nodes] = True
            hexes = np.flatnonzero(is_named[mesh.elements].any(axis=1))
        if len(hexes):
            self.session.view.isolate(hexes.tolist())
            self.session.selection.visit(*hexes.tolist())

    def _on_ended(self, repaired: tuple[Finding, ...]) -> None:
        messages = " ".join(finding.message for finding in repaired)
        self.host.messages.show_info(
            tr("Repaired: {messages}", messages=messages) if repaired else tr("Nothing to repair.")
        )


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
