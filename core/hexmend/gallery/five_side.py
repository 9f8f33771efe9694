"""FiveSide: a regular pentagon, extruded, turned and tapered (thesis 4.3, Figure 4.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.gallery.blocks import extruded
from hexmend.gallery.gallery_mesh import GalleryMesh, gallery_mesh
from hexmend.mesh import Mesh
from hexmend.parameters import parameter

#: The thesis's meshes: hexes -> (segments of the five spokes, layers). A plane has sum a_i a_(i+1) quads and
#: sum a_i a_(i+1) + sum a_i + 1 nodes; these divisions give its numbers of hexes, nodes and free nodes exactly.
DIVISIONS: dict[int, tuple[tuple[int, int, int, int, int], int]] = {
    7350: ((7, 7, 7, 7, 7), 30),
    16650: ((12, 9, 12, 9, 11), 30),
    44400: ((12, 9, 12, 9, 11), 80),
}


@gallery_mesh
@dataclass(frozen=True)
class FiveSide(GalleryMesh):
    """Five transfinite blocks that meet in the pentagon's centre."""

    name = "five-side"
    title = "FiveSide"
    help = "A pentagonal prism, turned and tapered: semi-structured and convex, in any size. The thesis's scaling mesh."
    source = "Wilson 4.3; shape by trial, the thesis's own files being unpublished"

    size: int = parameter(
        7350, low=5, high=10**8, help="About how many hexes; the thesis's sizes have its own divisions."
    )
    height: float = parameter(1.5, low=0.01, high=100, unit="circumradius", help="Height of the prism.")
    turn: float = parameter(108.0, low=-360, high=360, unit="°", help="Angle of the top against the bottom.")
    taper: float = parameter(0.225, low=0.01, high=10, help="Size of the top over that of the bottom.")

    def regular(self) -> Mesh:
        spokes, layers = DIVISIONS.get(self.size) or _nearest(self.size)
        plane, quads, block = pentagon(spokes)
        level = np.linspace(0, 1, layers + 1)
        angle, scale = np.deg2rad(self.turn) * level, 1 + (self.taper - 1) * level
        c, s = np.cos(angle) * scale, np.sin(angle) * scale
        x = c[:, None] * plane[:, 0] - s[:, None] * plane[:, 1]
        y = s[:, None] * plane[:, 0] + c[:, None] * plane[:, 1]
        z = np.broadcast_to(self.height * level[:, None], x.shape)
        points = np.column_stack([x.ravel(), y.ravel(), z.ravel()])
        n = len(plane)
        return Mesh(
            points,
            extruded(quads, n, layers),
            hex_data={"block": np.tile(block, layers)},
            node_sets={"bottom": np.arange(n), "top": np.arange(layers * n, (layers + 1) * n)},
        )


def _nearest(size: int) -> tuple[tuple[int, ...], int]:
    """Equal spokes and layers in the ratio of the thesis's FiveSide4, 7 to 30, nearest to a number of hexes."""
    a = max(1, round((size * 7 / (5 * 30)) ** (1 / 3)))
    return (a,) * 5, max(1, round(size / (5 * a * a)))


def pentagon(spokes: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A pentagon of five blocks, each between two spokes from the centre to the middles of two sides.

    Parameters
    ----------
    spokes : five ints
        Segments of each spoke.

    Returns
    -------
    points : (n, 2) float64
    quads : (k, 4) int64
        Counter-clockwise.
    block : (k,) int64
        Block of each quad, 1 to 5.
    """
    angle = 2 * np.pi * np.arange(5) / 5
    corner = np.column_stack([np.cos(angle), np.sin(angle)])
    middle = (corner + np.roll(corner, -1, axis=0)) / 2
    points, quads, block, count = [], [], [], 0
    for k in range(5):
        a, b = spokes[k - 1], spokes[k]
        u, v = np.linspace(0, 1, a + 1)[:, None, None], np.linspace(0, 1, b + 1)[None, :, None]
        # Bilinear between centre, middle k - 1, corner k and middle k: (1 - u)(1 - v) times the centre is zero.
        x = u * (1 - v) * middle[k - 1] + u * v * corner[k] + (1 - u) * v * middle[k]
        number = count + np.arange((a + 1) * (b + 1)).reshape(a + 1, b + 1)
        quads.append(
            np.column_stack(
                [number[:-1, :-1].ravel(), number[1:, :-1].ravel(), number[1:, 1:].ravel(), number[:-1, 1:].ravel()]
            )
        )
        points.append(x.reshape(-1, 2))
        block.append(np.full(a * b, k + 1))
        count += number.size
    # Nodes of neighbouring blocks are one where they meet.
    everything = np.concatenate(points)
    _, first, inverse = np.unique(np.round(everything, 9) + 0.0, axis=0, return_index=True, return_inverse=True)
    return everything[first], inverse.ravel()[np.concatenate(quads)], np.concatenate(block)
