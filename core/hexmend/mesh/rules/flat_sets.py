"""Flat sets, whose nodes move in their plane."""

from __future__ import annotations

import numpy as np

from hexmend.errors import MeshError
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import nodes_in_set

#: Largest distance of nodes from their plane, in mean edge lengths of the mesh.
FLATNESS_TOLERANCE = 1e-6
#: Relative rounding error of coordinates in one plane.
_ROUNDING = 1e-12


def _on_a_line(count: int) -> str:
    return f"expected three nodes or more, it has {count}" if count < 3 else f"its {count} nodes are on one line"


def normal_of_set(mesh: Mesh, name: str) -> np.ndarray:
    """Find the normal of the plane in which the nodes of a set lie.

    Parameters
    ----------
    mesh : Mesh
    name : str
        Name of a set of nodes, sides or quads.

    Returns
    -------
    (3,) float64
        A unit vector; an axis to the last bit if the coordinates along it are equal but for rounding.

    Raises
    ------
    MeshError
        For a set that does not exist, and for nodes that are on one line or further from a plane than
        `FLATNESS_TOLERANCE`; the message says how far.
    """
    nodes = np.unique(nodes_in_set(mesh, name))
    x = mesh.points[nodes]
    unit = mesh.mean_edge_length or 1.0
    x = (x - x.mean(axis=0)) / unit if nodes.size else x
    axes = np.linalg.eigh(x.T @ x)[1]  # the first direction is that of least extent
    if nodes.size < 3 or np.abs(x @ axes[:, :2]).max() <= FLATNESS_TOLERANCE:
        raise MeshError(f"the set {name!r} has no plane: {_on_a_line(nodes.size)}")
    distance = np.abs(x @ axes[:, 0])
    if distance.max() > FLATNESS_TOLERANCE:
        raise MeshError(
            f"the set {name!r} is not flat: node {nodes[distance.argmax()]} (counted from 0) is {distance.max():.3g} "
            f"mean edge lengths from the plane nearest to all its nodes; expected at most {FLATNESS_TOLERANCE:g}. Let "
            "it slide on the surface instead (--slide)."
        )
    across = np.ptp(x, axis=0).argmin()
    return np.eye(3)[across] if np.ptp(x[:, across]) <= _ROUNDING * max(1.0, np.ptp(x)) else axes[:, 0]
