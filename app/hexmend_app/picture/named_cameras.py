"""Named cameras of windows, session files and scenes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from hexmend.errors import FileError, ParameterError
from hexmend_app.codec.conversion import ConfigTable, decode, option
from hexmend_app.picture.camera import Camera

#: Maximum number of named cameras of a scene or a window.
MAX_CAMERAS = 100

#: Key in session files.
_KEY = "saved_cameras"


@dataclass(frozen=True)
class NamedCameras(ConfigTable):
    """Table of cameras by name.

    Parameters
    ----------
    named : dict of Camera
    """

    named: dict[str, Camera] = option(dict, most=MAX_CAMERAS)

    def check(self) -> None:
        """Raise `ParameterError` for empty names and names with surrounding spaces."""
        for name in self.named:
            if not name or name != name.strip():
                raise ParameterError(
                    f"{name!r} is not a valid name of a camera: expected a text without surrounding spaces"
                )


def merged(mine: Mapping[str, Camera], others: Mapping[str, Camera]) -> dict[str, Camera]:
    """Return cameras with others added, at most `MAX_CAMERAS`; a different camera with the same name gets a number.

    >>> list(merged({"a": Camera("+x")}, {"a": Camera("+y"), "b": Camera("+x")}))
    ['a', 'a (2)', 'b']
    >>> list(merged({"a": Camera("+x")}, {"a": Camera("+x")}))
    ['a']
    """
    cameras = dict(mine)
    for name, camera in others.items():
        candidates = (name, *(f"{name} ({k})" for k in range(2, MAX_CAMERAS + 2)))
        free = next((candidate for candidate in candidates if cameras.get(candidate, camera) == camera), None)
        if free is not None and (free in cameras or len(cameras) < MAX_CAMERAS):
            cameras[free] = camera
    return cameras


def cameras_of(path: str | Path) -> dict[str, Camera]:
    """Return the named cameras of a session file.

    Raises
    ------
    FileError
        If the file cannot be read, or its cameras are invalid.
    """
    from hexmend_app.formats.session.session_file import read_session

    window = read_session(path).window
    data = window.get(_KEY) if isinstance(window, dict) else None
    try:
        return decode(NamedCameras, data, (_KEY,)).named
    except ParameterError as error:
        raise FileError(Path(path), f"has invalid cameras: {error}", "Use an earlier copy.") from None
