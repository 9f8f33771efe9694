"""Cuts of the mesh as values without Qt and VTK."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property

import numpy as np

from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend_app.codec.conversion import ConfigTable, option
from hexmend_app.picture.cut_shapes import Box, Depth, Plane, Slab, Sphere

#: Maximum number of planes, and maximum length of the text that lists the remaining hexes.
_MAX_PLANES, _MAX_TEXT = 12, 100_000_000


class CutKind(StrEnum):
    """Shape that cuts the mesh."""

    PLANES = "planes"
    BOX = "box"
    SLAB = "slab"
    SPHERE = "sphere"
    DEPTH = "depth"


#: Shapes with plane sides, which can cut hexes smoothly.
PLANE_KINDS = frozenset({CutKind.PLANES, CutKind.BOX, CutKind.SLAB})


class CutStyle(StrEnum):
    """Drawing style of hexes on a cut."""

    CRINKLE = "crinkle"
    """Hexes are shown whole."""
    SMOOTH = "smooth"
    """Hexes are cut."""


@dataclass(frozen=True)
class Cut(ConfigTable):
    """Cut of the mesh by planes, a box, a slab, a sphere or the depth of hexes; nothing is cut without any of them.

    Parameters
    ----------
    planes : tuple of Plane
        Planes, such as { normal = [1, 0, 0], position = 0.5 }; what lies beyond any of them is hidden.
    box : Box, optional
        Box whose outside is hidden.
    slab : Slab, optional
        Slab between two planes, whose outside is hidden.
    sphere : Sphere, optional
        Sphere; hexes whose centre lies outside are hidden.
    depth : Depth, optional
        Depths of the shown hexes below the boundary.
    style : CutStyle
        crinkle shows hexes at the cut whole, smooth cuts them: with planes, a box or a slab.
    notch : bool
        Hide only what lies beyond all planes, which removes a corner; for another shape, hide its inside.
    hexes : str
        Hexes that a crinkle cut leaves, such as "0-120, 130"; by default those whose centre is not cut away.
    """

    planes: tuple[Plane, ...] = option((), most=_MAX_PLANES)
    box: Box | None = option()
    slab: Slab | None = option()
    sphere: Sphere | None = option()
    depth: Depth | None = option()
    style: CutStyle = option(CutStyle.CRINKLE)
    notch: bool = option(False)
    hexes: str = option("", most=_MAX_TEXT)

    @classmethod
    def at(cls, normal: Sequence[float], point: Sequence[float], style: CutStyle = CutStyle.CRINKLE) -> Cut:
        """Return the cut by a single plane."""
        normal, point = (tuple(np.asarray(vector, float).tolist()) for vector in (normal, point))
        return cls((Plane(normal, point=point),), style=style)

    def check(self) -> None:
        """Raise `ParameterError` for several shapes, a shape that cannot be cut smoothly, and invalid hexes."""
        if len(self._shapes) > 1:
            shapes = " and ".join(kind if kind is CutKind.PLANES else f"a {kind}" for kind in self._shapes)
            raise ParameterError(f"the cut has {shapes}: expected one of them")
        if self.style is CutStyle.SMOOTH and self.active and not self.by_planes:
            raise ParameterError(f"a cut by {self.kind} has whole hexes: expected style crinkle")
        if self.hexes:
            if not self.crinkled:
                raise ParameterError(
                    "hexes require a cut by whole hexes: expected planes or another shape, and style crinkle"
                )
            try:
                _ = self._ranges
            except ValueError as error:
                raise ParameterError(f"hexes: {error}") from None

    @property
    def _shapes(self) -> list[CutKind]:
        return [kind for kind in CutKind if getattr(self, kind) not in ((), None)]

    @property
    def kind(self) -> CutKind | None:
        """Shape of the cut; None if nothing is cut."""
        return next(iter(self._shapes), None)

    @property
    def active(self) -> bool:
        """True if there are planes or another shape."""
        return self.kind is not None

    @property
    def by_planes(self) -> bool:
        """True if the cut has planes, or another shape with plane sides."""
        return self.kind in PLANE_KINDS

    @property
    def crinkled(self) -> bool:
        """True if the mesh is cut by whole hexes, which are hidden if their centres are cut away."""
        return self.active and self.style is CutStyle.CRINKLE

    @property
    def smooth(self) -> bool:
        """True if hexes are cut."""
        return self.active and self.style is CutStyle.SMOOTH

    @property
    def absolute(self) -> bool:
        """True if all planes have points, and another shape has coordinates."""
        flat = self.planes if self.slab is None else (self.slab,)
        fractions = any(shape is not None and shape.shares for shape in (self.box, self.sphere))
        return not fractions and all(plane.point is not None for plane in flat)

    @cached_property
    def sides(self) -> tuple[Plane, ...]:
        """Planes of the cut, its box or its slab; hexes beyond any plane, or with `notch` beyond all, are hidden."""
        shape = self.slab if self.box is None else self.box
        return self.planes if shape is None else shape.sides(inwards=self.notch)

    def hidden(self, points: np.ndarray) -> np.ndarray:
        """Return True for points, (k, 3), that are cut away, (k,) bool; a depth, which only hexes have, hides none."""
        if self.sphere is not None:
            return self.sphere.contains(points) == self.notch
        if not self.by_planes:
            return np.zeros(len(points), bool)
        rounding = 1e-12 * np.abs(points).max(initial=0.0)  # a layer of points on a side is hidden as a whole or not
        beyond = [side.signed_distance(points) > rounding for side in self.sides]
        return np.all(beyond, axis=0) if self.notch else np.any(beyond, axis=0)

    def on(self, mesh: Mesh) -> Cut:
        """Return the cut with points and coordinates in a mesh.

        Raises
        ------
        ParameterError
            If a listed hex does not exist in the mesh.
        """
        if self.largest_hex >= mesh.n_elements:
            raise ParameterError(
                f"[cut] names hex {self.largest_hex}: expected one of the mesh, below {mesh.n_elements:,}"
            )
        if self.absolute:
            return self
        shapes = {kind: getattr(self, kind) for kind in (CutKind.BOX, CutKind.SLAB, CutKind.SPHERE)}
        placed = {kind: None if shape is None else shape.on(mesh) for kind, shape in shapes.items()}
        return replace(self, planes=tuple(plane.on(mesh) for plane in self.planes), **placed)

    def with_plane(self, at: int, plane: Plane) -> Cut:
        """Return a copy in which the plane with the index `at` is replaced; it lists no hexes."""
        return replace(self, planes=(*self.planes[:at], plane, *self.planes[at + 1 :]), hexes="")

    def with_hexes(self, left: np.ndarray | None) -> Cut:
        """Return a copy that lists the hexes that a mask, (m,) bool, marks as remaining; None lists no hexes."""
        if left is None:
            return replace(self, hexes="") if self.hexes else self
        return replace(self, hexes=ranges_text(left))

    def listed(self, hexes: int) -> np.ndarray:
        """Return True for the listed hexes of a mesh with a number of hexes, (m,) bool."""
        return mask_of(self._ranges, hexes)

    @property
    def largest_hex(self) -> int:
        """Largest listed number; -1 if no hexes are listed."""
        return self._ranges[-1][1] if self.hexes else -1

    @cached_property
    def _ranges(self) -> tuple[tuple[int, int], ...]:
        """First and last number of the listed ranges, ascending."""
        return parse_ranges(self.hexes)


def proposed_cuts(
    bounds: np.ndarray, before: Mapping[CutKind, Cut] | None = None, layers: int = 1
) -> dict[CutKind, Cut]:
    """Return cuts by planes, a box, a slab and a sphere in the middle of a mesh, and a cut that hides its outer layer.

    Parameters
    ----------
    bounds : (2, 3) float64
        Lowest and highest corner of the mesh.
    before : mapping of CutKind to Cut, optional
        Cuts whose normals are used again.
    layers : int
        Number of layers of hexes from the boundary inwards.
    """
    middle, extent = bounds.mean(axis=0), np.ptp(bounds, axis=0)
    centre = tuple(middle.tolist())
    normal = (1.0, 0.0, 0.0) if before is None else before[CutKind.PLANES].planes[0].normal
    across = (1.0, 0.0, 0.0) if before is None else before[CutKind.SLAB].slab.normal
    box = Box(tuple((middle - extent / 4).tolist()), tuple((middle + extent / 4).tolist()))
    thickness = 0.1 * float(extent @ np.abs(across))
    return {
        CutKind.PLANES: Cut.at(normal, centre),
        CutKind.BOX: Cut(box=box),
        CutKind.SLAB: Cut(slab=Slab(across, point=centre, thickness=thickness)),
        CutKind.SPHERE: Cut(sphere=Sphere(centre, float(np.linalg.norm(extent)) / 4)),
        CutKind.DEPTH: Cut(depth=Depth(min(2, layers), layers)),
    }


def ranges_text(mask: np.ndarray) -> str:
    """Return the numbers that a mask, (m,) bool, marks, as text.

    >>> ranges_text(np.array([True, True, True, False, True]))
    '0-2, 4'
    """
    ends = np.flatnonzero(np.diff(mask, prepend=False, append=False)).reshape(-1, 2)
    ranges = ((int(first), int(end) - 1) for first, end in ends)
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in ranges)


def parse_ranges(text: str) -> tuple[tuple[int, int], ...]:
    """Return the first and last number of each range of a text, ascending.

    Raises
    ------
    ValueError
        If the text is not a list of ascending ranges.

    >>> parse_ranges("0-2, 4")
    ((0, 2), (4, 4))
    """
    ranges, previous = [], -1
    for part in text.split(","):
        match = re.fullmatch(r"\s*([0-9]{1,10})(?:-([0-9]{1,10}))?\s*", part)
        if match is None:
            raise ValueError(f"{part.strip()[:40]!r} is not a range of numbers: expected, for example, 0-120, 130")
        first, last = int(match[1]), int(match[2] or match[1])
        if not previous < first <= last:
            raise ValueError(f"hexes {first} to {last} follow {previous}: expected ascending ranges")
        ranges.append((first, last))
        previous = last
    return tuple(ranges)


def mask_of(ranges: tuple[tuple[int, int], ...], count: int) -> np.ndarray:
    """Return True for the numbers below a count that ranges contain, (count,) bool."""
    mask = np.zeros(count, dtype=bool)
    for first, last in ranges:
        mask[first : last + 1] = True
    return mask
