"""Feature that undoes and redoes changes of the mesh, and shows the mesh before them."""

from __future__ import annotations

from collections.abc import Iterable

from hexmend_app.feature import Action, Feature
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.translation import tr


class FeatureEdit(Feature):
    """Undoes and redoes changes of the mesh, and shows the mesh before the last one."""

    def actions(self) -> Iterable[Action]:
        """Yield undo and redo, whose texts name the change, and the comparison with the mesh before it."""
        commands, document = self.session.commands, self.session.document
        yield Action(
            id="undo",
            text=tr("&Undo"),
            menu="Edit",
            keys="Ctrl+Z",
            icon="undo",
            help=tr("Undo the last change of the mesh."),
            tool=tr("Undo"),
            handle=commands.undo,
            enabled=lambda: self.session.editable and self._undo_title is not None,
            title=lambda: tr("&Undo {title}", title=tr(self._undo_title or "")).strip(),
        )
        yield Action(
            id="redo",
            text=tr("&Redo"),
            menu="Edit",
            keys="Ctrl+Shift+Z",
            icon="redo",
            help=tr("Redo the change that was undone last."),
            tool=tr("Redo"),
            handle=commands.redo,
            enabled=lambda: self.session.editable and document.redo_title is not None,
            title=lambda: tr("&Redo {title}", title=tr(document.redo_title or "")).strip(),
        )
        yield Action(
            id="before",
            text=tr("Show &before"),
            menu="Edit",
            keys="Y",
            icon="compare-horizontal",
            help=tr("Show the mesh before the last change or run, as long as the button is held; Y switches."),
            tool=tr("Before"),
            momentary=True,
            handle=self._show_before,
            checked=lambda: document.shows_before,
            enabled=lambda: document.shows_before or self._state_before is not None,
        )

    @property
    def _state_before(self) -> MeasuredMesh | None:
        """State that the last change, or the run of the shown iteration, started from; None if there is none."""
        document, run = self.session.document, self.session.run
        if not document.is_open or (run.busy and run.following):
            return None
        shown = self.session.timeline.shown_iteration
        if document.previews:
            return document.recorded if shown is None else shown.record.start
        return document.previous

    def _show_before(self, on: bool) -> None:
        before = self._state_before
        if not on:
            self.session.document.end_before()
        elif before is not None:
            self.session.document.show_before(before)

    @property
    def _undo_title(self) -> str | None:
        """Name of the change that Undo reverts; None if there is none."""
        return self.session.node_sweep.title or self.session.document.undo_title
