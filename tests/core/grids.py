"""Small meshes for tests."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh


def grid(nx: int, ny: int | None = None, nz: int | None = None) -> Mesh:
    """Make a structured grid of unit cubes."""
    ny, nz = ny or nx, nz or nx
    number = np.arange((nx + 1) * (ny + 1) * (nz + 1)).reshape(nz + 1, ny + 1, nx + 1)
    z, y, x = np.meshgrid(np.arange(nz + 1), np.arange(ny + 1), np.arange(nx + 1), indexing="ij")
    points = np.column_stack([x.ravel(), y.ravel(), z.ravel()]).astype(float)
    low, high = slice(None, -1), slice(1, None)
    corners = [
        number[low, low, low], number[low, low, high], number[low, high, high], number[low, high, low],
        number[high, low, low], number[high, low, high], number[high, high, high], number[high, high, low],
    ]  # fmt: skip
    return Mesh(points, np.column_stack([c.ravel() for c in corners]), name="grid")


def scrambled(mesh: Mesh, amplitude: float, seed: int = 0) -> Mesh:
    """Displace free nodes at random by up to `amplitude` in each direction."""
    shift = np.random.default_rng(seed).uniform(-amplitude, amplitude, mesh.points.shape)
    return mesh.with_points(mesh.points + shift * mesh.free[:, None])
