"""Cameras, their poses and names, and panels of a scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import astuple, dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError, ParameterError
from hexmend_app.codec.conversion import ConfigTable, decode, option

#: Names of view directions.
DIRECTIONS = ("iso", "+x", "-x", "+y", "-y", "+z", "-z")
#: Maximum number of meshes and of panels of a scene.
MAX_PANELS = 12
Vector = tuple[float, float, float]
#: Maximum difference of poses that give the same picture, relative to the distance from the focal point.
_TOLERANCE = 1e-6
#: Maximum number of named cameras of a scene or a window.
MAX_CAMERAS = 100
#: Key in session files.
_KEY = "saved_cameras"


@dataclass(frozen=True)
class CameraPose:
    """Position, direction and projection of a camera.

    Parameters
    ----------
    position, focal, up : (x, y, z)
        Position, focal point, which is also the centre of rotation, and up vector.
    parallel : bool
        Parallel projection instead of perspective.
    scale : float
        Half the height of the picture in parallel projection, in the unit of the mesh.
    axis : str
        Vertical axis of standard views: x, y or z. It does not affect the picture.
    """

    position: Vector
    focal: Vector
    up: Vector
    parallel: bool
    scale: float
    axis: str

    def __post_init__(self) -> None:
        position, focal, up, _, scale, axis = astuple(self)
        if not np.isfinite([*position, *focal, *up, scale]).all() or position == focal or not any(up) or scale <= 0:
            raise ValueError(
                "the camera pose is invalid: expected finite numbers, a position other than the focal point, a nonzero"
                " up vector and a positive scale"
            )
        if axis not in ("x", "y", "z"):
            raise ValueError(f"the vertical axis is {axis!r}: expected x, y or z")

    @property
    def distance(self) -> float:
        """Distance from the camera to its focal point."""
        return float(np.linalg.norm(np.subtract(self.focal, self.position)))

    def looks_like(self, other: CameraPose) -> bool:
        """Return True if both poses give the same picture, up to rounding."""
        unit = max(self.distance, other.distance)
        mine, others = (
            np.array([*pose.position, *pose.focal, *np.multiply(unit, pose.up), pose.scale]) for pose in (self, other)
        )
        return self.parallel == other.parallel and bool(np.abs(mine - others).max() <= _TOLERANCE * unit)


@dataclass(frozen=True)
class Camera(ConfigTable):
    """Camera of a scene: a direction, from which the whole mesh is visible, or an exact pose.

    Parameters
    ----------
    from_ : str or Vector, optional
        View direction: iso (default), +x, -x, +y, -y, +z, -z, or a vector.
    up : str
        Vertical axis: x, y or z.
    parallel : bool
        Parallel projection instead of perspective.
    position, focal, view_up : Vector, optional
        Exact pose: position of the camera, focal point, and up vector of the picture.
    scale : float, optional
        Exact pose: half the height of the picture in parallel projection.
    """

    from_: str | Vector | None = option()
    up: str = option("z")
    parallel: bool = option(False)
    position: Vector | None = option()
    focal: Vector | None = option()
    view_up: Vector | None = option()
    scale: float | None = option()

    def check(self) -> None:
        """Raise `ParameterError` unless there is a valid direction or a complete pose."""
        if isinstance(self.from_, str):
            if self.from_ not in DIRECTIONS:
                known = ", ".join(DIRECTIONS)
                raise ParameterError(f"from = {self.from_!r} is unknown: expected {known}, or a direction [x, y, z]")
        elif self.from_ is not None and not any(self.from_):
            raise ParameterError("from = [0, 0, 0] is no direction: expected a nonzero vector")
        if self.up not in ("x", "y", "z"):
            raise ParameterError(f"up = {self.up!r} is unknown: expected x, y or z")
        given = [value is not None for value in (self.position, self.focal, self.view_up, self.scale)]
        if any(given):
            if self.from_ is not None:
                raise ParameterError("the camera has a direction and an exact pose: expected one of them")
            if not all(given):
                raise ParameterError("the exact pose is incomplete: expected position, focal, view_up and scale")
            self._exact_pose()

    def _exact_pose(self) -> CameraPose:
        try:
            return CameraPose(self.position, self.focal, self.view_up, self.parallel, self.scale, self.up)
        except ValueError as error:
            raise ParameterError(str(error)) from None

    @property
    def direction(self) -> str | Vector:
        """View direction if there is no exact pose."""
        return DIRECTIONS[0] if self.from_ is None else self.from_

    @property
    def pose(self) -> CameraPose | None:
        """Exact pose; None if a direction is given."""
        return None if self.position is None else self._exact_pose()

    @classmethod
    def at(cls, pose: CameraPose) -> Camera:
        """Return the camera with a pose."""
        return cls(
            up=pose.axis,
            parallel=pose.parallel,
            position=pose.position,
            focal=pose.focal,
            view_up=pose.up,
            scale=pose.scale,
        )


@dataclass(frozen=True)
class WipeLayout(ConfigTable):
    """Second mesh of a panel, shown on the right side of an edge.

    Parameters
    ----------
    mesh : int
        Number of the mesh on the command line, from 1.
    at : float
        Position of the edge as a fraction of the width.
    caption : str
        Caption of the second mesh; by default the name of its file.
    """

    mesh: int = option(2, low=1, high=MAX_PANELS)
    at: float = option(0.5, low=0, high=1)
    caption: str = option("")


@dataclass(frozen=True)
class PicturePanel(ConfigTable):
    """Picture on a page.

    Parameters
    ----------
    camera : str
        Name of a camera of [cameras]; by default [camera].
    mesh : int
        Number of the mesh on the command line, from 1.
    caption : str
        Caption; by default the name of the file of the mesh.
    wipe : WipeLayout, optional
        Second mesh, shown on the right side of an edge.
    """

    camera: str = option("")
    mesh: int = option(1, low=1, high=MAX_PANELS)
    caption: str = option("")
    wipe: WipeLayout | None = option()


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
