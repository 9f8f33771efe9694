"""Tiles of a picture that is too large to be drawn at once."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import atan, ceil, degrees, isqrt, radians, tan

from vtkmodules.vtkRenderingCore import vtkCamera

#: Pixels of a picture that are drawn at once, and of one of its sides.
AT_ONCE, _MOST_SIDE = 2**24, 16384

#: Widths of a thin line that tiles overlap by: what is drawn about a place in the next tile, such as figures at a
#: corner, does not end at the seam.
_OVERLAP = 24


@dataclass(frozen=True)
class Tile:
    """A part of a picture, in its pixels from the upper left corner."""

    left: int
    top: int
    width: int
    height: int


@dataclass(frozen=True)
class Tiles:
    """Division of a picture into tiles.

    Parameters
    ----------
    size : (width, height)
        Of the picture, in pixels.
    fine : int
        Pixels along each side that are drawn for one.
    inner : (width, height)
        Of what each tile gives to the picture.
    around : int
        Pixels that are drawn on all sides of that, and cut away.
    """

    size: tuple[int, int]
    fine: int
    inner: tuple[int, int]
    around: int

    @classmethod
    def of(cls, size: tuple[int, int], fine: int, pixel_ratio: float, at_once: int = AT_ONCE) -> Tiles:
        """Divide a picture into as few tiles as possible.

        Parameters
        ----------
        size, fine
            As above.
        pixel_ratio : float
            Width of a thin line, in drawn pixels.
        at_once : int
            Largest number of pixels that can be drawn at once.
        """
        if fine * max(size) <= _MOST_SIDE and fine * fine * size[0] * size[1] <= at_once:
            return cls(size, fine, size, 0)
        space = max(4, min(_MOST_SIDE, isqrt(at_once)) // fine)
        around = min(ceil(_OVERLAP * pixel_ratio / fine), space // 4)
        inner = tuple(ceil(side / ceil(side / (space - 2 * around))) for side in size)
        return cls(size, fine, inner, around)

    @property
    def drawn(self) -> tuple[int, int]:
        """Width and height of one drawn tile, in its pixels."""
        width, height = self.inner
        return self.fine * (width + 2 * self.around), self.fine * (height + 2 * self.around)

    def __iter__(self) -> Iterator[Tile]:
        for top in range(0, self.size[1], self.inner[1]):
            for left in range(0, self.size[0], self.inner[0]):
                yield Tile(left, top, min(self.inner[0], self.size[0] - left), min(self.inner[1], self.size[1] - top))

    def aim(self, camera: vtkCamera, whole: vtkCamera, tile: Tile) -> None:
        """Set a camera to a tile and its margin in the picture of another camera."""
        camera.DeepCopy(whole)
        if self.inner == self.size:
            return
        width, height = (side + 2 * self.around for side in self.inner)
        share = height / self.size[1]
        camera.SetParallelScale(share * whole.GetParallelScale())
        camera.SetViewAngle(2 * degrees(atan(share * tan(radians(whole.GetViewAngle()) / 2))))
        right = tile.left - self.around + width / 2 - self.size[0] / 2
        below = tile.top - self.around + height / 2 - self.size[1] / 2
        camera.SetWindowCenter(2 * right / width, -2 * below / height)
