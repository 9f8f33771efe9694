"""Cutting planes and boxes: values without Qt and without VTK."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np

#: Degrees within which a plane that is turned by hand is set straight.
SNAP = 8.0

_AXES = np.eye(3)
_ROUNDING = 1e-15
_HAIR = 1e-9  # of a box's diagonal


@dataclass(frozen=True)
class ClipPlane:
    """A plane; the half-space that `normal` points to lies beyond it.

    Parameters
    ----------
    normal : tuple of 3 floats
        Of unit length.
    origin : tuple of 3 floats
        A point of the plane, in the mesh's unit of length.
    """

    normal: tuple[float, float, float] = (1.0, 0.0, 0.0)
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        length = math.hypot(*self.normal)
        if not length > 0 or not math.isfinite(length):
            raise ValueError(f"the plane's normal is {self.normal}: expected a direction")
        if abs(length - 1) < _ROUNDING:
            length = 1.0  # a plane that is copied is the same to the bit
        object.__setattr__(self, "normal", tuple(float(c) / length for c in self.normal))
        object.__setattr__(self, "origin", tuple(float(c) for c in self.origin))

    @property
    def equation(self) -> tuple[np.ndarray, float]:
        """Normal (3,) and offset: points of the plane have x . normal = offset."""
        return np.array(self.normal), float(np.dot(self.normal, self.origin))

    def signed_distance(self, points: np.ndarray) -> np.ndarray:
        """Distance of (k, 3) points from the plane, positive beyond it."""
        normal, offset = self.equation
        return np.asarray(points) @ normal - offset

    def flipped(self) -> ClipPlane:
        """The same plane with its sides exchanged."""
        return dataclasses.replace(self, normal=tuple(-c for c in self.normal))

    def snapped(self, degrees: float = SNAP) -> ClipPlane:
        """The plane set straight, through the same point, where its normal is so near to an axis; else itself."""
        size = np.abs(self.normal)
        axis = int(size.argmax())
        if size[axis] < np.cos(np.radians(degrees)):
            return self
        return dataclasses.replace(self, normal=tuple(np.sign(self.normal[axis]) * _AXES[axis]))


@dataclass(frozen=True)
class PlaneClip:
    """A cut by planes.

    Parameters
    ----------
    planes : tuple of ClipPlane
        At least one.
    crinkle : bool
        Whole elements (True: an element is hidden when its centre is) or a smooth cut through them.
    notch : bool
        Hide only what lies beyond all planes, which cuts a corner out; else all that lies beyond one of them.
    """

    planes: tuple[ClipPlane, ...] = (ClipPlane(),)
    crinkle: bool = True
    notch: bool = False

    def __post_init__(self) -> None:
        if not self.planes:
            raise ValueError("a cut has no plane: expected one or more")
        object.__setattr__(self, "planes", tuple(self.planes))

    @classmethod
    def at(cls, normal: tuple, origin: tuple, crinkle: bool = True) -> PlaneClip:
        """The cut by one plane."""
        return cls((ClipPlane(normal, origin),), crinkle)

    def with_plane(self, at: int, plane: ClipPlane) -> PlaneClip:
        """The same cut with another plane at one place."""
        return dataclasses.replace(self, planes=(*self.planes[:at], plane, *self.planes[at + 1 :]))


@dataclass(frozen=True)
class BoxClip:
    """A cut by a box along the axes.

    Parameters
    ----------
    low, high : tuple of 3 floats
        Its corners, in the mesh's unit of length.
    crinkle : bool
        As in `PlaneClip`.
    notch : bool
        Hide what lies inside; else what lies outside.
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
        """Its sides, x low, x high, y low ...; what is to be hidden lies beyond one of them, or with `notch` all.

        They stand a hair farther out than the box, so that a face of the mesh in which one of them lies is inside.
        """
        sense = -1.0 if self.notch else 1.0
        low, high = np.array(self.low), np.array(self.high)
        hair = _HAIR * float(np.linalg.norm(high - low))
        return tuple(
            ClipPlane(tuple(sign * sense * _AXES[axis]), tuple(corner))
            for axis in range(3)
            for sign, corner in ((-1.0, low - hair), (1.0, high + hair))
        )


Clip = PlaneClip | BoxClip


@dataclass(frozen=True)
class CutLeft:
    """Hexes that a cut leaves: computed from the positions of the nodes at that time, valid while they move.

    Parameters
    ----------
    clip : PlaneClip or BoxClip
        To another cut it says nothing.
    hexes : tuple of (first, last)
        Ascending ranges of their numbers, both ends within.
    """

    clip: Clip
    hexes: tuple[tuple[int, int], ...] = ()

    def __post_init__(self) -> None:
        before = -1
        for first, last in self.hexes:
            if not before < first <= last:
                raise ValueError(f"hexes {first} to {last} come after {before}: expected ascending ranges")
            before = last

    @classmethod
    def of(cls, clip: Clip, left: np.ndarray) -> CutLeft:
        """The elements that are True, (m,) bool."""
        ends = np.flatnonzero(np.diff(left, prepend=False, append=False))
        return cls(clip, tuple((int(first), int(end) - 1) for first, end in ends.reshape(-1, 2)))

    @property
    def most(self) -> int:
        """The greatest number; -1 where nothing is left."""
        return self.hexes[-1][1] if self.hexes else -1

    def mask(self, hexes: int) -> np.ndarray:
        """Mark the hexes that are left, (m,) bool."""
        answer = np.zeros(hexes, dtype=bool)
        for first, last in self.hexes:
            answer[first : last + 1] = True
        return answer
