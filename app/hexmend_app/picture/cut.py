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

#: Planes of a cut, and letters of the ranges of what it has left.
_MOST, _LONGEST = 12, 2_000_000


class CutStyle(StrEnum):
    """Drawing style of hexes on a cut."""

    CRINKLE = "crinkle"
    """Whole."""
    SMOOTH = "smooth"
    """Cut through."""


@dataclass(frozen=True)
class Plane(ConfigTable):
    """A plane of a cut: what lies on the side that its normal points to is hidden.

    Parameters
    ----------
    normal : Vector
        Where it points to.
    position : float, optional
        How far through the mesh along the normal it stands: 0.5, in the middle, where nothing is said.
    point : Vector, optional
        A point of the plane, in the mesh's unit, instead of a position.
    """

    normal: Vector = option((1.0, 0.0, 0.0))
    position: float | None = option(low=0, high=1)
    point: Vector | None = option()

    def check(self) -> None:
        """A direction, and one place."""
        if self.position is not None and self.point is not None:
            raise ParameterError("the plane has a position and a point: expected one of them")
        if not any(self.normal):
            raise ParameterError("normal = [0, 0, 0] is no direction: expected one that is not zero")

    def of(self, mesh: Mesh) -> ClipPlane:
        """The plane in a mesh."""
        if self.point is not None:
            return ClipPlane(self.normal, self.point)
        largest = max(map(abs, self.normal))
        normal = np.array(self.normal) / largest
        along = mesh.points[mesh.topology.used] @ normal
        share = 0.5 if self.position is None else self.position
        place = along.min() + share * (along.max() - along.min())
        return ClipPlane(tuple(normal.tolist()), tuple((normal * place / (normal @ normal)).tolist()))


@dataclass(frozen=True)
class Box(ConfigTable):
    """A box along the axes.

    Parameters
    ----------
    low, high : Vector
        Its corners, in the mesh's unit.
    shares : bool
        The corners are shares of the mesh along each axis, from 0 to 1, instead.
    """

    low: Vector = option((0.0, 0.0, 0.0))
    high: Vector = option((1.0, 1.0, 1.0))
    shares: bool = option(False)

    def check(self) -> None:
        """The lower corner first."""
        if not all(a <= b for a, b in zip(self.low, self.high, strict=True)):
            raise ParameterError(f"the box goes from {self.low} to {self.high}: expected the lower corner first")
        if self.shares and not (min(self.low) >= 0 and max(self.high) <= 1):
            raise ParameterError(f"the box goes from {self.low} to {self.high}: expected shares from 0 to 1")

    def of(self, mesh: Mesh) -> tuple[Vector, Vector]:
        """Its corners in a mesh."""
        if not self.shares:
            return self.low, self.high
        points = mesh.points[mesh.topology.used]
        least, most = points.min(axis=0), points.max(axis=0)
        low, high = (least + (most - least) * share for share in (self.low, self.high))
        return tuple(low.tolist()), tuple(high.tolist())


@dataclass(frozen=True)
class Cut(ConfigTable):
    """The cut; without planes and box, the mesh is whole.

    Parameters
    ----------
    planes : tuple of Plane
        Such as { normal = [1, 0, 0], position = 0.5 }, or with a point instead of a position.
    box : Box, optional
        Such as { low = [0, 0, 0], high = [1, 1, 1] }: what lies outside is hidden.
    style : CutStyle
        Whether hexes on the cut stay whole, or are cut through.
    notch : bool
        Hide only what lies beyond all planes, which cuts a corner out; of a box, its inside.
    hexes : str
        What the cut by whole hexes has left, as ranges of their numbers from 0, such as "0-120, 130", whatever lies
        beyond it now; without it, those whose middle does not.
    """

    planes: tuple[Plane, ...] = option((), most=_MOST)
    box: Box | None = option()
    style: CutStyle = option(CutStyle.CRINKLE)
    notch: bool = option(False)
    hexes: str = option("", most=_LONGEST)

    def check(self) -> None:
        """Planes or a box, and ranges that can be read."""
        if self.planes and self.box is not None:
            raise ParameterError("the cut has planes and a box: expected one of them")
        if self.hexes:
            if self.style is not CutStyle.CRINKLE or not (self.planes or self.box):
                raise ParameterError("hexes are left by a cut by whole hexes alone: expected planes or a box, crinkle")
            try:
                CutLeft(_NONE, _ranges(self.hexes))
            except ValueError as error:
                raise ParameterError(f"hexes: {error}") from None

    def of(self, mesh: Mesh) -> Clip | None:
        """The cut of a mesh; None for none."""
        whole = self.style is CutStyle.CRINKLE
        if self.box is not None:
            return BoxClip(*self.box.of(mesh), whole, self.notch)
        return PlaneClip(tuple(one.of(mesh) for one in self.planes), whole, self.notch) if self.planes else None

    def left(self, mesh: Mesh) -> CutLeft | None:
        """Hexes that the cut of a mesh leaves; None if the scene does not list them.

        Raises
        ------
        ParameterError
            Where the mesh has not the hexes that are named.
        """
        if not self.hexes:
            return None
        left = CutLeft(self.of(mesh), _ranges(self.hexes))
        if left.most >= mesh.n_hexes:
            raise ParameterError(f"[cut] names hex {left.most:,}: expected one of the mesh, below {mesh.n_hexes:,}")
        return left

    @classmethod
    def as_in(cls, clip: Clip | None, left: CutLeft | None = None) -> Cut:
        """The cut that a look has, in the mesh's unit; what it has left, unless that takes too many letters."""
        if clip is None:
            return cls()
        options = {"style": CutStyle.CRINKLE if clip.crinkle else CutStyle.SMOOTH, "notch": clip.notch}
        if left is not None and left.clip == clip and len(ranges := _text(left.hexes)) <= _LONGEST:
            options["hexes"] = ranges
        if isinstance(clip, BoxClip):
            return cls(box=Box(clip.low, clip.high), **options)
        return cls(tuple(Plane(one.normal, point=one.origin) for one in clip.planes), **options)


#: A cut that is made up where what is left by it is all that matters.
_NONE = PlaneClip()


def _text(ranges: tuple[tuple[int, int], ...]) -> str:
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in ranges)


def _ranges(text: str) -> tuple[tuple[int, int], ...]:
    """Ranges of numbers.

    >>> _ranges("0-120, 130")
    ((0, 120), (130, 130))
    """
    found = []
    for part in text.split(","):
        one = re.fullmatch(r"\s*([0-9]{1,10})(?:-([0-9]{1,10}))?\s*", part)
        if one is None:
            raise ValueError(f"{part.strip()[:40]!r} is no range of numbers: expected such as 0-120, 130")
        found.append((int(one[1]), int(one[2] or one[1])))
    return tuple(found)
