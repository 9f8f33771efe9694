"""The import doctor: what is wrong with the mesh besides its shape, where, and what mends it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.doctor import Finding
from hexmend.errors import HexmendError
from hexmend_app.feature import Action, Feature, Host, Panel, Place, Seen
from hexmend_app.features.doctor.doctor_panel import DoctorPanel


class FeatureDoctor(Feature):
    """Examines the mesh where somebody looks at that, shows where its troubles are, and mends them."""

    order = 54

    def __init__(self, host: Host):
        super().__init__(host)
        self._seen = Seen()
        self._listed: tuple[Finding, ...] = ()
        self.panel = DoctorPanel()
        self.panel.show_requested.connect(self._show)
        self.panel.mend_requested.connect(self._mend)
        repairer = self.session.repairer
        repairer.began.connect(self._on_began)
        repairer.ended.connect(self._on_ended)
        repairer.failed.connect(self._on_failed)
        repairer.cancelled.connect(self._on_cancelled)

    def actions(self) -> Sequence[Action]:
        """The panel, and mending at once."""
        return (
            Action(
                id="doctor",
                text="&Doctor",
                menu="Edit",
                part=1,
                icon="stethoscope",
                help="Find what is wrong with the mesh besides its shape: numbering, unmerged blocks, duplicates.",
                handle=lambda: self.host.show_panel("doctor"),
            ),
            Action(
                id="repair",
                text="&Mend what the doctor finds",
                menu="Edit",
                part=1,
                icon="bandage",
                help="Mend numbering, unmerged blocks, duplicates and unused nodes; Undo takes it back.",
                handle=lambda: self._mend([]),
                enabled=lambda: self.session.editable,
            ),
        )

    def panels(self) -> Sequence[Panel]:
        """The findings."""
        return (
            Panel(
                id="doctor",
                title="Doctor",
                widget=self.panel,
                place=Place.DRAWER,
                order=60,
                help="What is wrong with the mesh besides its shape, where, and what mends it.",
            ),
        )

    def refresh(self) -> None:
        """List what is found in the mesh as it is, where somebody looks."""
        session = self.session
        self.panel.set_busy(not session.editable)
        if not session.document.is_open or not self.panel.isVisible() or session.smoothing.busy:
            return
        mesh = session.document.now.mesh
        session.examiner.ask(mesh)
        findings, error = session.examiner.of(mesh), session.examiner.error
        if self._seen.another("findings", findings, error, mesh):
            self._listed = findings or ()
            self.panel.show_findings(findings, f"It could not be examined: {error}" if error else "")
            self.panel.set_busy(not session.editable)

    def _show(self, row: int) -> None:
        finding, mesh = self._listed[row], self.session.document.now.mesh
        hexes = finding.hexes
        if not len(hexes):
            at = np.zeros(mesh.n_nodes, dtype=bool)
            at[finding.nodes] = True
            hexes = np.flatnonzero(at[mesh.hexes].any(axis=1))
        if len(hexes):
            self.session.view.isolate(hexes.tolist())
            self.session.selection.visit(*hexes.tolist())

    def _mend(self, kinds: list[str]) -> None:
        self.session.commands.repair(kinds)

    def _on_began(self) -> None:
        help = "Leave the mesh as it is."
        self.host.busy.show_work("repair", "Repairing the mesh…", "Cancel", help, self.session.repairer.cancel)
        self.host.refresh_soon()

    def _on_ended(self, mended: tuple[Finding, ...]) -> None:
        self.host.busy.done("repair")
        messages = " ".join(finding.message for finding in mended)
        nothing = "The doctor finds nothing that it can mend."
        self.host.messages.show_info(f"Mended: {messages}" if mended else nothing)
        self.host.refresh_soon()

    def _on_failed(self, error: Exception) -> None:
        self.host.busy.done("repair")
        self.host.refresh_soon()
        if not isinstance(error, HexmendError):
            raise error
        self.host.messages.show_error("The mesh was not repaired", str(error))

    def _on_cancelled(self) -> None:
        self.host.busy.done("repair")
        self.host.messages.show_info("The repair was cancelled.")
        self.host.refresh_soon()
