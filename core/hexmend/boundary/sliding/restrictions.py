"""Nodes of a surface that do not slide on it: the rules of the mesh let them stay, or move freely."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.two_dimensional import flat_sides


def interface_nodes(mesh: Mesh) -> np.ndarray:
    """Mark the nodes between materials that are kept or slide, (n,) bool."""
    materials, free = mesh.interfaces, mesh.node_rules.free
    if materials is None:
        return np.zeros(mesh.n_nodes, dtype=bool)
    return materials.interface_nodes if free is None else materials.interface_nodes & ~free


def fixed_on_surface(mesh: Mesh, outer: bool) -> np.ndarray:
    """Mark the nodes of the boundary and of interfaces that stay, (n,) bool.

    Parameters
    ----------
    mesh : Mesh
    outer : bool
        The boundary slides; interfaces that are kept slide with it.

    Returns
    -------
    (n,) bool
    """
    rules, between = mesh.node_rules, interface_nodes(mesh)
    boundary = mesh.topology.boundary
    stays = np.zeros(mesh.n_nodes, dtype=bool) if outer else boundary.copy()
    slides = rules.interfaces == "slide" or (outer and rules.interfaces == "keep")
    if mesh.target is not None or not slides:  # a target says nothing about interfaces
        stays |= between
    if rules.slides is not None:
        stays &= ~rules.slides
    return stays | mesh.immovable | flat_sides(mesh)  # whose nodes move in their planes, or not at all


def freed_by_rules(mesh: Mesh) -> np.ndarray:
    """Find the nodes of the surface that move otherwise than on it: freed ones, and those with a linear motion."""
    motion, rules = mesh.linear_motion, mesh.node_rules
    moves = np.zeros(mesh.n_nodes, dtype=bool) if motion is None else motion.marks(mesh.n_nodes)
    if rules.free is not None:
        moves |= rules.free & ~mesh.topology.boundary
    return np.flatnonzero(moves & ~mesh.fixed)


def moving_with_surface(mesh: Mesh, faces: np.ndarray) -> np.ndarray:
    """Mark the faces of `hexmend.boundary.skin_faces` that stay on the surface: freed nodes take theirs off interfaces.

    Parameters
    ----------
    mesh : Mesh
    faces : (k, 4) int32
        Those of the boundary first.

    Returns
    -------
    (k,) bool
    """
    free = mesh.node_rules.free
    stays = np.ones(len(faces), dtype=bool)
    first = len(mesh.topology.boundary_faces)
    if free is not None:
        stays[first:] = ~free[faces[first:]].any(axis=1)
    return stays
