"""Where a camera stands and what it looks at, as a value."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from vtkmodules.vtkRenderingCore import vtkCamera

Vector = tuple[float, float, float]

#: How far poses are apart, in distances from the focal point, that nobody tells apart.
_NOTHING = 1e-6


@dataclass(frozen=True)
class Pose:
    """A camera's pose.

    Parameters
    ----------
    position, focal : (x, y, z)
        Where it is, and the point that it looks at and turns about.
    up : (x, y, z)
        What is up in the picture.
    parallel : bool
        Parallel projection instead of perspective.
    scale : float
        Half the height of the picture in parallel projection, in the mesh's unit.
    """

    position: Vector
    focal: Vector
    up: Vector
    parallel: bool
    scale: float

    @classmethod
    def of(cls, camera: vtkCamera) -> Pose:
        """That of a camera now."""
        return cls(
            camera.GetPosition(),
            camera.GetFocalPoint(),
            camera.GetViewUp(),
            bool(camera.GetParallelProjection()),
            camera.GetParallelScale(),
        )

    def give(self, camera: vtkCamera) -> None:
        """Bring a camera there."""
        camera.SetFocalPoint(self.focal)
        camera.SetPosition(self.position)
        camera.SetViewUp(self.up)
        camera.SetParallelProjection(self.parallel)
        camera.SetParallelScale(self.scale)

    @property
    def distance(self) -> float:
        """From the camera to what it looks at."""
        return float(np.linalg.norm(np.subtract(self.focal, self.position)))

    def looks_like(self, other: Pose) -> bool:
        """Whether the pictures from both are the same, but for what nobody sees."""
        unit = max(self.distance, other.distance)
        apart = [np.subtract(getattr(self, name), getattr(other, name)) for name in ("position", "focal")]
        return (
            self.parallel == other.parallel
            and abs(self.scale - other.scale) <= _NOTHING * max(self.scale, other.scale)
            and max(map(np.linalg.norm, apart)) <= _NOTHING * unit
            and bool(np.linalg.norm(np.subtract(self.up, other.up)) <= _NOTHING)
        )
