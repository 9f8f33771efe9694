"""Cube: a structured grid of the unit cube, whose optimum is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.gallery.gallery_mesh import GalleryMesh, box_hexes, gallery_mesh, tensor_product
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter


@gallery_mesh
@dataclass(frozen=True)
class Cube(GalleryMesh):
    """Grid of n x n x n cubes in the unit cube."""

    name = "cube"
    title = "Cube"
    help = "A structured grid of the unit cube. The optimum is the perfect grid for every scramble."
    source = "Hexmend"

    size: int = parameter(1000, low=1, high=10**8, help="Approximate number of hexes: the nearest cube number.")

    def regular(self) -> Mesh:
        n = max(1, round(self.size ** (1 / 3)))
        places = np.linspace(0, 1, n + 1)
        return Mesh(tensor_product(places, places, places), box_hexes(n, n, n))
