"""Feature that inserts a layer of hexes under the boundary."""

from __future__ import annotations

from collections.abc import Iterable

from hexmend.padding import Padding
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.features.pad.pad_dialog import PadDialog
from hexmend_app.host import ChangeReport
from hexmend_app.translation import tr


class FeaturePad(Feature):
    """Asks for the options of a layer, and pads the mesh in the background."""

    def __init__(self, host: Host):
        super().__init__(host)
        ChangeReport(
            host,
            self.session.padder,
            key="pad",
            working=tr("Padding mesh…"),
            cancel_help=tr("Cancel the padding. The mesh does not change."),
            failed=tr("Mesh not padded"),
            cancelled=tr("Padding cancelled."),
        )
        self.session.padder.ended.connect(self._on_ended)

    def actions(self) -> Iterable[Action]:
        """Yield the action that pads the mesh."""
        yield Action(
            id="pad",
            text=tr("&Pad…"),
            menu="Edit",
            section=1,
            icon="layers-plus",
            help=tr("Insert a layer of hexes under the boundary to free locked hexes. Can be undone."),
            handle=self.ask,
            enabled=lambda: self.session.editable,
        )

    def ask(self) -> None:
        """Ask for the options of the layer, and pad the mesh."""
        now = self.session.document.now
        dialog = PadDialog(now.mesh, now.summary.locked_inverted, now.summary.inverted, self.host.dialog_parent)
        accepted, choice = dialog.exec(), dialog.choice()
        dialog.deleteLater()
        if accepted:
            self.session.commands.pad(choice)

    def _on_ended(self, padding: Padding) -> None:
        """Show how many hexes were inverted before and after, and about the layer."""
        before, after = padding.before.inverted, padding.after.inverted
        title = tr("{before:,} → {after:,} inverted", before=before, after=after)
        self.host.messages.show_result(title, padding.message, (), 0 if after else 12_000)
