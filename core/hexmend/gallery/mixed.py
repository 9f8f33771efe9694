"""Mixed: a block of all four kinds of cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.gallery.gallery_mesh import GalleryMesh, box_hexes, gallery_mesh, tensor_product
from hexmend.mesh.cells import Cells
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter

#: Faces of a cube below its own middle that become pyramids, and halves of the upper face that become tetrahedra.
_PYRAMIDS = [[0, 3, 7, 4], [1, 5, 6, 2], [0, 4, 5, 1], [3, 2, 6, 7], [0, 1, 2, 3]]
_TETRAHEDRA = [[4, 6, 5], [4, 7, 6]]
_WEDGES = [[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]]


@gallery_mesh
@dataclass(frozen=True)
class Mixed(GalleryMesh):
    """Grid of the unit cube; cubes on top are cut into pyramids and tetrahedra, those at the end of x into wedges."""

    name = "mixed"
    title = "Mixed"
    help = "The unit cube of hexes, wedges, pyramids and tetrahedra."
    source = "Hexmend"

    size: int = parameter(1000, low=1, high=10**8, help="Approximate number of cells.")

    def regular(self) -> Mesh:
        n = max(1, round(self.size ** (1 / 3)))
        while n > 1 and n**3 + 7 * n**2 - 6 * n > self.size:
            n -= 1
        places = np.linspace(0, 1, n + 1)
        points, cubes = tensor_product(places, places, places), box_hexes(n, n, n)
        number = np.arange(n**3)
        at_end, on_top = number % n == n - 1, number // n**2 == n - 1
        cut, low = cubes[at_end], cubes[on_top & ~at_end]
        apexes = len(points) + np.arange(len(low))[:, None]
        blocks = {
            "wedge": cut[:, _WEDGES].reshape(-1, 6),
            "pyramid": np.concatenate([np.hstack([low[:, face], apexes]) for face in _PYRAMIDS]),
            "tetra": np.concatenate([np.hstack([low[:, face], apexes]) for face in _TETRAHEDRA]),
        }
        points = np.concatenate([points, points[low].mean(axis=1)])
        cells = tuple(Cells(kind, nodes) for kind, nodes in blocks.items() if len(nodes))
        return Mesh(points, cubes[~(at_end | on_top)], cells=cells)
