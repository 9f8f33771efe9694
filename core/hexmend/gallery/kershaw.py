"""Kershaw: a lattice of the unit cube, bent into zigzag layers; a benchmark of smoothing whose optimum is known."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.gallery.gallery_mesh import GalleryMesh, box_hexes, gallery_mesh, tensor_product
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter

#: Layers along x; the number of hexes along an edge is a multiple of it.
LAYERS = 6


@gallery_mesh
@dataclass(frozen=True)
class Kershaw(GalleryMesh):
    """Kershaw's map of an n x n x n lattice; the planes of x stay, those of y and z zigzag."""

    name = "kershaw"
    title = "Kershaw"
    help = "The unit cube with zigzag layers. Where the boundary slides, the optimum is the perfect grid."
    source = "Map of MFEM's mesh-explorer, after Kershaw 1981"

    size: int = parameter(
        1728, low=1, high=10**8, help="Approximate number of hexes: the nearest cube number of a multiple of 6."
    )
    eps: float = parameter(0.3, low=0.01, high=1, help="Ratio of thin to uniform hexes: 1 for the perfect grid.")

    def regular(self) -> Mesh:
        n = LAYERS * max(1, round(self.size ** (1 / 3) / LAYERS))
        places = np.linspace(0, 1, n + 1)
        lattice = tensor_product(places, places, places)
        return Mesh(kershaw_map(lattice, self.eps), box_hexes(n, n, n))


def kershaw_map(points: np.ndarray, eps: float) -> np.ndarray:
    """Map points of the unit cube: x stays, y and z change with the layer of x.

    Parameters
    ----------
    points : (n, 3) float64
        Between 0 and 1.
    eps : float
        1 for the identity; towards 0 the thin halves of the layers lose their width.

    Returns
    -------
    (n, 3) float64
    """
    x = points[:, 0]
    layer = np.minimum((x * LAYERS + 1e-9).astype(int), LAYERS - 1)  # the lattice's planes bound the layers
    along = x * LAYERS - layer
    # Share of `right` in the mixture of left and right, by layer.
    share = np.choose(layer, [0 * x, along, 1 - along / 2, (1 - along) / 2, along, 0 * x + 1])
    mapped = points.copy()
    for axis in (1, 2):
        t = points[:, axis]
        left = 1 - _right(1 - t, eps)
        mapped[:, axis] = left + share * (_right(t, eps) - left)
    return mapped


def _right(t: np.ndarray, eps: float) -> np.ndarray:
    """Map [0, 1] to itself, the upper half compressed by eps."""
    return np.where(t <= 0.5, (2 - eps) * t, 1 + eps * (t - 1))
