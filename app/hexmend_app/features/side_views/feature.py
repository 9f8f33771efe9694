"""Side views: states of the mesh next to the current one, side by side or wiped."""

from __future__ import annotations

from collections.abc import Iterable

from hexmend_app.canvas.view_captions import Caption
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.view.side_views import NOW
from hexmend_app.theme.palette import BLUE, KEPT, Role
from hexmend_app.translation import tr

#: Distance that a key moves the wipe, relative to the width of the view.
STEP = 0.02


class FeatureSideViews(Feature):
    """Shows states of the mesh in side views."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._views, self._snapshots = self.session.side_views, self.session.snapshots

    def actions(self) -> Iterable[Action]:
        """Yield the actions that add, wipe and close side views."""
        views, several, wiping = self._views, lambda: bool(self._views.all), lambda: self._views.wipe is not None
        yield Action(
            id="beside",
            text=tr("&Keep a copy in a side view"),
            menu="Compare",
            section=1,
            keys="V",
            icon="view-split-vertical",
            help=tr("Keep a copy of the current mesh in a side view, to compare later meshes with it."),
            handle=self._show_in_side_view,
            enabled=lambda: not views.full,
            in_view=True,
        )
        yield Action(
            id="wipe",
            text=tr("&Wipe"),
            menu="Compare",
            section=1,
            keys="W",
            icon="compare",
            help=tr("Overlay two views, separated by an edge that can be dragged."),
            handle=views.set_wiping,
            enabled=several,
            checked=wiping,
        )
        yield Action(
            id="close_views",
            text=tr("Close &other views"),
            menu="Compare",
            section=1,
            keys="Ctrl+W",
            help=tr("Show only the current mesh."),
            handle=views.close_all,
            enabled=several,
            in_view=True,
        )

    def canvas_ready(self) -> None:
        """Connect the 3D view."""
        self.canvas.frame.view_closed.connect(self._views.close_view)
        self.canvas.frame.wipe_row.chosen.connect(self._views.choose_wiped)
        self.canvas.frame.edge.moved.connect(self._views.move_wipe)
        self.canvas.frame.edge.stepped.connect(self._step_wipe)

    def refresh(self) -> None:
        """Show the side views and their captions."""
        views, document = self._views, self.session.document
        if self.canvas is None or not document.is_open:
            return
        if self._seen.changed("views", views.all, views.wipe and (views.wipe.left, views.wipe.right)):
            self.canvas.show_side_by_side([(view.state.mesh, view.state.quality) for view in views.all], views.wipe)
            self._seen.changed("wipe", views.wipe)
        elif self._seen.changed("wipe", views.wipe) and views.wipe is not None:
            self.canvas.move_wipe(views.wipe)
        now = document.now if views.all else None
        if self._seen.changed("captions", views.all, views.wipe, self._snapshots.all, now):
            self._show_captions()

    def _show_in_side_view(self) -> None:
        iteration = self.session.timeline.shown_iteration
        self._views.show(tr("earlier mesh") if iteration is None else iteration.name, self.session.document.now)

    def _step_wipe(self, direction: int) -> None:
        if self._views.wipe is not None:
            self._views.move_wipe(self._views.wipe.at + direction * STEP)

    def _show_captions(self) -> None:
        shown = [(tr(NOW), self.session.document.now, BLUE)]
        shown += [(view.name, view.state, self._colour(view.state)) for view in self._views.all]
        captions = [
            Caption(name, state.summary.q_min, state.summary.inverted, state.summary.invalid, colour)
            for name, state, colour in shown
        ]
        self.canvas.show_captions(captions, self._views.wipe)

    def _colour(self, state: MeasuredMesh) -> Role | None:
        snapshot = self._snapshots.of(state)
        return None if snapshot is None else KEPT[snapshot.slot]
