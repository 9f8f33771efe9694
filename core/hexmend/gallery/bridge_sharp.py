"""BridgeSharp: a structured block over an arch that comes to a sharp point (thesis 4.2, Figures 4.1 and 4.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.gallery.gallery_mesh import GalleryMesh, box_hexes, gallery_mesh
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter

#: Left half of the underside, from its corner to the ridge, in heights of the block's sides, (4, 2). Each of the last
#: two pieces has the fraction SHARE of the half's segments, the first has the rest.
UNDERSIDE = np.array([(-1.473, 0.0), (-0.0994, -0.1758), (-0.0406, 0.5012), (0.0, 0.5761)])
SHARE = 0.15
#: Height of the block's sides: with edges of 2.5 for 32,000 hexes, delta in the mesh's units has the effect on global
#: methods that Tables 4.3 and 4.4 report.
HEIGHT = 27.0
#: Width of the deck over that of the underside; height of its middle above its ends; weight of equal spacing of its
#: nodes.
OVERHANG, CROWN, EVEN = 1.3038, 0.7984, 0.31


@gallery_mesh
@dataclass(frozen=True)
class BridgeSharp(GalleryMesh):
    """Block whose underside rises to a sharp ridge, through which Laplacian smoothing pulls nodes.

    Nodes are equally spaced along each piece of the underside; along the deck their spacing is a mean of that below
    and equal spacing; on the straight lines between the two they are equally spaced (a Coons patch).
    """

    name = "bridge-sharp"
    title = "BridgeSharp"
    help = "A structured block over a sharp arch: valid at first, inverted at the ridge by Laplacian smoothing."
    source = "Wilson 4.2; shape by trial, the thesis's own file being unpublished"

    size: int = parameter(32000, low=4, high=10**8, help="Approximate number of hexes, divided 2 : 1 : 2.")
    rise: float = parameter(0.5761, low=0, high=0.95, unit="height", help="Height of the ridge in the block.")
    depth: float = parameter(4.094, low=0.05, high=100, unit="height", help="Depth of the block.")

    def regular(self) -> Mesh:
        n = max(1, round((self.size / 4) ** (1 / 3)))
        nx, ny, nz = 2 * n, n, 2 * n
        half = self._underside(n)
        floor = np.concatenate([half, half[-2::-1] * [-1, 1]])
        end = -OVERHANG * half[0, 0]
        x = EVEN * np.linspace(-end, end, nx + 1) + (1 - EVEN) * OVERHANG * floor[:, 0]
        deck = np.column_stack([x, 1 + CROWN * (1 - np.abs(x) / end)])
        v = np.linspace(0, 1, ny + 1)[:, None, None]
        points = np.empty((nz + 1, ny + 1, nx + 1, 3))
        points[..., :2] = (1 - v) * floor + v * deck
        points[..., 2] = self.depth * np.linspace(0, 1, nz + 1)[:, None, None]
        number = np.arange(points[..., 0].size).reshape(points.shape[:3])
        return Mesh(
            HEIGHT * points.reshape(-1, 3),
            box_hexes(nx, ny, nz),
            node_sets={"arch": number[:, 0, :].ravel(), "deck": number[:, -1, :].ravel()},
        )

    def _underside(self, segments: int) -> np.ndarray:
        """Points along the underside from its left corner to the ridge, (segments + 1, 2)."""
        few = max(min(1, segments / 3), round(SHARE * segments))
        at = [0, segments - 2 * few, segments - few, segments]
        x, y = (np.interp(np.arange(segments + 1), at, column) for column in UNDERSIDE.T)
        return np.column_stack([x, y * self.rise / UNDERSIDE[-1, 1]])
