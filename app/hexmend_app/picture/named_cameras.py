"""Cameras that are kept by name: as a window has them, a session's file keeps them, and scenes name them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from hexmend.errors import FileError, ParameterError
from hexmend_app.codec.config_table import ConfigTable, decode, option
from hexmend_app.picture.camera import Camera

#: Cameras of a scene, and of a window.
MOST = 100

#: What a session's file calls them.
_FIELD = "cameras"


@dataclass(frozen=True)
class NamedCameras(ConfigTable):
    """Cameras by name.

    Parameters
    ----------
    named : dict of Camera
    """

    named: dict[str, Camera] = option(dict, most=MOST)

    def check(self) -> None:
        """Names that can be read."""
        for name in self.named:
            if not name or name != name.strip():
                raise ParameterError(f"{name!r} is no name of a camera: expected one without space around it")


def merged(mine: Mapping[str, Camera], others: Mapping[str, Camera]) -> dict[str, Camera]:
    """Cameras with those of others, as far as there is room; what is another under one name gets a number.

    >>> list(merged({"a": Camera("+x")}, {"a": Camera("+y"), "b": Camera("+x")}))
    ['a', 'a (2)', 'b']
    >>> list(merged({"a": Camera("+x")}, {"a": Camera("+x")}))
    ['a']
    """
    answer = dict(mine)
    for name, camera in others.items():
        names = (name, *(f"{name} ({k})" for k in range(2, MOST + 2)))
        free = next((one for one in names if answer.get(one, camera) == camera), None)
        if free is not None and (free in answer or len(answer) < MOST):
            answer[free] = camera
    return answer


def cameras_of(path: str | os.PathLike[str]) -> dict[str, Camera]:
    """The cameras that a session's file keeps; none of one that is older than they.

    Raises
    ------
    FileError
        Where the file cannot be read, or its cameras cannot be used.
    """
    from hexmend.io.formats.session.session_file import read_session

    window = read_session(path).window
    data = window.get(_FIELD, {}) if isinstance(window, dict) else {}
    try:
        return decode(NamedCameras, data, (_FIELD,)).named
    except ParameterError as error:
        raise FileError(Path(path), f"does not hold together: {error}", "Use an earlier copy.") from None
