"""Pose of a camera."""

from __future__ import annotations

from dataclasses import astuple, dataclass

import numpy as np

Vector = tuple[float, float, float]

#: Maximum difference of poses that give the same picture, relative to the distance from the focal point.
_TOLERANCE = 1e-6


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
