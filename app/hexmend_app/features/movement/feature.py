"""Displacement of the mesh since a reference: arrows and counts."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from hexmend_app.feature import Feature, Host, Panel, PanelPlace
from hexmend_app.picture.appearance import Arrows, Traces
from hexmend_app.picture.displacement import Displacement, DisplacementCounts
from hexmend_app.scene.layers.arrows import MAX_ARROWS
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import set_help, small_label
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.key_form import KeyForm
from hexmend_app.widgets.wording import counted, figure, short_number


class FeatureMovement(Feature):
    """Shows the displacement of the nodes since a reference state."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._document, view = self.session.document, self.session.view
        self._view = view
        panel = self.panel = MovementPanel()
        panel.traces_changed.connect(lambda traces: view.change(movement=traces))
        panel.show_newly.clicked.connect(self._show_newly_invalid)

    def panels(self) -> Iterable[Panel]:
        """Yield the panel of the displacement."""
        yield Panel(
            id="movement",
            title=tr("Movement"),
            widget=self.panel,
            place=PanelPlace.TOOLS,
            tab=tr("Look"),
            order=22,
            help=tr("Displacement of the nodes and change of quality since a reference state."),
        )

    def refresh(self) -> None:
        """Show the settings of the view, the counts of moved nodes and the number of arrows."""
        self.panel.setEnabled(self._document.is_open)
        self.panel.set_traces(self._view.look.movement)
        if not (self.panel.isVisible() and self._document.is_open):
            return
        displacement = self._displacement
        if self._seen.changed("counts", displacement):
            name = displacement.before.name
            self.panel.set_counts(displacement.counts, name, self._document.now.summary.free_nodes)
        if self.canvas is not None:
            layer = self.canvas.viewport.overlay_layers.arrows
            self.panel.set_arrows(layer.drawn, layer.moved)

    @property
    def _displacement(self) -> Displacement:
        return self.session.comparison_bases.displacement(self._view.look.movement.since)

    def _show_newly_invalid(self) -> None:
        self._view.isolate_group("newly invalid", self._displacement)


class MovementPanel(QWidget):
    """Sets how a displacement is displayed, and shows its size.

    Attributes
    ----------
    form : KeyForm
    show_newly : QPushButton

    Signals
    -------
    traces_changed(Traces)
        The user changed the reference state or the arrows.
    """

    traces_changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._traces = Traces()
        self.form = KeyForm(self._traces, ("since", "arrows", "factor"))
        self.show_newly = QPushButton(tr("Show newly invalid"))
        self._drawn, self._counts = small_label(), small_label()
        self._drawn.setAccessibleName(tr("Number of arrows"))
        self._counts.setAccessibleName(tr("Counts of the movement"))
        parts = (self.form, self._drawn, self._counts, self.show_newly)
        fill(QVBoxLayout(self), *parts, margins=(0, 0, 0, 0), spacing=4)
        self.form.changed.connect(self._on_changed)
        self.set_traces(self._traces)
        self.set_counts(None, "", 0)
        self.set_arrows(0, 0)

    def set_traces(self, traces: Traces) -> None:
        """Show the reference state and the arrows, without emitting a signal."""
        if traces != self._traces:
            self._traces = traces
            self.form.show_table(traces)
        self.form.editors["factor"].setEnabled(traces.arrows is not Arrows.NONE)

    def set_arrows(self, drawn: int, moved: int) -> None:
        """Show the number of arrows that are drawn, of `moved` nodes."""
        self._drawn.setText(arrows_in_words(self._traces, drawn, moved))

    def set_counts(self, counts: DisplacementCounts | None, name: str, free: int) -> None:
        """Show the size of the displacement.

        Parameters
        ----------
        counts : DisplacementCounts or None
            None if no mesh is open.
        name : str
            Name of the reference state.
        free : int
            Number of free nodes.
        """
        enabled = counts is not None and counts.newly_invalid > 0
        self.show_newly.setEnabled(enabled)
        help = tr("Show only the hexes that became invalid since the reference state; Esc shows all hexes again.")
        set_help(self.show_newly, tr("Show newly invalid"), help if enabled else tr("No hex is newly invalid."))
        self._counts.setText(tr("No mesh is open.") if counts is None else counts_in_words(counts, name, free))

    def _on_changed(self) -> None:
        if not self.form.problems():
            table: Any = self.form.table(self._traces)
            self._traces = table
            self.traces_changed.emit(table)


def arrows_in_words(traces: Traces, drawn: int, moved: int) -> str:
    """Describe the number and length of the arrows.

    >>> arrows_in_words(Traces(arrows=Arrows.ALL, factor=10), 5000, 28899)
    'The 5,000 longest of 28,899 arrows, 10 × true length.'
    >>> arrows_in_words(Traces(arrows=Arrows.ALL), 1, 1)
    '1 arrow, true length.'
    """
    if traces.arrows is Arrows.NONE:
        return tr("At most the {max_arrows:,} longest arrows are drawn.", max_arrows=MAX_ARROWS)
    if not drawn:
        return tr("No visible node has moved.") if traces.arrows is Arrows.SIGHT else tr("No shown node has moved.")
    number = (
        tr("The {drawn:,} longest of {moved:,} arrows", drawn=drawn, moved=moved)
        if drawn < moved
        else counted(drawn, "arrow")
    )
    factor = "" if traces.factor == 1 else f"{short_number(traces.factor)} × "
    return tr("{number}, {factor}true length.", number=number, factor=factor)


def counts_in_words(counts: DisplacementCounts, name: str, free: int) -> str:
    """Describe the nodes that have moved since a reference state, and the hexes whose quality has changed."""
    slid = tr(" and {count:,} boundary", count=counts.slid) if counts.slid else ""
    values = {"moved": counts.moved - counts.slid, "free": free, "slid": slid, "name": tr(name)}
    sentences = [tr("{moved:,} of {free:,} free{slid} nodes moved since {name}.", **values)]
    if counts.moved:
        lengths = {"mean": figure(counts.mean), "most": figure(counts.largest)}
        sentences.append(tr("Mean {mean}, at most {most} mean edge lengths.", **lengths))
    sentences.append(tr("{better:,} hexes better, {worse:,} worse.", better=counts.better, worse=counts.worse))
    changes = {"newly": counts.newly_invalid, "repaired": counts.mended}
    sentences.append(tr("{newly:,} newly invalid, {repaired:,} repaired.", **changes))
    return "\n".join(sentences)
