"""Feature that inserts a layer of hexes under the boundary."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtWidgets import QDialog, QDialogButtonBox, QVBoxLayout, QWidget

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import set_names
from hexmend.padding import Padding
from hexmend.parameters import Parameter
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.host import ChangeReport
from hexmend_app.state.tasks.mesh_change import PaddingChoice
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import small_label
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.parameter_form import ParameterForm

_WHERE = "Insert the layer under the whole boundary, under the faces of a set, or around hexes."
_RINGS = "Number of rings of hexes that a layer around hexes encloses."
_THICKNESS = "Thickness of the layer in mesh units. Automatic: best for the quality of the hexes."
#: Largest thickness in mean edge lengths.
_MAX_THICKNESS = 2.0
_AUTOMATIC = "automatic"
#: Minimum width in pixels.
_WIDTH = 380


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


class PadDialog(QDialog):
    """Dialog that edits the options of a layer.

    Parameters
    ----------
    mesh : Mesh
    locked, inverted : int
        Number of its locked and inverted hexes.

    Attributes
    ----------
    form : ParameterForm
    """

    def __init__(self, mesh: Mesh, locked: int, inverted: int, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(tr("Pad"))
        self._places: dict[str, tuple[str | None, str | None]] = {tr("Whole boundary"): (None, None)}
        if locked:
            self._places[tr("Around the {count:,} locked hexes", count=locked)] = None, "locked"
        if inverted:
            self._places[tr("Around the {count:,} inverted hexes", count=inverted)] = None, "inverted"
        self._places |= {tr("Set {name}", name=name): (name, None) for name in set_names(mesh)}
        places, thickest = tuple(self._places), _MAX_THICKNESS * mesh.mean_edge_length
        declarations = (
            Parameter("where", str, places[0], choices=places, titles=places, help=_WHERE),
            Parameter("rings", int, 1, 0, 20, help=_RINGS),
            Parameter("thickness", float, _AUTOMATIC, 0, thickest, automatic=_AUTOMATIC, help=_THICKNESS),
        )
        self.form = ParameterForm(declarations, has_buttons=False)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        buttons.addButton(tr("Pad"), QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        text = tr("Insert a layer of new hexes under the boundary, then run Mend. The boundary does not change.")
        fill(QVBoxLayout(self), small_label(text), self.form, buttons)
        self.setMinimumWidth(_WIDTH)

    def accept(self) -> None:
        """Close unless a value is invalid."""
        if self.form.problems():
            self.form.focus_problem()
        else:
            super().accept()

    def choice(self) -> PaddingChoice:
        """Return the selected options."""
        values = self.form.values()
        thickness = None if values["thickness"] == _AUTOMATIC else values["thickness"] or None
        return PaddingChoice(*self._places[values["where"]], values["rings"], thickness)
