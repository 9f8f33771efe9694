"""Faces on which nodes slide: the boundary's, then the faces of interfaces between materials."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary.edges import SurfaceEdges
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import boundary_faces_in_sets


class SkinFaces(NamedTuple):
    """Faces of the boundary and of interfaces.

    Parameters
    ----------
    faces : (k, 4) int32
        Nodes of each face. Those of the boundary come first, counter-clockwise from outside; those of interfaces are
        counter-clockwise from the hex across them, so that the faces of one interface have one orientation.
    hexes : (k, 2) int64
        The hex of each face, and the hex across it, -1 on the boundary.
    """

    faces: np.ndarray
    hexes: np.ndarray


def skin_faces(mesh: Mesh) -> SkinFaces:
    """Return the boundary faces of a mesh, and the faces of interfaces on which nodes are kept or slide.

    Faces of freed nodes next to nodes that are not freed are among them: an interface has no hole where a node left it.
    """
    hexes, _ = np.nonzero(mesh.topology.face_neighbours < 0)
    faces, hexes = mesh.topology.boundary_faces, np.stack([hexes, np.full_like(hexes, -1)], axis=1)
    materials, free = mesh.interfaces, mesh.node_rules.free
    if materials is None:
        return SkinFaces(faces, hexes)
    between = materials.interface_faces
    kept = slice(None) if free is None else _holds_interface(between, free, mesh.topology.boundary)
    both = materials.interface_sides[kept][:, [0, 2]]
    return SkinFaces(np.concatenate([faces, between[kept]]), np.concatenate([hexes, both]))


def _holds_interface(faces: np.ndarray, free: np.ndarray, boundary: np.ndarray) -> np.ndarray:
    """Mark the faces (k, 4) of interfaces that have no freed node, or one in a face with an inner node on it, (k,)."""
    freed = free[faces]
    slides = (~freed & ~boundary[faces]).any(axis=1)
    near = mask(faces[slides], len(free))
    return ~freed.any(axis=1) | (freed & near[faces]).any(axis=1)


def edges_between_sets(mesh: Mesh) -> np.ndarray:
    """Find the boundary edges at which a set of sides, quads or nodes ends, (e, 2) int.

    Of a set of nodes without a whole face these are the edges between two of its nodes.
    """
    faces, sets = mesh.topology.boundary_faces, boundary_faces_in_sets(mesh)
    lines = _node_lines(mesh)
    if not sets and not lines:
        return np.empty((0, 2), dtype=np.int32)
    edges = SurfaceEdges(faces, mesh.n_nodes)
    ends = np.zeros(len(edges.nodes), dtype=bool)
    for marks in sets.values():
        ends |= marks[edges.neighbours[:, 0]] != marks[edges.neighbours[:, 1]]
    for nodes in lines:
        ends |= nodes[edges.nodes].all(axis=1)
    return edges.nodes[ends]


def _node_lines(mesh: Mesh) -> list[np.ndarray]:
    """Marks, (n,) bool, of the nodes of each node set that holds two nodes of the boundary and no whole face of it."""
    found, faces, boundary = [], mesh.topology.boundary_faces, mesh.topology.boundary
    for nodes in mesh.node_sets.values():
        marks = mask(nodes, mesh.n_nodes) & boundary
        if np.count_nonzero(marks) > 1 and not marks[faces].all(axis=1).any():
            found.append(marks)
    return found


def lone_set_nodes(mesh: Mesh) -> np.ndarray:
    """Find the boundary nodes of sets of nodes that have no edge or face of the boundary in the set, (c,) int."""
    found = [np.empty(0, dtype=np.int64)]
    for nodes in mesh.node_sets.values():
        nodes = np.unique(nodes)
        nodes = nodes[mesh.topology.boundary[nodes]]
        if 0 < nodes.size < mesh.topology.n:
            marks = mask(nodes, mesh.n_nodes)
            rings = mesh.topology.rings
            at = np.repeat(np.arange(nodes.size), rings.start[nodes + 1] - rings.start[nodes])
            neighbours = np.bincount(at, marks[rings.of(nodes)], minlength=nodes.size)
            found.append(nodes[neighbours == 0])
    return np.concatenate(found)
