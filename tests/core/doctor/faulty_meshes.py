"""Meshes with planted problems."""

import numpy as np

from hexmend.doctor import examine, repair
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import mirror_hexes
from hexmend.mesh.second_order import MID_EDGES
from tests.core.grids import grid

SOUND = grid(3)


def found_in(mesh):
    return {finding.kind: finding for finding in examine(mesh)}


def with_hexes(hexes):
    return Mesh(SOUND.points, hexes)


def blocks(gap=0.0):
    """Make two adjacent blocks whose nodes are not merged."""
    other = SOUND.points + [SOUND.points[:, 0].max() + gap, 0, 0]
    return Mesh(np.vstack([SOUND.points, other]), np.vstack([SOUND.hexes, SOUND.hexes + SOUND.n_nodes]))


def flipped(*which):
    marks = np.zeros(SOUND.n_hexes, dtype=bool)
    marks[list(which)] = True
    return mirror_hexes(SOUND, marks)


def collapsed():
    """Make a mesh whose corner hex has edges 01 and 45 collapsed, a wedge."""
    hexes = SOUND.hexes.copy()
    hexes[0, 1], hexes[0, 5] = hexes[0, 0], hexes[0, 4]
    return with_hexes(hexes)


def second_order_grid():
    """Make a cube of eight hexes of 20 nodes with edges of length 1, all of them straight."""
    mesh = grid(2)
    mesh = mesh.with_points(mesh.points / mesh.mean_edge_length)
    edges, place = np.unique(np.sort(mesh.hexes[:, MID_EDGES].reshape(-1, 2)), axis=0, return_inverse=True)
    mids = np.full((mesh.n_hexes, 19), -1)
    mids[:, :12] = mesh.n_nodes + place.reshape(-1, 12)
    return Mesh(np.vstack([mesh.points, mesh.points[edges].mean(axis=1)]), mesh.hexes, mid_nodes=mids)


def bent(inside, start=None):
    """Move a mid-node of an edge by its length: inside the mesh, where four hexes share it, or on one of its edges."""
    mesh = start or second_order_grid()
    users = np.bincount(mesh.mid_nodes[:, :12].ravel(), minlength=mesh.n_nodes)
    node = np.flatnonzero(users == (4 if inside else 1))[0]
    points = mesh.points.copy()
    points[node] += mesh.points.mean(axis=0) - mesh.points[node] + [0.1, 0.2, 0.3]
    return mesh.rebuilt(points=points)


def hanging():
    """Make a hex with four hexes of half its size on one of its faces."""
    fine = grid(2)
    fine = Mesh(fine.points * 0.5, fine.hexes)
    coarse = UNIT_CUBE * np.ptp(fine.points[:, 0]) + [fine.points[:, 0].max(), 0, 0]
    mesh = Mesh(np.vstack([fine.points, coarse]), np.vstack([fine.hexes, [np.arange(8) + fine.n_nodes]]))
    return repair(mesh, ["coincident-nodes"])[0]
