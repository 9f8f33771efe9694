"""Planes and boxes of cuts as values without Qt and VTK."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend_app.codec.config_table import ConfigTable
from hexmend_app.codec.option import option
from hexmend_app.picture.camera_pose import Vector

#: Angle in degrees within which a plane that is rotated by hand snaps to an axis.
SNAP = 8.0

_AXES = np.eye(3)
_ROUNDING = 1e-15
_MARGIN = 1e-9  # of the diagonal of a box


@dataclass(frozen=True)
class Plane(ConfigTable):
    """Plane of a cut, which hides the side that its normal points to.

    Parameters
    ----------
    normal : Vector
        Normal of the plane, of any length; it is normalised.
    position : float, optional
        Position along the normal, from 0 at one end of the mesh to 1 at the other; by default 0.5.
    point : Vector, optional
        Point of the plane, in the unit of the mesh, instead of a position.
    """

    normal: Vector = option((1.0, 0.0, 0.0))
    position: float | None = option(low=0, high=1)
    point: Vector | None = option()

    def __post_init__(self) -> None:
        super().__post_init__()
        length = math.hypot(*self.normal)
        if abs(length - 1) >= _ROUNDING:  # copies of a plane are identical
            object.__setattr__(self, "normal", tuple(c / length for c in self.normal))

    def check(self) -> None:
        """Raise `ParameterError` unless there is a nonzero normal and at most one of position and point."""
        if self.position is not None and self.point is not None:
            raise ParameterError("the plane has a position and a point: expected one of them")
        if not math.hypot(*self.normal) > 0:
            raise ParameterError("normal = [0, 0, 0] is no direction: expected a nonzero vector")

    def on(self, mesh: Mesh) -> Plane:
        """Return the plane with a point in a mesh instead of a position."""
        if self.point is not None:
            return self
        normal = np.array(self.normal)
        along = mesh.points[mesh.topology.used] @ normal
        share = 0.5 if self.position is None else self.position
        offset = along.min() + share * (along.max() - along.min())
        return Plane(self.normal, point=tuple((normal * offset / (normal @ normal)).tolist()))

    @cached_property
    def equation(self) -> tuple[np.ndarray, float]:
        """Normal, (3,), and offset; points x of the plane satisfy x . normal = offset. The plane has a point."""
        return np.array(self.normal), float(np.dot(self.normal, self.point))

    def signed_distance(self, points: np.ndarray) -> np.ndarray:
        """Return the distances of points, (k, 3), from the plane, positive beyond it."""
        normal, offset = self.equation
        return np.asarray(points) @ normal - offset

    def flipped(self) -> Plane:
        """Return the plane with the opposite normal."""
        return dataclasses.replace(self, normal=tuple(-c for c in self.normal))

    def snapped(self, degrees: float = SNAP) -> Plane:
        """Return the plane with its normal along an axis if they differ by at most `degrees`; else the plane itself."""
        size = np.abs(self.normal)
        axis = int(size.argmax())
        if size[axis] < np.cos(np.radians(degrees)):
            return self
        return dataclasses.replace(self, normal=tuple(np.sign(self.normal[axis]) * _AXES[axis]))


@dataclass(frozen=True)
class Box(ConfigTable):
    """Axis-aligned box of a cut.

    Parameters
    ----------
    low, high : Vector
        Lowest and highest corner, in the unit of the mesh.
    shares : bool
        Corners are fractions of the bounding box of the mesh, from 0 to 1, instead of coordinates.
    """

    low: Vector = option((0.0, 0.0, 0.0))
    high: Vector = option((1.0, 1.0, 1.0))
    shares: bool = option(False)

    def check(self) -> None:
        """Raise `ParameterError` for an invalid box."""
        if not all(a <= b for a, b in zip(self.low, self.high, strict=True)):
            raise ParameterError(f"the box goes from {self.low} to {self.high}: expected the lower corner first")
        if self.shares and not (min(self.low) >= 0 and max(self.high) <= 1):
            raise ParameterError(f"the box goes from {self.low} to {self.high}: expected fractions from 0 to 1")

    def on(self, mesh: Mesh) -> Box:
        """Return the box with coordinates in a mesh instead of fractions."""
        if not self.shares:
            return self
        points = mesh.points[mesh.topology.used]
        lowest, highest = points.min(axis=0), points.max(axis=0)
        low, high = (lowest + (highest - lowest) * share for share in (self.low, self.high))
        return Box(tuple(low.tolist()), tuple(high.tolist()))

    def sides(self, inwards: bool) -> tuple[Plane, ...]:
        """Return the planes of the sides: x low, x high, y low, ...; their normals point outwards or `inwards`.

        They lie slightly outside the box, so that faces of the mesh on its sides are inside.
        """
        orientation = -1.0 if inwards else 1.0
        low, high = np.array(self.low), np.array(self.high)
        margin = _MARGIN * float(np.linalg.norm(high - low))
        return tuple(
            Plane(tuple(sign * orientation * _AXES[axis]), point=tuple(corner))
            for axis in range(3)
            for sign, corner in ((-1.0, low - margin), (1.0, high + margin))
        )
