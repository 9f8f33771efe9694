"""Meshes with layers for tests."""

import numpy as np

from hexmend.mesh.mesh import Mesh
from tests.core.grids import grid

#: Rotations of the unit cube as permutations of a hex's corners, each with the directions that take the place of x, y, z.
TURNS = (
    ([0, 1, 2, 3, 4, 5, 6, 7], [0, 1, 2]),
    ([1, 2, 3, 0, 5, 6, 7, 4], [1, 0, 2]),
    ([0, 3, 7, 4, 1, 2, 6, 5], [1, 2, 0]),
    ([0, 4, 5, 1, 3, 7, 6, 2], [2, 0, 1]),
)


def stack(nx=10, ny=10, layers=8, first=0.01, growth=1.3, lateral=0.2):
    """Make a block with layers on its lower side; the side set "plate" has the faces there."""
    mesh = grid(nx, ny, layers)
    heights = np.concatenate([[0.0], np.cumsum(first * growth ** np.arange(layers))])
    points = mesh.points * [lateral, lateral, 1]
    points[:, 2] = heights[np.rint(mesh.points[:, 2]).astype(int)]
    floor = np.arange(nx * ny)
    return Mesh(points, mesh.hexes, side_sets={"plate": np.stack([floor, np.full(floor.size, 4)], axis=1)})


def scrambled_in_layers(mesh, share, seed=0):
    """Displace free nodes of a stack by shares of their gaps."""
    z = np.unique(mesh.points[:, 2])
    at = np.searchsorted(z, mesh.points[:, 2])
    gap = np.minimum(np.diff(z, append=np.inf)[at], np.diff(z, prepend=-np.inf)[at])
    lateral = np.unique(mesh.points[:, 0])[1]
    shift = share * np.random.default_rng(seed).uniform(-1, 1, mesh.points.shape) * [lateral, lateral, 1]
    shift[:, 2] *= np.where(mesh.free, gap, 0)
    return mesh.with_points(mesh.points + shift * mesh.free[:, None])


def renumbered(mesh, seed):
    """Turn the numbering of each hex at random; returns the mesh and the directions (m, 3) that became x, y, z."""
    which = np.random.default_rng(seed).integers(len(TURNS), size=mesh.n_hexes)
    corners = np.array([turn for turn, _ in TURNS])[which]
    turned = Mesh(mesh.points, np.take_along_axis(mesh.hexes, corners, axis=1))
    return turned, np.array([directions for _, directions in TURNS])[which]
