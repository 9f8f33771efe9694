"""Flat sets, whose nodes move in their plane."""

from __future__ import annotations

import numpy as np

from hexmend.errors import MeshError
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import nodes_in_set

#: Largest distance of nodes from their plane, in mean edge lengths of the mesh.
FLATNESS_TOLERANCE = 1e-6


def plane_of_set(mesh: Mesh, name: str) -> LinearMotion:
    """Restrict the nodes of a set to the plane in which they lie.

    Parameters
    ----------
    mesh : Mesh
    name : str
        Name of a set of nodes, sides or quads.

    Returns
    -------
    LinearMotion

    Raises
    ------
    MeshError
        For a set that does not exist, and for nodes that are on one line or further from a plane than
        `FLATNESS_TOLERANCE`; the message says how far.
    """
    nodes = np.unique(nodes_in_set(mesh, name))
    x = mesh.points[nodes] - mesh.points[nodes].mean(axis=0)
    unit = mesh.mean_edge_length or 1.0
    extents, axes = np.linalg.eigh(x.T @ x)  # the first direction is that of least extent
    if nodes.size < 3 or np.abs(x @ axes[:, :2]).max() <= FLATNESS_TOLERANCE * unit or not extents[1] > 0:
        raise MeshError(f"the set {name!r} has no plane: its {nodes.size} nodes are on one line")
    distance = np.abs(x @ axes[:, 0])
    if distance.max() > FLATNESS_TOLERANCE * unit:
        node = int(nodes[distance.argmax()])
        raise MeshError(
            f"the set {name!r} is not flat: node {node} (counted from 0) is {distance.max() / unit:.3g} mean edge "
            f"lengths from the plane nearest to all its nodes; expected at most {FLATNESS_TOLERANCE:g}. Let it slide "
            "on the surface instead (--slide)."
        )
    return LinearMotion.in_planes(nodes, axes[:, 0])
