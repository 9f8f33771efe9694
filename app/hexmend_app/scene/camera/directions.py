"""Where to look from, and what is up."""

from __future__ import annotations

import pyvista as pv

#: Directions to look from: the place of the camera, and what is up.
VIEWS: dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]] = {
    "iso": ((1.0, -1.3, 0.8), (0.0, 0.0, 1.0)),
    "+x": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "-x": ((-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "+y": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "-y": ((0.0, -1.0, 0.0), (0.0, 0.0, 1.0)),
    "+z": ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
    "-z": ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0)),
}


def look_along(camera: pv.Camera, direction: str | tuple[float, float, float]) -> None:
    """Look at the origin from a direction: a name of `VIEWS`, or a vector, with z up where it can be."""
    if isinstance(direction, str):
        place, up = VIEWS[direction]
    else:
        place, up = direction, (0.0, 0.0, 1.0) if any(direction[:2]) else (0.0, 1.0, 0.0)
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(place)
    camera.SetViewUp(up)
