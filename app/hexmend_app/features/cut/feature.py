"""Feature that shows the inside of the mesh: cut, peel, isolate and dig."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace, StatePart
from hexmend_app.features.cut.cut_panel import CutPanel, CutPanelSettings
from hexmend_app.features.cut.inside_panel import InsidePanel
from hexmend_app.picture.cut import Cut
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import noun_of_cells


class FeatureCut(Feature):
    """Connects the cut panels and the handles in the view with the appearance."""

    def __init__(self, host: Host):
        super().__init__(host)
        view = self._view = self.session.view
        self.session.about_to_save.connect(self._store_remaining_hexes)
        self.panel = CutPanel()
        self.panel.cut_changed.connect(view.set_cut)
        self.panel.plane_chosen.connect(view.choose_plane)
        self.panel.handles_box.clicked.connect(view.set_handles)
        self.panel.snap_box.clicked.connect(view.set_snap)
        self.panel.at_hex.clicked.connect(self._centre_sphere)
        self._proposed: CutPanelSettings | None = None  # by a session; shown after its mesh, which resets the proposal
        self.inside = InsidePanel()
        self.inside.peel.valueChanged.connect(lambda layers: view.change(show={"peel": layers}))
        self.inside.shrink_changed.connect(lambda share: view.change(show={"shrink": share}))
        self.inside.outline.clicked.connect(lambda on: view.change(show={"outline": on}))
        self.inside.rings.valueChanged.connect(view.set_rings)
        self.inside.all_button.clicked.connect(view.end_isolation)
        self.inside.undo_button.clicked.connect(view.undig_last)
        self.inside.restore_button.clicked.connect(lambda: view.change(show={"hidden": frozenset()}))

    def actions(self) -> Iterable[Action]:
        """Yield the actions that cut, isolate and dig."""
        view, selection = self._view, self.session.selection
        yield Action(
            id="cut",
            text=tr("&Cut"),
            menu="View",
            section=1,
            keys="C",
            icon="contrast-box",
            help=tr("Cut the mesh open along planes, a box, a slab or a sphere, or by depth."),
            tool=tr("Cut"),
            handle=self._switch,
            checked=lambda: view.look.cut.active,
            in_view=True,
        )
        yield Action(
            id="isolate",
            text=tr("&Isolate hex"),
            menu="Hex",
            section=1,
            keys="I",
            help=tr("Show only the selected hex and its neighbours."),
            handle=lambda: view.isolate((selection.hex,)),
            enabled=lambda: selection.hex is not None,
            in_view=True,
        )
        yield Action(
            id="dig",
            text=tr("&Hide hex"),
            menu="Hex",
            section=1,
            keys="Delete",
            help=tr("Hide the selected hex to see behind it. Ctrl+click in the view does the same."),
            handle=lambda: self._dig(selection.hex),
            enabled=lambda: selection.hex is not None,
            in_view=True,
        )
        yield Action(
            id="undig",
            text=tr("Show &last hidden hex"),
            menu="Hex",
            section=1,
            keys="Backspace",
            help=tr("Show the hex that was hidden last."),
            handle=view.undig_last,
            enabled=lambda: bool(view.look.show.hidden),
            in_view=True,
        )

    def states(self) -> Iterable[StatePart]:
        """Yield the proposed cuts, also while nothing is cut."""
        yield StatePart(name="cut", data=CutPanelSettings, to_data=self.panel.settings, restore=self._propose)

    def panels(self) -> Iterable[Panel]:
        """Yield the cut panel and, below it, the panel that peels, shrinks and isolates."""
        yield Panel(
            id="cut",
            title=tr("Cut"),
            widget=self.panel,
            place=PanelPlace.TOOLS,
            tab=tr("Cut"),
            order=30,
            help=tr("Cut the mesh open with planes, a box, a slab or a sphere, or by depth."),
        )
        yield Panel(
            id="inside",
            title=tr("Inside"),
            widget=self.inside,
            place=PanelPlace.TOOLS,
            tab=tr("Cut"),
            order=31,
            help=tr("Peel, shrink, isolate and hide hexes."),
        )

    def canvas_ready(self) -> None:
        """Connect dragging and digging in the view."""
        self.canvas.plane_dragged.connect(self._view.drag_plane)
        self.canvas.box_dragged.connect(self._view.drag_box)
        self.canvas.sphere_dragged.connect(self._view.drag_sphere)
        self.canvas.hide_clicked.connect(self._dig)

    def refresh(self) -> None:
        """Show the current cut."""
        document, view = self.session.document, self._view
        for panel in (self.panel, self.inside):
            panel.setEnabled(document.is_open)
        if not document.is_open:
            return
        # Before set_bounds, which resets the proposal if the cut is off.
        cut = view.look.cut.with_hexes(None)
        changed = self._seen.changed("cut", document.start, cut, view.plane_at, view.handles)
        if changed or self.panel.cut() != cut:  # or switched off and on again between two refreshes
            self.panel.set_cut(cut, view.plane_at)
            self.panel.set_handles(view.handles)
        if self._seen.changed("mesh", document.start):
            mesh = document.now.mesh
            layers = int(mesh.topology.layers.max())
            self.inside.set_layers(layers)
            points = mesh.points[mesh.topology.used]
            self.panel.set_bounds(np.array([points.min(axis=0), points.max(axis=0)]), layers + 1)
        if self._proposed is not None:
            self.panel.restore(self._proposed)
            self._proposed = None
        self.panel.at_hex.setEnabled(self.session.selection.hex is not None)
        noun = noun_of_cells(document.now.mesh)
        self.inside.set_look(view.look, view.rings, noun)
        if self.canvas is not None:
            self.inside.set_shown(self.canvas.viewport.shown, document.now.mesh.n_elements, noun)

    def _store_remaining_hexes(self) -> None:
        """Store the hexes that a cut by whole hexes has left, as far as the view has drawn the mesh."""
        document = self.session.document
        filters = None if self.canvas is None else self.canvas.viewport.filters
        if filters is not None and document.is_open and filters.matches(document.now.mesh):
            frame = Frame(document.now.mesh, document.now.quality, look=self._view.look)
            self._view.store_remaining_hexes(filters.cut_left(frame))

    def _propose(self, choices: CutPanelSettings) -> None:
        self._proposed = choices

    def _switch(self, on: bool) -> None:
        if on != self._view.look.cut.active:
            self._view.set_cut(self.panel.proposal() if on else Cut())
            if on:
                self.host.show_panel("cut")

    def _centre_sphere(self) -> None:
        """Move the centre of the sphere to the selected hex."""
        mesh, h, sphere = self.session.document.now.mesh, self.session.selection.hex, self._view.look.cut.sphere
        if h is not None and sphere is not None:
            centre = mesh.points[[*dict.fromkeys(mesh.elements[h].tolist())]].mean(axis=0)
            self._view.drag_sphere(tuple(centre.tolist()), sphere.radius)

    def _dig(self, h: int) -> None:
        if h == self.session.selection.hex:
            self.session.selection.choose(None)
        self._view.dig(h)
