"""Segment of a cylinder's wall of second-order hexes whose nodes lie exactly on circles."""

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import NODE_POSITIONS


def curved_shell(nodes=20, through=1, around=4, along=1, angle=np.pi / 2, inner=1.0, outer=2.0, length=1.0):
    """Return a segment of a cylinder about the z-axis, of hexes with 20 or 27 nodes.

    The faces x+ of hexes look outwards, y+ around the axis and z+ along it.
    """
    cells = np.stack(np.meshgrid(np.arange(through), np.arange(around), np.arange(along), indexing="ij"), axis=-1)
    at = 2 * cells.reshape(-1, 1, 3) + np.rint(2 * NODE_POSITIONS[:nodes]).astype(int)
    lattice, index = np.unique(at.reshape(-1, 3), axis=0, return_inverse=True)
    index = index.reshape(-1, nodes)
    share = lattice / (2 * np.array([through, around, along]))
    radius, phi = inner + (outer - inner) * share[:, 0], angle * share[:, 1]
    points = np.column_stack([radius * np.cos(phi), radius * np.sin(phi), length * share[:, 2]])
    mid_nodes = np.full((len(index), 19), -1)
    mid_nodes[:, : nodes - 8] = index[:, 8:]
    return Mesh(points, index[:, :8], mid_nodes=mid_nodes)
