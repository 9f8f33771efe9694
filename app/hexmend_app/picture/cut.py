"""Cuts of the mesh as values without Qt and VTK."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property

import numpy as np

from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend_app.codec.config_table import ConfigTable
from hexmend_app.codec.option import option
from hexmend_app.picture.cut_planes import Box, Plane

#: Maximum number of planes, and maximum length of the text that lists the remaining hexes.
_MAX_PLANES, _MAX_TEXT = 12, 100_000_000


class CutStyle(StrEnum):
    """Drawing style of hexes on a cut."""

    CRINKLE = "crinkle"
    """Hexes are shown whole."""
    SMOOTH = "smooth"
    """Hexes are cut."""


@dataclass(frozen=True)
class Cut(ConfigTable):
    """Cut of the mesh by planes or by a box; nothing is cut without planes and box.

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

    @classmethod
    def at(cls, normal: Sequence[float], point: Sequence[float], style: CutStyle = CutStyle.CRINKLE) -> Cut:
        """Return the cut by a single plane."""
        return cls((Plane(tuple(map(float, normal)), point=tuple(map(float, point))),), style=style)

    def check(self) -> None:
        """Raise `ParameterError` for planes with a box, and for invalid hexes."""
        if self.planes and self.box is not None:
            raise ParameterError("the cut has planes and a box: expected one of them")
        if self.hexes:
            if not self.crinkled:
                raise ParameterError("hexes require a cut by whole hexes: expected planes or a box, and style crinkle")
            try:
                _ = self._ranges
            except ValueError as error:
                raise ParameterError(f"hexes: {error}") from None

    @property
    def active(self) -> bool:
        """True if there are planes or a box."""
        return bool(self.planes) or self.box is not None

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
        """True if all planes have points, and the box has coordinates."""
        return all(plane.point is not None for plane in self.planes) and not (self.box is not None and self.box.shares)

    @cached_property
    def sides(self) -> tuple[Plane, ...]:
        """The planes, or those of the sides of the box; beyond any of them, or with `notch` all, hexes are hidden."""
        return self.planes if self.box is None else self.box.sides(inwards=self.notch)

    def on(self, mesh: Mesh) -> Cut:
        """Return the cut with points and coordinates in a mesh.

        Raises
        ------
        ParameterError
            If a listed hex does not exist in the mesh.
        """
        if self.largest_hex >= mesh.n_hexes:
            raise ParameterError(
                f"[cut] names hex {self.largest_hex:,}: expected one of the mesh, below {mesh.n_hexes:,}"
            )
        if self.absolute:
            return self
        box = None if self.box is None else self.box.on(mesh)
        return replace(self, planes=tuple(plane.on(mesh) for plane in self.planes), box=box)

    def with_plane(self, at: int, plane: Plane) -> Cut:
        """Return a copy in which the plane with the index `at` is replaced; it lists no hexes."""
        return replace(self, planes=(*self.planes[:at], plane, *self.planes[at + 1 :]), hexes="")

    def with_hexes(self, left: np.ndarray | None) -> Cut:
        """Return a copy that lists the hexes that a mask, (m,) bool, marks as remaining; None lists no hexes."""
        if left is None:
            return replace(self, hexes="") if self.hexes else self
        ends = np.flatnonzero(np.diff(left, prepend=False, append=False)).reshape(-1, 2)
        ranges = ((int(first), int(end) - 1) for first, end in ends)
        text = ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in ranges)
        return replace(self, hexes=text)

    def listed(self, hexes: int) -> np.ndarray:
        """Return True for the listed hexes of a mesh with a number of hexes, (m,) bool."""
        mask = np.zeros(hexes, dtype=bool)
        for first, last in self._ranges:
            mask[first : last + 1] = True
        return mask

    @property
    def largest_hex(self) -> int:
        """Largest listed number; -1 if no hexes are listed."""
        return self._ranges[-1][1] if self.hexes else -1

    @cached_property
    def _ranges(self) -> tuple[tuple[int, int], ...]:
        """First and last number of the listed ranges, ascending."""
        ranges, previous = [], -1
        for part in self.hexes.split(","):
            match = re.fullmatch(r"\s*([0-9]{1,10})(?:-([0-9]{1,10}))?\s*", part)
            if match is None:
                raise ValueError(f"{part.strip()[:40]!r} is no range of numbers: expected, for example, 0-120, 130")
            first, last = int(match[1]), int(match[2] or match[1])
            if not previous < first <= last:
                raise ValueError(f"hexes {first} to {last} follow {previous}: expected ascending ranges")
            ranges.append((first, last))
            previous = last
        return tuple(ranges)
