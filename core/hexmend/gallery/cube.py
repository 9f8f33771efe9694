"""Cube: a structured grid of the unit cube, whose optimum is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.gallery.blocks import box_hexes
from hexmend.gallery.gallery_mesh import GalleryMesh, gallery_mesh
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter


@gallery_mesh
@dataclass(frozen=True)
class Cube(GalleryMesh):
    """Grid of n x n x n cubes in the unit cube."""

    name = "cube"
    title = "Cube"
    help = "A structured grid of the unit cube. However it is scrambled, the optimum is the perfect grid."
    source = "Hexmend"

    size: int = parameter(1000, low=1, high=10**8, help="About how many hexes: the nearest cube number.")

    def regular(self) -> Mesh:
        n = max(1, round(self.size ** (1 / 3)))
        places = np.linspace(0, 1, n + 1)
        z, y, x = np.meshgrid(places, places, places, indexing="ij")
        return Mesh(np.column_stack([x.ravel(), y.ravel(), z.ravel()]), box_hexes(n, n, n))
