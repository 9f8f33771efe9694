"""Materials: a ball in a box, two materials with a curved interface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.gallery.gallery_mesh import GalleryMesh, box_hexes, extrude, gallery_mesh, tensor_product
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import Topology
from hexmend.parameters import parameter

#: Half the width of the cube in the middle of the ball, in radii.
_CORE = 0.45


@gallery_mesh
@dataclass(frozen=True)
class Materials(GalleryMesh):
    """Ball in the box from -1 to 1: a cube in its middle, then layers to the sphere and to the faces of the box."""

    name = "materials"
    title = "Ball in a box"
    help = "Two materials, the sets 'ball' and 'box', with a sphere as their interface, which smoothing keeps."
    source = "Hexmend"

    size: int = parameter(1512, low=13, high=10**8, help="Approximate number of hexes.")
    radius: float = parameter(0.6, low=0.1, high=0.9, help="Radius of the ball; the box is 2 wide.")

    def regular(self) -> Mesh:
        n, layers = self._divisions()
        places = np.linspace(-1, 1, n + 1)
        cube, hexes = tensor_product(places, places, places), box_hexes(n, n, n)
        quads = Topology(hexes, len(cube)).boundary_faces
        rim = np.unique(quads)
        number = np.empty(len(cube), dtype=np.int64)
        number[rim] = np.arange(rim.size)
        inner = _CORE * self.radius * cube[rim]
        sphere = self.radius * cube[rim] / np.linalg.norm(cube[rim], axis=1, keepdims=True)
        shells = [_between(inner, sphere, layers), _between(sphere, cube[rim], layers)]
        first = np.concatenate([rim, len(cube) + np.arange(2 * layers * rim.size)])
        points = np.concatenate([_CORE * self.radius * cube, *shells])
        hexes = np.concatenate([hexes, first[extrude(number[quads], rim.size, 2 * layers)]])
        count = n**3 + layers * len(quads)
        sets = {"ball": np.arange(count), "box": np.arange(count, len(hexes))}
        return Mesh(points, hexes, hex_sets=sets)

    def _divisions(self) -> tuple[int, int]:
        """Divisions of the cube's edges, and layers from it to the sphere and from there to the box, for the size."""
        around = round((self.size / 7) ** (1 / 3))  # n^3 hexes in the cube, and about n / 2 layers twice
        pairs = [(n, layers) for n in range(max(1, around - 1), around + 2) for layers in (n // 2, n // 2 + 1)]
        pairs = [(n, max(1, layers)) for n, layers in pairs]
        return min(pairs, key=lambda pair: abs(pair[0] ** 3 + 12 * pair[1] * pair[0] ** 2 - self.size))


def _between(low: np.ndarray, high: np.ndarray, layers: int) -> np.ndarray:
    """Points on the straight lines between two surfaces (k, 3), without the first surface, (layers * k, 3)."""
    share = np.arange(1, layers + 1)[:, None, None] / layers
    return (low + share * (high - low)).reshape(-1, 3)
