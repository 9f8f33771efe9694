"""Small meshes for tests."""

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import MID_EDGES


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


def displaced(mesh: Mesh, nodes: object, by: object) -> Mesh:
    """Move some nodes of a mesh by a vector, or by one each."""
    points = mesh.points.copy()
    points[nodes] += by
    return mesh.with_points(points)


def placed(mesh: Mesh, nodes: object, at: object) -> Mesh:
    """Put some nodes of a mesh elsewhere."""
    points = mesh.points.copy()
    points[nodes] = at
    return mesh.with_points(points)


def invalid_inside() -> Mesh:
    """Make a grid of 27 hexes one of which is invalid between positive corners; its boundary is that of a cube."""
    return scrambled(grid(3), 0.7, 847)


def with_edge_midpoints(mesh: Mesh) -> Mesh:
    """Return a mesh of second order, of hexes with 20 nodes and straight edges."""
    edges, at = np.unique(np.sort(mesh.hexes[:, MID_EDGES].reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    mid_nodes = np.full((mesh.n_hexes, 19), -1, dtype=np.int32)
    mid_nodes[:, :12] = (mesh.n_nodes + at).reshape(-1, 12)
    return Mesh(np.concatenate([mesh.points, mesh.points[edges].mean(axis=1)]), mesh.hexes, mid_nodes=mid_nodes)
