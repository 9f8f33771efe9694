"""Layered: a cylinder with boundary layers on its curved wall.

Materials: a ball in a box, two materials with a curved interface.

Kershaw: a lattice of the unit cube, bent into zigzag layers; a benchmark of smoothing whose optimum is known.

Cube: a structured grid of the unit cube, whose optimum is known.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.gallery.gallery_mesh import GalleryMesh, box_hexes, extrude, gallery_mesh, tensor_product
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import Topology
from hexmend.parameters import parameter

#: Number of hexes around the cylinder over that along it.
_AROUND_PER_ALONG = 4


@gallery_mesh
@dataclass(frozen=True)
class Layered(GalleryMesh):
    """Layers around a cylinder of radius 1/2: heights grow from its wall by a fixed ratio.

    Scrambling displaces each free node by a share of its gap to the layers below and above, and of the distance of its
    neighbours in the layer.
    """

    name = "layered"
    title = "Cylinder with layers"
    help = "The mesh around a cylinder, of layers whose heights grow from the wall by a fixed ratio."
    source = "Hexmend"

    size: int = parameter(15360, low=128, high=10**8, help="Approximate number of hexes.")
    layers: int = parameter(20, low=3, high=200, help="Number of layers.")
    first_height: float = parameter(1e-4, low=1e-9, high=1, unit="diameters", help="Height of the first layer.")
    growth: float = parameter(1.2, low=1.0, high=3.0, help="Ratio of successive heights.")

    def regular(self) -> Mesh:
        around, along = self._counts
        radii = self._radii
        angles = 2 * np.pi * np.arange(around) / around
        planes = np.arange(along + 1) * (2 * np.pi * radii[0] / around)
        ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        plane = (radii[:, None, None] * ring).reshape(-1, 2)
        points = np.concatenate([np.insert(plane, 2, z, axis=1) for z in planes])
        at = np.arange(len(plane)).reshape(len(radii), around)
        following = np.roll(at, -1, axis=1)
        quads = np.stack([at[:-1], at[1:], following[1:], following[:-1]], axis=-1).reshape(-1, 4)
        mesh = Mesh(points, extrude(quads, len(plane), along))
        return mesh.replace(side_sets=_sides(mesh, around, self.layers))

    def scrambled(self, mesh: Mesh) -> Mesh:
        around, _ = self._counts
        radii = self._radii
        gaps = np.diff(radii)
        least = np.minimum(np.append(gaps, np.inf), np.insert(gaps, 0, np.inf))
        layer = np.arange(mesh.n_nodes) // around % len(radii)
        lateral = 2 * np.pi * radii / around
        outward = mesh.points * [1, 1, 0] / radii[layer, None]
        across = np.stack([-outward[:, 1], outward[:, 0], np.zeros(mesh.n_nodes)], axis=1)
        shares = self.scramble * np.random.default_rng(self.seed).uniform(-1, 1, (mesh.n_nodes, 3))
        moves = (shares[:, :1] * least[layer, None]) * outward + (shares[:, 1:2] * lateral[layer, None]) * across
        moves[:, 2] = shares[:, 2] * lateral[0]
        return mesh.with_points(mesh.points + np.where(mesh.free[:, None], moves, 0.0))

    @property
    def _counts(self) -> tuple[int, int]:
        """Numbers of hexes around the cylinder and along it."""
        along = max(2, round((self.size / self.layers / _AROUND_PER_ALONG) ** 0.5))
        return max(8, round(self.size / self.layers / along)), along

    @property
    def _radii(self) -> np.ndarray:
        """Radii of the layers' surfaces, (layers + 1,)."""
        heights = self.first_height * self.growth ** np.arange(self.layers)
        return 0.5 + np.concatenate([[0.0], np.cumsum(heights)])


def _sides(mesh: Mesh, around: int, layers: int) -> dict[str, np.ndarray]:
    """Side sets: the wall and the outer boundary."""
    number = np.arange(mesh.n_hexes)
    layer = number // around % layers
    return {
        name: np.stack([which, np.full(which.size, face)], axis=1)
        for name, which, face in (("cylinder", number[layer == 0], 0), ("outside", number[layer == layers - 1], 1))
    }


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
