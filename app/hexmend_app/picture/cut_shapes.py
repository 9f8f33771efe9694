"""Planes, boxes, slabs, spheres and depths of cuts as values without Qt and VTK."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import numpy as np

from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend_app.codec.conversion import ConfigTable, option
from hexmend_app.picture.camera import Vector

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
        Normal of the plane, of any length.
    position : float, optional
        Position along the normal, as a fraction of the extent of the mesh; by default 0.5.
    point : Vector, optional
        Point of the plane, instead of a position.
    """

    normal: Vector = option((1.0, 0.0, 0.0))
    position: float | None = option(low=0, high=1)
    point: Vector | None = option()

    def __post_init__(self) -> None:
        super().__post_init__()
        length = math.hypot(*self.normal)
        if abs(length - 1) >= _ROUNDING:  # so that copies of a plane are identical
            object.__setattr__(self, "normal", tuple((np.array(self.normal) / length).tolist()))

    def check(self) -> None:
        """Raise `ParameterError` unless there is a nonzero normal and at most one of position and point."""
        if self.position is not None and self.point is not None:
            raise ParameterError(f"the {type(self).__name__.lower()} has a position and a point: expected one of them")
        if not any(self.normal):
            raise ParameterError("normal = [0, 0, 0] is no direction: expected a nonzero vector")

    def on(self, mesh: Mesh) -> Plane:
        """Return the plane with a point in a mesh instead of a position."""
        if self.point is not None:
            return self
        return Plane(self.normal, point=self._point_in(mesh)[0])

    def _point_in(self, mesh: Mesh) -> tuple[Vector, float]:
        """Return the point at the position in a mesh, and the extent of the mesh along the normal."""
        direction = np.array(self.normal)
        along = mesh.points[mesh.topology.used] @ direction
        low, extent = float(along.min()), float(np.ptp(along))
        offset = low + (0.5 if self.position is None else self.position) * extent
        return tuple((direction * offset).tolist()), extent

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
        x, y, z = self.normal
        return dataclasses.replace(self, normal=(-x, -y, -z))

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
    low : Vector
        Lowest corner.
    high : Vector
        Highest corner.
    shares : bool
        Corners are fractions of the bounding box of the mesh.
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


@dataclass(frozen=True)
class Slab(Plane):
    """Region between two planes, which are parallel to a plane in the middle.

    Parameters
    ----------
    thickness : float
        Distance of the planes: with a point a length, otherwise a fraction of the extent of the mesh.
    """

    thickness: float = option(0.1, low=0)

    def on(self, mesh: Mesh) -> Slab:
        """Return the slab with a point in a mesh, and its thickness in the unit of the mesh."""
        if self.point is not None:
            return self
        point, extent = self._point_in(mesh)
        return Slab(self.normal, point=point, thickness=self.thickness * extent)

    @property
    def middle(self) -> Plane:
        """Plane halfway between the planes."""
        return Plane(self.normal, point=self.point)

    def moved_to(self, middle: Plane) -> Slab:
        """Return the slab of the same thickness around a plane, which has a point."""
        return Slab(middle.normal, point=middle.point, thickness=self.thickness)

    def sides(self, inwards: bool) -> tuple[Plane, Plane]:
        """Return the two planes; their normals point outwards or `inwards`. The slab has a point."""
        normal, point = np.array(self.normal), np.array(self.point)
        outwards = -1.0 if inwards else 1.0
        half = 0.5 * self.thickness * normal
        low, high = tuple((point - half).tolist()), tuple((point + half).tolist())
        return Plane(tuple(-outwards * normal), point=low), Plane(tuple(outwards * normal), point=high)


@dataclass(frozen=True)
class Sphere(ConfigTable):
    """Sphere of a cut.

    Parameters
    ----------
    centre : Vector
        Centre of the sphere.
    radius : float
        Radius of the sphere.
    shares : bool
        The centre is in fractions of the bounding box of the mesh, the radius a fraction of its diagonal.
    """

    centre: Vector = option((0.0, 0.0, 0.0))
    radius: float = option(1.0, low=0)
    shares: bool = option(False)

    def check(self) -> None:
        """Raise `ParameterError` for fractions that are out of range."""
        if self.shares and not (min(self.centre) >= 0 and max(self.centre) <= 1):
            raise ParameterError(f"the sphere has its centre at {self.centre}: expected fractions from 0 to 1")

    def on(self, mesh: Mesh) -> Sphere:
        """Return the sphere with coordinates in a mesh instead of fractions."""
        if not self.shares:
            return self
        points = mesh.points[mesh.topology.used]
        lowest, extent = points.min(axis=0), np.ptp(points, axis=0)
        centre = lowest + extent * self.centre
        return Sphere(tuple(centre.tolist()), self.radius * float(np.linalg.norm(extent)))

    def contains(self, points: np.ndarray) -> np.ndarray:
        """Return True for points, (k, 3), in the sphere or on it, (k,) bool."""
        offset = np.asarray(points) - self.centre
        return np.einsum("ij,ij->i", offset, offset) <= self.radius**2


class DepthUnit(StrEnum):
    """Unit of the depth of hexes."""

    LAYERS = "layers"
    """Layers of hexes: 1 for hexes with a face on the boundary, 2 for hexes that share a face with them, and so on."""
    EDGES = "edges"
    """Mean edge lengths of the mesh, between the centre of a hex and the boundary."""


@dataclass(frozen=True)
class Depth(ConfigTable):
    """Range of depths below the boundary.

    Parameters
    ----------
    low, high : float
        Least and greatest depth.
    unit : DepthUnit
        layers: from 1 at the boundary; edges: distance of a hex's centre from the boundary in mean edge lengths.
    """

    low: float = option(1.0, low=0)
    high: float = option(1.0, low=0)
    unit: DepthUnit = option(DepthUnit.LAYERS)

    def check(self) -> None:
        """Raise `ParameterError` for an invalid range."""
        if not self.low <= self.high:
            raise ParameterError(f"the depth goes from {self.low:g} to {self.high:g}: expected the lower number first")

    def contains(self, depths: np.ndarray) -> np.ndarray:
        """Return True for depths, (m,), in the range, (m,) bool."""
        return (depths >= self.low) & (depths <= self.high)
