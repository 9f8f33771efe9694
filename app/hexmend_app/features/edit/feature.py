"""Undo and redo."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend_app.feature import Action, Feature


class FeatureEdit(Feature):
    """Takes changes of the mesh back, and does them again."""

    order = 20

    def actions(self) -> Sequence[Action]:
        """Undo and redo, each with what it is about."""
        commands = self.session.commands
        return (
            Action(
                id="undo",
                text="&Undo",
                menu="Edit",
                keys="Ctrl+Z",
                icon="undo",
                help="Take back the last change of the mesh.",
                tool="Undo",
                handle=commands.undo,
                enabled=lambda: self.session.editable and self._undo is not None,
                title=lambda: f"&Undo {self._undo or ''}".strip(),
            ),
            Action(
                id="redo",
                text="&Redo",
                menu="Edit",
                keys="Ctrl+Shift+Z",
                icon="redo",
                help="Do again what was taken back.",
                tool="Redo",
                handle=commands.redo,
                enabled=lambda: self.session.editable and self._redo is not None,
                title=lambda: f"&Redo {self._redo or ''}".strip(),
            ),
        )

    @property
    def _undo(self) -> str | None:
        document = self.session.document
        return self.session.node_sweep.title or (document.undo_title if document.is_open else None)

    @property
    def _redo(self) -> str | None:
        return self.session.document.redo_title if self.session.document.is_open else None
