"""How the open mesh is looked at, as the window's one truth."""

from __future__ import annotations

import dataclasses

from PySide6.QtCore import QObject, Signal

from hexmend_app.state.look import ClipPlane, Look


class View(QObject):
    """The look of the 3D view.

    Signals
    -------
    look_changed
    """

    look_changed = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.look = Look()
        self.plane_shown = True

    def change(self, **fields: object) -> None:
        """Change fields of the look; says nothing where nothing changes."""
        look = dataclasses.replace(self.look, **fields)
        if look != self.look:
            self.look = look
            self.look_changed.emit()

    def set_clip(self, clip: ClipPlane | None) -> None:
        """Cut, move the cut, or cut no more."""
        self.change(clip=clip)

    def set_plane_shown(self, shown: bool) -> None:
        """Show or hide the plane that is dragged in the view; the cut stays."""
        if shown != self.plane_shown:
            self.plane_shown = shown
            self.look_changed.emit()
