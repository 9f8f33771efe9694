"""Cut of a mesh in a scene."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend_app.codec.config_table import ConfigTable, option
from hexmend_app.picture.camera_pose import Vector
from hexmend_app.picture.cut_planes import BoxClip, Clip, ClipPlane, CutLeft, PlaneClip

#: Maximum number of planes, and maximum length of the text that lists the remaining hexes.
_MAX_PLANES, _MAX_TEXT = 12, 2_000_000


class CutStyle(StrEnum):
    """Drawing style of hexes on a cut."""

    CRINKLE = "crinkle"
    """Hexes are shown whole."""
    SMOOTH = "smooth"
    """Hexes are cut."""


@dataclass(frozen=True)
class Plane(ConfigTable):
    """Plane of a cut, which hides the side that its normal points to.

    Parameters
    ----------
    normal : Vector
        Normal of the plane.
    position : float, optional
        Position along the normal, from 0 at one end of the mesh to 1 at the other; by default 0.5.
    point : Vector, optional
        Point of the plane, in the unit of the mesh, instead of a position.
    """

    normal: Vector = option((1.0, 0.0, 0.0))
    position: float | None = option(low=0, high=1)
    point: Vector | None = option()

    def check(self) -> None:
        """Raise `ParameterError` unless there is a nonzero normal and at most one of position and point."""
        if self.position is not None and self.point is not None:
            raise ParameterError("the plane has a position and a point: expected one of them")
        if not any(self.normal):
            raise ParameterError("normal = [0, 0, 0] is no direction: expected a nonzero vector")

    def of(self, mesh: Mesh) -> ClipPlane:
        """Return the plane for a mesh."""
        if self.point is not None:
            return ClipPlane(self.normal, self.point)
        largest = max(map(abs, self.normal))
        normal = np.array(self.normal) / largest
        along = mesh.points[mesh.topology.used] @ normal
        share = 0.5 if self.position is None else self.position
        offset = along.min() + share * (along.max() - along.min())
        return ClipPlane(tuple(normal.tolist()), tuple((normal * offset / (normal @ normal)).tolist()))


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

    def of(self, mesh: Mesh) -> tuple[Vector, Vector]:
        """Return the corners for a mesh."""
        if not self.shares:
            return self.low, self.high
        points = mesh.points[mesh.topology.used]
        lowest, highest = points.min(axis=0), points.max(axis=0)
        low, high = (lowest + (highest - lowest) * share for share in (self.low, self.high))
        return tuple(low.tolist()), tuple(high.tolist())


@dataclass(frozen=True)
class Cut(ConfigTable):
    """Cut of the mesh by planes or by a box.

    Parameters
    ----------
    planes : tuple of Plane
        Planes, for example { normal = [1, 0, 0], position = 0.5 }, or with a point instead of a position.
    box : Box, optional
        Box, for example { low = [0, 0, 0], high = [1, 1, 1] }, whose outside is hidden.
    style : CutStyle
        crinkle shows hexes at the cut whole, smooth cuts them.
    notch : bool
        Hide only what lies beyond all planes, which removes a corner; for a box, hide its inside.
    hexes : str
        Hexes that a cut by whole hexes has left, as ranges of numbers from 0, for example "0-120, 130"; by default
        the hexes whose centre is not cut away.
    """

    planes: tuple[Plane, ...] = option((), most=_MAX_PLANES)
    box: Box | None = option()
    style: CutStyle = option(CutStyle.CRINKLE)
    notch: bool = option(False)
    hexes: str = option("", most=_MAX_TEXT)

    def check(self) -> None:
        """Raise `ParameterError` for planes with a box, and for invalid hexes."""
        if self.planes and self.box is not None:
            raise ParameterError("the cut has planes and a box: expected one of them")
        if self.hexes:
            if self.style is not CutStyle.CRINKLE or not (self.planes or self.box):
                raise ParameterError("hexes require a cut by whole hexes: expected planes or a box, and style crinkle")
            try:
                CutLeft(PlaneClip(), _ranges(self.hexes))
            except ValueError as error:
                raise ParameterError(f"hexes: {error}") from None

    def of(self, mesh: Mesh) -> Clip | None:
        """Return the cut of a mesh; None if there is none."""
        crinkle = self.style is CutStyle.CRINKLE
        if self.box is not None:
            return BoxClip(*self.box.of(mesh), crinkle, self.notch)
        return PlaneClip(tuple(plane.of(mesh) for plane in self.planes), crinkle, self.notch) if self.planes else None

    def left(self, mesh: Mesh) -> CutLeft | None:
        """Return the hexes that the cut of a mesh leaves; None if the scene does not list them.

        Raises
        ------
        ParameterError
            If a listed hex does not exist in the mesh.
        """
        if not self.hexes:
            return None
        left = CutLeft(self.of(mesh), _ranges(self.hexes))
        if left.most >= mesh.n_hexes:
            raise ParameterError(f"[cut] names hex {left.most:,}: expected one of the mesh, below {mesh.n_hexes:,}")
        return left

    @classmethod
    def from_clip(cls, clip: Clip | None, left: CutLeft | None = None) -> Cut:
        """Return the table of a cut, in the unit of the mesh; remaining hexes are listed unless too many."""
        if clip is None:
            return cls()
        options = {"style": CutStyle.CRINKLE if clip.crinkle else CutStyle.SMOOTH, "notch": clip.notch}
        if left is not None and left.clip == clip and len(ranges := _text(left.hexes)) <= _MAX_TEXT:
            options["hexes"] = ranges
        if isinstance(clip, BoxClip):
            return cls(box=Box(clip.low, clip.high), **options)
        return cls(tuple(Plane(plane.normal, point=plane.origin) for plane in clip.planes), **options)


def _text(ranges: tuple[tuple[int, int], ...]) -> str:
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in ranges)


def _ranges(text: str) -> tuple[tuple[int, int], ...]:
    """Parse ranges of numbers.

    >>> _ranges("0-120, 130")
    ((0, 120), (130, 130))
    """
    ranges = []
    for part in text.split(","):
        match = re.fullmatch(r"\s*([0-9]{1,10})(?:-([0-9]{1,10}))?\s*", part)
        if match is None:
            raise ValueError(f"{part.strip()[:40]!r} is no range of numbers: expected, for example, 0-120, 130")
        ranges.append((int(match[1]), int(match[2] or match[1])))
    return tuple(ranges)
