"""Panel that shows the inside of the mesh: peel, shrink, isolate, dig, outline."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QLabel, QSpinBox, QWidget

from hexmend_app.picture.appearance import Look
from hexmend_app.scene.geometry.skin import WHOLE
from hexmend_app.theme.style import check_box, icon_button, narrow, push_button, set_help, small_label, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.form import form_layout, row_of
from hexmend_app.widgets.inputs.combo import FocusedWheel
from hexmend_app.widgets.wording import counted

_MAX_SHRINK = 60  # per cent
_MAX_RINGS = 99

_PEEL = (
    "Hide the outer layers of hexes. Layer 1 contains the hexes with a face on the boundary, layer 2 the hexes that "
    "share a face with layer 1, and so on."
)
_NO_LAYERS = "No layers to peel: every hex has a face on the boundary."
_SHRINK = (
    "Shrink each hex towards its centre to see its shape and the hexes behind it. In meshes of more than "
    "{count:,} hexes, only hexes with a visible face are drawn."
)
_CUT_SMOOTHLY = "Hexes cannot be shrunk with a smooth cut: select <i>Whole hexes</i> for the cut."
_OUTLINE = "Draw the sharp edges of the boundary, paler where hexes are hidden, and the shading of rounded bodies."
_RINGS = (
    "Number of rings of translucent hexes around the isolated hexes. Ring 1 shares a node with the isolated hexes, "
    "ring 2 with ring 1, and so on."
)


class _NumberBox(FocusedWheel, QSpinBox):
    """Spin box that ignores the wheel unless focused."""


class InsidePanel(QWidget):
    """Panel that hides or shrinks hexes to show the hexes behind them.

    Attributes
    ----------
    isolated, dug, shown : QLabel
        Numbers of hexes isolated, hidden one by one and shown.

    Signals
    -------
    shrink_changed(float)
        The user changed by which fraction of their size hexes are shrunk.
    """

    shrink_changed = Signal(float)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.peel, self._shrink, self.rings = _number_box(), _number_box(), _number_box()
        self._shrink.setRange(0, _MAX_SHRINK)
        self._shrink.setSingleStep(5)
        self._shrink.setSuffix(" %")
        self.rings.setRange(0, _MAX_RINGS)
        set_help(self.rings, tr("Rings around isolated hexes"), tr(_RINGS))
        self.isolated = QLabel()
        self.all_button = push_button(tr("All"), tr("End the isolation and show all hexes."), name=tr("Show all"))
        narrow(self.all_button)
        self.dug = QLabel()
        self.undo_button = icon_button("undo", tr("Show last"), tr("Show the hex that was hidden last."))
        self.restore_button = icon_button("restore", tr("Show hidden"), tr("Show all hexes that were hidden."))
        self.outline = check_box(tr("Sharp edges and outline"), tr(_OUTLINE))
        self.shown = small_label()
        self.shown.setFont(tabular(self.shown.font()))
        self.shown.setWordWrap(False)  # wrapping would reserve a second line
        self._cut_smoothly = False
        self._lay_out()
        self._shrink.valueChanged.connect(lambda share: self.shrink_changed.emit(share / 100))
        self.set_layers(0)
        self.set_look(Look(), 1)
        self.set_shown(0, 0)

    def _lay_out(self) -> None:
        form = form_layout(self)
        form.addRow(tr("Peel"), self.peel)
        form.addRow(tr("Shrink"), self._shrink)
        form.addRow(tr("Rings"), self.rings)
        form.addRow(row_of((self.isolated, 1), self.all_button))
        form.addRow(row_of((self.dug, 1), self.undo_button, self.restore_button))
        form.addRow(self.outline)
        form.addRow(self.shown)

    def set_layers(self, layers: int) -> None:
        """Set the number of layers that can be peeled; emits no signal."""
        with QSignalBlocker(self.peel):
            self.peel.setRange(0, layers)
        set_help(self.peel, tr("Peel layers"), tr(_PEEL) if layers else tr(_NO_LAYERS))
        self.peel.setEnabled(layers > 0)

    def set_look(self, look: Look, rings: int, noun: str = "hex") -> None:
        """Show the settings of a look and the number of rings, with a noun for cells; emits no signal."""
        show, isolate = look.show, look.show.isolate
        self._cut_smoothly = look.cut.smooth
        self._shrink.setEnabled(not self._cut_smoothly)
        help = tr(_CUT_SMOOTHLY) if self._cut_smoothly else tr(_SHRINK, count=WHOLE)
        set_help(self._shrink, tr("Shrink hexes"), help)
        values = (self.peel, show.peel), (self._shrink, round(100 * show.shrink)), (self.rings, rings)
        for box, value in values:
            if box.value() != value:  # setValue would overwrite text being typed
                with QSignalBlocker(box):
                    box.setValue(value)
        isolated = 0 if isolate is None else len(isolate.hexes)
        self.isolated.setText(
            tr("{count} isolated", count=counted(isolated, noun)) if isolated else tr("No hexes isolated")
        )
        self.all_button.setEnabled(isolate is not None)
        self.dug.setText(
            tr("{count} hidden", count=counted(len(show.hidden), noun)) if show.hidden else tr("No hexes hidden")
        )
        for button in (self.undo_button, self.restore_button):
            button.setEnabled(bool(show.hidden))
        self.outline.setChecked(show.outline)

    def set_shown(self, shown: int, total: int, noun: str = "hex") -> None:
        """Show the number of hexes drawn, whole or in part, out of `total`; 0 of 0 without a mesh."""
        count = counted(total, noun)
        if not total:
            self.shown.clear()
        elif shown and self._cut_smoothly:
            self.shown.setText(tr("{shown:,} of {count} shown (before the cut)", shown=shown, count=count))
        else:
            self.shown.setText(tr("{shown:,} of {count} shown", shown=shown, count=count))


def _number_box() -> _NumberBox:
    box = _NumberBox()
    box.setFont(tabular(box.font()))
    box.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    return box
