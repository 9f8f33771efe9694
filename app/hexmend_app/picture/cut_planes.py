"""Cutting planes and boxes as values without Qt and VTK."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np

#: Angle in degrees within which a plane that is rotated by hand snaps to an axis.
SNAP = 8.0

_AXES = np.eye(3)
_ROUNDING = 1e-15
_MARGIN = 1e-9  # of the diagonal of a box


@dataclass(frozen=True)
class ClipPlane:
    """Cutting plane; the half-space that `normal` points to lies beyond it.

    Parameters
    ----------
    normal : tuple of 3 floats
        Normal, which is normalised to unit length.
    origin : tuple of 3 floats
        Point of the plane, in the unit of the mesh.
    """

    normal: tuple[float, float, float] = (1.0, 0.0, 0.0)
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        length = math.hypot(*self.normal)
        if not length > 0 or not math.isfinite(length):
            raise ValueError(f"the normal of the plane is {self.normal}: expected a nonzero vector")
        if abs(length - 1) < _ROUNDING:
            length = 1.0  # copies of a plane are identical
        object.__setattr__(self, "normal", tuple(float(c) / length for c in self.normal))
        object.__setattr__(self, "origin", tuple(float(c) for c in self.origin))

    @property
    def equation(self) -> tuple[np.ndarray, float]:
        """Normal, (3,), and offset; points x of the plane satisfy x . normal = offset."""
        return np.array(self.normal), float(np.dot(self.normal, self.origin))

    def signed_distance(self, points: np.ndarray) -> np.ndarray:
        """Return the distances of points, (k, 3), from the plane, positive beyond it."""
        normal, offset = self.equation
        return np.asarray(points) @ normal - offset

    def flipped(self) -> ClipPlane:
        """Return the plane with the opposite normal."""
        return dataclasses.replace(self, normal=tuple(-c for c in self.normal))

    def snapped(self, degrees: float = SNAP) -> ClipPlane:
        """Return the plane with its normal along an axis if they differ by at most `degrees`; else the plane itself."""
        size = np.abs(self.normal)
        axis = int(size.argmax())
        if size[axis] < np.cos(np.radians(degrees)):
            return self
        return dataclasses.replace(self, normal=tuple(np.sign(self.normal[axis]) * _AXES[axis]))


@dataclass(frozen=True)
class PlaneClip:
    """Cut by planes.

    Parameters
    ----------
    planes : tuple of ClipPlane
        At least one plane.
    crinkle : bool
        Cut by whole hexes, which are hidden if their centres are cut away, instead of a smooth cut.
    notch : bool
        Hide only what lies beyond all planes, which removes a corner, instead of what lies beyond any plane.
    """

    planes: tuple[ClipPlane, ...] = (ClipPlane(),)
    crinkle: bool = True
    notch: bool = False

    def __post_init__(self) -> None:
        if not self.planes:
            raise ValueError("the cut has no plane: expected at least one")
        object.__setattr__(self, "planes", tuple(self.planes))

    @classmethod
    def at(cls, normal: tuple, origin: tuple, crinkle: bool = True) -> PlaneClip:
        """Return the cut by a single plane."""
        return cls((ClipPlane(normal, origin),), crinkle)

    def with_plane(self, at: int, plane: ClipPlane) -> PlaneClip:
        """Return a copy in which the plane with the index `at` is replaced."""
        return dataclasses.replace(self, planes=(*self.planes[:at], plane, *self.planes[at + 1 :]))


@dataclass(frozen=True)
class BoxClip:
    """Cut by an axis-aligned box.

    Parameters
    ----------
    low, high : tuple of 3 floats
        Lowest and highest corner, in the unit of the mesh.
    crinkle : bool
        As in `PlaneClip`.
    notch : bool
        Hide the inside of the box instead of its outside.
    """

    low: tuple[float, float, float]
    high: tuple[float, float, float]
    crinkle: bool = True
    notch: bool = False

    def __post_init__(self) -> None:
        low, high = (tuple(float(c) for c in corner) for corner in (self.low, self.high))
        if not all(a <= b for a, b in zip(low, high, strict=True)) or not np.isfinite([*low, *high]).all():
            raise ValueError(f"the box goes from {low} to {high}: expected the lower corner first")
        object.__setattr__(self, "low", low)
        object.__setattr__(self, "high", high)

    @property
    def planes(self) -> tuple[ClipPlane, ...]:
        """Planes of the sides: x low, x high, y low, ...; beyond any of them, or with `notch` all, hexes are hidden.

        They lie slightly outside the box, so that faces of the mesh on its sides are inside.
        """
        orientation = -1.0 if self.notch else 1.0
        low, high = np.array(self.low), np.array(self.high)
        margin = _MARGIN * float(np.linalg.norm(high - low))
        return tuple(
            ClipPlane(tuple(sign * orientation * _AXES[axis]), tuple(corner))
            for axis in range(3)
            for sign, corner in ((-1.0, low - margin), (1.0, high + margin))
        )


Clip = PlaneClip | BoxClip


@dataclass(frozen=True)
class CutLeft:
    """Hexes that a cut by whole hexes has left, which remain the same while nodes move.

    Parameters
    ----------
    clip : PlaneClip or BoxClip
        The cut.
    hexes : tuple of (first, last)
        Ascending ranges of hex numbers, both ends inclusive.
    """

    clip: Clip
    hexes: tuple[tuple[int, int], ...] = ()

    def __post_init__(self) -> None:
        previous = -1
        for first, last in self.hexes:
            if not previous < first <= last:
                raise ValueError(f"hexes {first} to {last} follow {previous}: expected ascending ranges")
            previous = last

    @classmethod
    def of(cls, clip: Clip, left: np.ndarray) -> CutLeft:
        """Return the hexes that a mask, (m,) bool, marks as remaining."""
        ends = np.flatnonzero(np.diff(left, prepend=False, append=False))
        return cls(clip, tuple((int(first), int(end) - 1) for first, end in ends.reshape(-1, 2)))

    @property
    def most(self) -> int:
        """Largest hex number; -1 if no hex remains."""
        return self.hexes[-1][1] if self.hexes else -1

    def mask(self, hexes: int) -> np.ndarray:
        """Return True for the remaining hexes of a mesh with `hexes` hexes, (m,) bool."""
        mask = np.zeros(hexes, dtype=bool)
        for first, last in self.hexes:
            mask[first : last + 1] = True
        return mask
