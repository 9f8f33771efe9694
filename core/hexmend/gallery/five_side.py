"""FiveSide: a regular pentagon, meshed with quads, extruded, turned and tapered (thesis 4.3, Figure 4.3).

BridgeSharp: a structured block over an arch that comes to a sharp point (thesis 4.2, Figures 4.1 and 4.2).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.gallery.gallery_mesh import GalleryMesh, box_hexes, extrude, gallery_mesh
from hexmend.gallery.pentagon import fan, pentagon, subdivide
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter


@dataclass(frozen=True)
class Division:
    """Division of the prism: an unstructured quad mesh of the pentagon, in layers."""

    quads: int
    boundary: int  # nodes on the pentagon's boundary
    layers: int
    jitter: float = 0.4
    seed: int = 0


#: Divisions of the thesis's meshes by number of hexes. Its numbers of hexes, nodes and free nodes determine quads,
#: boundary and layers; jitter and seed are the best of those tried: their optima come near the thesis's, and that of
#: 62,350 hexes has the property that the remark on Table 4.8 tells of.
DIVISIONS = {
    7350: Division(245, 70, 30, 0.2, 3),
    16650: Division(555, 106, 30, 0.55, 2),
    44400: Division(555, 106, 80, 0.55, 2),
    62350: Division(1247, 146, 50, 0.2, 1),
    85400: Division(2135, 226, 40, 0.6, 0),
    110450: Division(2209, 196, 50, 0.4, 0),
}

#: Other sizes: layers over the cube root of the hexes, boundary nodes over the square root of the quads.
LAYERS, BOUNDARY = 1.25, 4.4
#: Smallest and largest number of quads of an unstructured mesh; larger meshes subdivide its quads, smaller ones a fan.
MIN_UNSTRUCTURED, MAX_UNSTRUCTURED = 45, 600


@gallery_mesh
@dataclass(frozen=True)
class FiveSide(GalleryMesh):
    """Extruded unstructured quad mesh of a pentagon."""

    name = "five-side"
    title = "FiveSide"
    help = "A pentagonal prism, turned and tapered: semi-structured and convex, in any size. The thesis's scaling mesh."
    source = "Wilson 4.3; shape by trial, the thesis's own files being unpublished"

    size: int = parameter(7350, low=5, high=10**8, help="Approximate number of hexes; exact for the thesis's sizes.")
    height: float = parameter(1.13, low=0.01, high=100, unit="circumradius", help="Height of the prism.")
    turn: float = parameter(21.0, low=-360, high=360, unit="°", help="Rotation of the top relative to the bottom.")
    taper: float = parameter(0.33, low=0.01, high=10, help="Ratio of the sizes of top and bottom.")

    def regular(self) -> Mesh:
        plane, quads, layers = _quad_mesh(self.size)
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
            extrude(quads, n, layers),
            hex_data={"layer": np.repeat(np.arange(1, layers + 1), len(quads))},
            node_sets={"bottom": np.arange(n), "top": np.arange(layers * n, (layers + 1) * n)},
        )


def _quad_mesh(size: int) -> tuple[np.ndarray, np.ndarray, int]:
    """Points and quads of the pentagon, and the number of layers for about `size` hexes."""
    if size in DIVISIONS:
        division = DIVISIONS[size]
        return *pentagon(division.quads, division.boundary, division.jitter, division.seed), division.layers
    wanted = size / max(1, round(LAYERS * size ** (1 / 3)))
    if wanted < MIN_UNSTRUCTURED:
        plane = subdivide(*fan(), max(1, round((wanted / 5) ** 0.5)))
    else:
        times = int(np.ceil((wanted / MAX_UNSTRUCTURED) ** 0.5))
        coarse = wanted / times**2
        plane = subdivide(*pentagon(round(coarse), 2 * round(BOUNDARY / 2 * coarse**0.5)), times)
    return *plane, max(1, round(size / len(plane[1])))


#: Left half of the underside, from its corner to the ridge, in heights of the block's sides, (4, 2). Each of the last
#: two pieces has the fraction SHARE of the half's segments, the first has the rest.
UNDERSIDE = np.array([(-1.473, 0.0), (-0.0994, -0.1758), (-0.0406, 0.5012), (0.0, 0.5761)])
SHARE = 0.15
#: Width of the deck over that of the underside; height of its middle above its ends; weight of equal spacing of its
#: nodes.
OVERHANG, CROWN, EVEN = 1.3038, 0.7984, 0.31

#: Height of the block's sides: with edges of 2.5 for 32,000 hexes, delta in the mesh's units has the effect on global
#: methods that Tables 4.3 and 4.4 report.
HEIGHT = 27.0


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
