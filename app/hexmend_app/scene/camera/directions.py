"""View directions and the vertical axis."""

from __future__ import annotations

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera

Vector = tuple[float, float, float]

#: Vertical axes by name: the axis, and the up vector of views along this axis.
UPS: dict[str, tuple[Vector, Vector]] = {
    "x": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "y": ((0.0, 1.0, 0.0), (0.0, 0.0, -1.0)),
    "z": ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
}

#: Direction of the isometric view, by vertical axis.
_CORNERS: dict[str, Vector] = {"x": (0.8, 1.0, -1.3), "y": (1.0, 0.8, 1.3), "z": (1.0, -1.3, 0.8)}

#: Sine of the angle to the vertical axis below which a direction counts as parallel to it.
_PARALLEL = 1e-6


def direction_of(name: str | Vector, up: str) -> Vector:
    """Return the direction of a name of `DIRECTIONS`, or the given vector; `up` is a name of `UPS`."""
    if not isinstance(name, str):
        return name
    if name == "iso":
        return _CORNERS[up]
    sign = -1.0 if name.startswith("-") else 1.0
    return tuple((sign * np.array(UPS[name[1:]][0])).tolist())


def up_in(direction: Vector, up: str) -> Vector:
    """Return the up vector of a view from a direction: the vertical axis unless that is parallel to it."""
    axis, alternative = UPS[up]
    across = np.linalg.norm(np.cross(direction, axis))
    return axis if across > _PARALLEL * np.linalg.norm(direction) else alternative


def look_from(camera: vtkCamera, name: str | Vector, up: str) -> None:
    """Make a camera look at the origin from a direction.

    Parameters
    ----------
    camera : vtkCamera
    name : str or (x, y, z)
        One of `DIRECTIONS`, or a vector.
    up : str
        The vertical axis: x, y or z.
    """
    direction = direction_of(name, up)
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(direction)
    camera.SetViewUp(up_in(direction, up))
