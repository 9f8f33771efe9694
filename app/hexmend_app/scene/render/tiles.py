"""Tiles of a picture that is too large to be rendered at once."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import atan, ceil, degrees, isqrt, radians, tan

from vtkmodules.vtkRenderingCore import vtkCamera

#: Maximum number of pixels, and maximum side in pixels, of a picture that is rendered at once.
AT_ONCE, _MAX_SIDE = 2**24, 16384

#: Overlap of tiles in widths of a thin line, so that marks and texts near a seam, for example values at a corner, are
#: complete.
_OVERLAP = 24


@dataclass(frozen=True)
class Tile:
    """Part of a picture, in pixels from its upper left corner."""

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
        Size of the picture, in pixels.
    fine : int
        Supersampling: rendered pixels along each side of a pixel.
    inner : (width, height)
        Size of a tile without its margin, in pixels.
    around : int
        Margin of a tile in pixels, which is cropped.
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
            As for `Tiles`.
        pixel_ratio : float
            Width of a thin line, in rendered pixels.
        at_once : int
            Maximum number of pixels that are rendered at once.
        """
        if fine * max(size) <= _MAX_SIDE and fine * fine * size[0] * size[1] <= at_once:
            return cls(size, fine, size, 0)
        side = max(4, min(_MAX_SIDE, isqrt(at_once)) // fine)
        around = min(ceil(_OVERLAP * pixel_ratio / fine), side // 4)
        width, height = (ceil(length / ceil(length / (side - 2 * around))) for length in size)
        return cls(size, fine, (width, height), around)

    @property
    def drawn(self) -> tuple[int, int]:
        """Width and height of a rendered tile with its margin, in rendered pixels."""
        width, height = self.inner
        return self.fine * (width + 2 * self.around), self.fine * (height + 2 * self.around)

    def __iter__(self) -> Iterator[Tile]:
        for top in range(0, self.size[1], self.inner[1]):
            for left in range(0, self.size[0], self.inner[0]):
                yield Tile(left, top, min(self.inner[0], self.size[0] - left), min(self.inner[1], self.size[1] - top))

    def aim(self, camera: vtkCamera, whole: vtkCamera, tile: Tile) -> None:
        """Set a camera to a tile, with its margin, of the picture of the camera `whole`."""
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
