"""Cameras that the user has saved by name."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QObject, Signal

from hexmend_app.picture.camera import Camera, NamedCameras, merged


class SavedCameras(QObject):
    """Saved cameras by name; they stay when a mesh is opened, to show several meshes from the same viewpoint.

    Attributes
    ----------
    all : dict of Camera
        In the order in which they were saved; never modified in place.

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
        """True if the cameras have changed since a session was last opened or saved."""
        return self.all != self._saved

    def add(self, name: str, camera: Camera) -> None:
        """Save a camera, replacing one with the same name.

        Raises
        ------
        ParameterError
            If the name is invalid, or there are too many cameras.
        """
        self._set(NamedCameras({**self.all, name: camera}).named)

    def remove(self, name: str) -> None:
        """Remove a camera."""
        self._set({key: camera for key, camera in self.all.items() if key != name})

    def add_all(self, cameras: Mapping[str, Camera]) -> None:
        """Add the cameras of a scene; names in use get a number, and equal cameras are not added again."""
        self._set(merged(self.all, cameras))

    def to_data(self) -> NamedCameras:
        """Return the data for a session file."""
        return NamedCameras(self.all)

    def restore(self, data: NamedCameras) -> None:
        """Restore the cameras of a session file; they are not marked as saved."""
        self._saved = {}
        self._set(data.named)

    def mark_saved(self, saved: NamedCameras | None = None) -> None:
        """Mark cameras, by default the current ones, as saved in the file of the session."""
        self._saved = self.all if saved is None else saved.named

    def _set(self, all: dict[str, Camera]) -> None:
        if list(all.items()) != list(self.all.items()):
            self.all = all
            self.changed.emit()
