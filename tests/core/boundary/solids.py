"""Solids whose corners, curves and patches are known."""

import numpy as np

from hexmend.boundary import PartitionedSurface, SlidingBoundary
from hexmend.mesh.mesh import Mesh
from tests.core.grids import grid


def ball(n: int) -> Mesh:
    """Make a grid of n x n x n hexes whose shells are mapped to spheres; its boundary is the unit sphere."""
    mesh = grid(n)
    x = 2 * mesh.points / n - 1
    x = np.tan(np.pi / 4 * x)  # for similar angles
    size, far = np.abs(x).max(axis=1, keepdims=True), np.linalg.norm(x, axis=1, keepdims=True)
    return Mesh(x * size / np.where(far > 0, far, 1), mesh.hexes, name="ball")


def cylinder(around: int = 32, layers: int = 5) -> Mesh:
    """Make a block whose layers are mapped to discs of radius 1; its height is 1."""
    n = around // 4
    mesh = grid(n, n, layers)
    x = 2 * mesh.points[:, :2] / n - 1
    size = np.abs(x).max(axis=1, keepdims=True)
    wide = np.abs(x[:, 0]) >= np.abs(x[:, 1])
    angle = np.pi / 4 * np.where(wide, x[:, 1], x[:, 0]) / np.where(size[:, 0] > 0, size[:, 0], 1)
    far = np.sign(np.where(wide, x[:, 0], x[:, 1])) * np.cos(angle)
    disc = size * np.where(wide[:, None], np.stack([far, np.sin(angle)], 1), np.stack([np.sin(angle), far], 1))
    return Mesh(np.column_stack([disc, mesh.points[:, 2] / layers]), mesh.hexes, name="cylinder")


def wavy(mesh: Mesh, height: float, seed: int = 0) -> Mesh:
    """Displace all nodes at random by up to `height` in each direction."""
    return mesh.with_points(mesh.points + np.random.default_rng(seed).uniform(-height, height, mesh.points.shape))


def slid(mesh: Mesh, amplitude: float, seed: int = 0) -> Mesh:
    """Displace all nodes but corners at random by up to `amplitude` mean edge lengths, boundary nodes along the boundary."""
    sliding = SlidingBoundary(mesh)
    shift = np.random.default_rng(seed).uniform(-amplitude, amplitude, mesh.points.shape) * mesh.mean_edge_length
    points = mesh.points + shift * sliding.mesh.free[:, None]
    points[sliding.nodes] = sliding.project(points[sliding.nodes])
    return mesh.with_points(points)


def project(
    surface: PartitionedSurface, x: np.ndarray, nodes: np.ndarray, smooth: bool = True
) -> tuple[np.ndarray, np.ndarray]:
    """Project nodes at x onto their curves and patches; returns positions and the directions there."""
    found = surface.trees.closest(x, surface.group_of(nodes))
    return found.points, surface.directions(found, smooth)
