"""BridgeSharp: a structured block over an arch that comes to a sharp point (thesis 4.2, Figures 4.1 and 4.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.gallery.blocks import box_hexes
from hexmend.gallery.gallery_mesh import GalleryMesh, gallery_mesh
from hexmend.mesh import Mesh
from hexmend.parameters import parameter


@gallery_mesh
@dataclass(frozen=True)
class BridgeSharp(GalleryMesh):
    """A block whose underside rises to a sharp ridge, which Laplacian smoothing pulls nodes through.

    Nodes stand at equal distances along the underside and along the deck, and on straight lines between the two.
    """

    name = "bridge-sharp"
    title = "BridgeSharp"
    help = "A structured block over a sharp arch: valid as it is made, inverted at the ridge by Laplacian smoothing."
    source = "Wilson 4.2; shape by trial, the thesis's own file being unpublished"

    size: int = parameter(32000, low=4, high=10**8, help="About how many hexes, divided 2 : 2 : 1.")
    rise: float = parameter(0.4, low=0, high=0.95, unit="height", help="How far the arch's ridge rises into the block.")
    sharpness: float = parameter(3.5, low=1, high=8, help="1 is a roof with straight sides; higher is a thinner ridge.")
    arch: float = parameter(0.35, low=0.01, high=1, unit="width", help="Width of the arch; the rest is flat.")
    width: float = parameter(0.66, low=0.1, high=10, unit="height", help="Width of the block.")
    depth: float = parameter(0.46, low=0.05, high=10, unit="height", help="Depth of the block.")

    def regular(self) -> Mesh:
        n = max(1, round((self.size / 4) ** (1 / 3)))
        nx, ny, nz = 2 * n, 2 * n, n
        half = self._underside(n)
        floor = np.concatenate([half[::-1] * [-1, 1], half[1:]])
        deck = np.column_stack([np.linspace(-self.width / 2, self.width / 2, nx + 1), np.ones(nx + 1)])
        v = np.linspace(0, 1, ny + 1)[:, None, None]
        points = np.empty((nz + 1, ny + 1, nx + 1, 3))
        points[..., :2] = (1 - v) * floor + v * deck
        points[..., 2] = self.depth * np.linspace(0, 1, nz + 1)[:, None, None]
        number = np.arange(points[..., 0].size).reshape(points.shape[:3])
        return Mesh(
            points.reshape(-1, 3),
            box_hexes(nx, ny, nz),
            node_sets={"arch": number[:, 0, :].ravel(), "deck": number[:, -1, :].ravel()},
        )

    def _underside(self, segments: int) -> np.ndarray:
        """Points at equal distances along the underside from the ridge to the right-hand corner, (segments + 1, 2)."""
        x = np.linspace(0, 1, 4001)
        y = self.rise * np.clip(1 - x / self.arch, 0, None) ** self.sharpness
        run = np.concatenate([[0], np.cumsum(np.hypot(np.diff(x) * self.width / 2, np.diff(y)))])
        even = np.linspace(0, run[-1], segments + 1)
        return np.column_stack([np.interp(even, run, x) * self.width / 2, np.interp(even, run, y)])
