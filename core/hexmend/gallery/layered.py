"""Layered: a cylinder with boundary layers on its curved wall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.gallery.gallery_mesh import GalleryMesh, extrude, gallery_mesh
from hexmend.mesh.mesh import Mesh
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
