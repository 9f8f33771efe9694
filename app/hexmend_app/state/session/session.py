"""The state of a window."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal, SignalInstance

from hexmend_app.state.session.commands import Commands
from hexmend_app.state.session.session_parts import SessionParts
from hexmend_app.state.tasks.mesh_change import MeshPadder, MeshRepairer
from hexmend_app.state.tasks.mesh_saver import MeshSaver

if TYPE_CHECKING:
    from hexmend_app.state.session.restored_picture import RestoredPicture


class Session(SessionParts):
    """The state of a window, and the commands that change it.

    Signals
    -------
    changed
        A signal of any part was emitted.

    Attributes
    ----------
    saver : MeshSaver
    repairer : MeshRepairer
    padder : MeshPadder
    commands : Commands
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.saver = MeshSaver(self)
        self.repairer = MeshRepairer(self)
        self.padder = MeshPadder(self)
        self._changing += [self.repairer, self.padder]
        self.commands = Commands(self, self.saver, self.repairer, self.padder)
        self.opener.loaded.connect(self.restore)
        self.opener.restored.connect(self._show_as_picture)
        for part in self.children():
            for signal in _signals(part):
                signal.connect(self.changed)

    def _show_as_picture(self, restored: RestoredPicture) -> None:
        """Show the mesh as in a picture: appearance, other states next to it, selected hex, camera and recipe."""
        metadata, show = restored.metadata, restored.look.show
        self.view.show_as(replace(restored.look, show=show.with_keys(marked=frozenset())))
        self.selection.choose(min(show.marked, default=None))
        for other in restored.others:
            if other.state is not None:
                self.side_views.show(other.name, other.state)
        if restored.wipe_position is not None:
            self.side_views.set_wiping(True)
            self.side_views.move_wipe(restored.wipe_position)
        self.camera_request.request(metadata.scene.camera_of(metadata.panels[0]))
        self.saved_cameras.add_all(metadata.scene.cameras)
        if metadata.recipe is not None:
            self.recipe_draft.load(metadata.recipe)


def _signals(part: QObject) -> list[SignalInstance]:
    """Return the signals that a part of the state declares."""
    names = {name for cls in type(part).mro() if cls is not QObject for name, value in vars(cls).items()
             if isinstance(value, Signal)} - {"destroyed", "objectNameChanged"}  # fmt: skip
    return [getattr(part, name) for name in sorted(names)]
