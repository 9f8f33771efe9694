"""Growth of layers from a surface, and two ways in which the nodes around give way: diffusion and relaxation."""

from __future__ import annotations

import numpy as np

from hexmend.kernels import laplacian, local
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import Topology

#: Averagings over neighbours of a layer's normals and, once, of the widths of quads on the surface.
AVERAGINGS = 6
#: delta of the relaxation, in cubes of mean edge lengths, and p and offset of its objective.
DELTA, NORM = 0.01, (2.0, 0.0)


def grow_layers(points: np.ndarray, quads: np.ndarray, layers: int, thickness: float) -> np.ndarray:
    """Grow layers from a surface along its normals, which are averaged over neighbours anew for each layer.

    Parameters
    ----------
    points : (n, 3) float64
        Nodes of the surface.
    quads : (k, 4) int
        Clockwise seen from the side of the layers.
    layers : int
    thickness : float
        Of a layer, over the averaged width of the quads on the surface.

    Returns
    -------
    (layers + 1, n, 3) float64
        The surface and the layers, inwards to outwards.
    """
    sides = np.concatenate([quads[:, [i, (i + 1) % 4]] for i in range(4)])
    sides = np.concatenate([sides, sides[:, ::-1]])  # each edge as often from either end
    count = np.bincount(sides[:, 0])[:, None]

    def averaged(values: np.ndarray) -> np.ndarray:
        for _ in range(AVERAGINGS):
            values = (values + sum_at_nodes(sides[:, 0], values[sides[:, 1]], len(points)) / count) / 2
        return values

    height = thickness * averaged(_normals(points, quads)[1][:, None])
    surfaces = [points]
    for _ in range(layers):
        normal = averaged(_normals(surfaces[-1], quads)[0])
        surfaces.append(surfaces[-1] + height * normal / np.linalg.norm(normal, axis=1, keepdims=True))
    return np.array(surfaces)


def _normals(points: np.ndarray, quads: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mean unit normals of the quads at each node, (n, 3), and mean widths of these quads, (n,)."""
    a, b, c, d = (points[quads[:, i]] for i in range(4))
    normal = -np.cross(c - a, d - b)
    double_area = np.linalg.norm(normal, axis=1)
    corners = quads.ravel()
    mean = sum_at_nodes(corners, np.repeat(normal / double_area[:, None], 4, axis=0), len(points))
    width = np.bincount(corners, np.repeat(np.sqrt(double_area / 2), 4)) / np.bincount(corners)
    return mean, width


def diffuse(move: np.ndarray, fixed: np.ndarray, hexes: np.ndarray, sweeps: int) -> np.ndarray:
    """Replace the displacement of each node that is not fixed by the mean of its edge neighbours, `sweeps` times."""
    ring = Topology(hexes.astype(np.int32), len(move)).rings
    nodes = np.flatnonzero(~fixed & (np.diff(ring.start) > 0)).astype(np.int32)
    move = move.copy()
    for _ in range(sweeps):
        laplacian.in_place(move, ring.start, ring.items, nodes)
    return move


def relax(mesh: Mesh, sweeps: int) -> Mesh:
    """Move the free nodes one by one down the gradient of the distortion of their hexes, `sweeps` times."""
    points, topology = mesh.points.copy(), mesh.topology
    groups = topology.colouring(mesh.free)
    settings = local.NodeStepSettings(local.Direction.STEEPEST_DESCENT, DELTA, NORM, LineSearch())
    for _ in range(sweeps):
        local.sweep(points, topology.hex_mesh, groups.start, groups.items, settings)
    return mesh.with_points(points)


def sum_at_nodes(at: np.ndarray, values: np.ndarray, n: int) -> np.ndarray:
    """Sum the rows of values (k, d) by node, (n, d); row i belongs to node at[i]."""
    return np.column_stack([np.bincount(at, column, n) for column in values.T])
