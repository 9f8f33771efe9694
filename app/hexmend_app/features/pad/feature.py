"""Feature that inserts a layer of hexes under the boundary."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend.errors import HexmendError
from hexmend.padding import Padding
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.features.pad.pad_dialog import PadDialog
from hexmend_app.translation import tr


class FeaturePad(Feature):
    """Asks for the options of a layer, and pads the mesh in the background."""

    order = 54

    def __init__(self, host: Host):
        super().__init__(host)
        padder = self.session.padder
        padder.began.connect(self._on_began)
        padder.ended.connect(self._on_ended)
        padder.failed.connect(self._on_failed)
        padder.cancelled.connect(self._on_cancelled)

    def actions(self) -> Sequence[Action]:
        """Return the action that pads the mesh."""
        return (
            Action(
                id="pad",
                text=tr("&Pad…"),
                menu="Edit",
                part=1,
                icon="layers-plus",
                help=tr("Insert a layer of hexes under the boundary to free locked hexes. Can be undone."),
                handle=self.ask,
                enabled=lambda: self.session.editable,
            ),
        )

    def ask(self) -> None:
        """Ask for the options of the layer, and pad the mesh."""
        now = self.session.document.now
        dialog = PadDialog(now.mesh, now.summary.locked_inverted, now.summary.inverted, self.host.dialog_parent)
        accepted, choice = dialog.exec(), dialog.choice()
        dialog.deleteLater()
        if accepted:
            self.session.commands.pad(choice)

    def _on_began(self) -> None:
        help = tr("Cancel the padding. The mesh does not change.")
        self.host.busy.show_work("pad", tr("Padding mesh…"), tr("Cancel"), help, self.session.padder.cancel)
        self.host.refresh_soon()

    def _on_ended(self, padding: Padding) -> None:
        self.host.busy.done("pad")
        shown = {"timeout_ms": 0} if padding.after.inverted else {}  # what is left is read with care
        self.host.messages.show_info(padding.message, **shown)
        self.host.refresh_soon()

    def _on_failed(self, error: Exception) -> None:
        self.host.busy.done("pad")
        self.host.refresh_soon()
        if not isinstance(error, HexmendError):
            raise error
        self.host.messages.show_error(tr("Mesh not padded"), str(error))

    def _on_cancelled(self) -> None:
        self.host.busy.done("pad")
        self.host.messages.show_info(tr("Padding cancelled."))
        self.host.refresh_soon()
