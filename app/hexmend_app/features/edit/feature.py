"""Feature that undoes and redoes changes of the mesh."""

from __future__ import annotations

from collections.abc import Iterable

from hexmend_app.feature import Action, Feature
from hexmend_app.translation import tr


class FeatureEdit(Feature):
    """Undoes and redoes changes of the mesh."""

    def actions(self) -> Iterable[Action]:
        """Yield undo and redo, whose texts name the change."""
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

    @property
    def _undo_title(self) -> str | None:
        """Name of the change that Undo reverts; None if there is none."""
        return self.session.node_sweep.title or self.session.document.undo_title
