"""FiveSide: a regular pentagon, meshed with quads, extruded, turned and tapered (thesis 4.3, Figure 4.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.gallery.gallery_mesh import GalleryMesh, extrude, gallery_mesh
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
