"""The cameras that the user keeps by name, for pictures and to come back to."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QObject, Signal

from hexmend_app.picture.camera import Camera
from hexmend_app.picture.named_cameras import NamedCameras, merged


class SavedCameras(QObject):
    """Cameras by name; they stay as another mesh is opened, so that its like is seen alike.

    Attributes
    ----------
    all : dict of Camera
        In the order of keeping; never changed in place.

    Signals
    -------
    changed
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.all: dict[str, Camera] = {}
        self._saved: dict[str, Camera] = {}

    @property
    def modified(self) -> bool:
        """True if the cameras differ from those of the session that was opened or saved last."""
        return self.all != self._saved

    def keep(self, name: str, camera: Camera) -> None:
        """Keep a camera under a name, in the place of one that had it.

        Raises
        ------
        ParameterError
            Where the name cannot be used, or there are too many.
        """
        self._take(NamedCameras({**self.all, name: camera}).named)

    def rename(self, name: str, other: str) -> None:
        """Call one otherwise, in the place of one that had that name.

        Raises
        ------
        ParameterError
            Where the name cannot be used.
        """
        others = {one: camera for one, camera in self.all.items() if one != other or one == name}
        self._take(NamedCameras({other if one == name else one: camera for one, camera in others.items()}).named)

    def remove(self, name: str) -> None:
        """Keep one no longer."""
        self._take({one: camera for one, camera in self.all.items() if one != name})

    def add_all(self, cameras: Mapping[str, Camera]) -> None:
        """Keep those of a scene too."""
        self._take(merged(self.all, cameras))

    def to_data(self) -> NamedCameras:
        """Return the data for a session file."""
        return NamedCameras(self.all)

    def restore(self, data: NamedCameras) -> None:
        """Restore the cameras of a session file; they count as not saved yet."""
        self._saved = {}
        self._take(data.named)

    def saved(self, kept: NamedCameras | None = None) -> None:
        """Remember that a session was written with these, or with those of now."""
        self._saved = self.all if kept is None else kept.named

    def _take(self, all: dict[str, Camera]) -> None:
        if list(all.items()) != list(self.all.items()):
            self.all = all
            self.changed.emit()
