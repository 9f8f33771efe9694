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
    """A block whose underside rises to a sharp ridge, which Laplacian smoothing pulls nodes through."""

    name = "bridge-sharp"
    title = "BridgeSharp"
    help = "A structured block over a sharp arch: valid as it is made, inverted at the ridge by Laplacian smoothing."
    source = "Wilson 4.2; shape by trial, the thesis's own file being unpublished"

    size: int = parameter(32000, low=4, high=10**8, help="About how many hexes, divided 2 : 2 : 1.")
    rise: float = parameter(0.6, low=0, high=0.95, unit="height", help="How far the arch's ridge rises into the block.")
    sharpness: float = parameter(2.5, low=1, high=8, help="1 is a roof with straight sides; higher is a thinner ridge.")
    width: float = parameter(0.9, low=0.1, high=10, unit="height", help="Width of the block.")
    depth: float = parameter(0.5, low=0.05, high=10, unit="height", help="Depth of the block.")

    def regular(self) -> Mesh:
        n = max(1, round((self.size / 4) ** (1 / 3)))
        nx, ny, nz = 2 * n, 2 * n, n
        u, v, w = np.linspace(0, 1, nx + 1), np.linspace(0, 1, ny + 1), np.linspace(0, 1, nz + 1)
        floor = self.rise * (1 - np.abs(2 * u - 1)) ** self.sharpness
        y = floor[None, :] * (1 - v[:, None]) + v[:, None]  # straight lines from the arch up to the deck
        points = np.empty((nz + 1, ny + 1, nx + 1, 3))
        points[..., 0] = self.width * u
        points[..., 1] = y
        points[..., 2] = self.depth * w[:, None, None]
        number = np.arange(points[..., 0].size).reshape(points.shape[:3])
        return Mesh(
            points.reshape(-1, 3),
            box_hexes(nx, ny, nz),
            node_sets={"arch": number[:, 0, :].ravel(), "deck": number[:, -1, :].ravel()},
        )
