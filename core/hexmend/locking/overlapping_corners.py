"""Hexes that no position of the nodes makes valid, as the connectivity at a node lets them overlap."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality.file_ids import hex_ids, node_ids, with_ids
from hexmend.terminal_text import count_phrase

#: Hexes and nodes that a sentence names.
_NAMED = 10


def hexes_without_valid_position(mesh: Mesh) -> np.ndarray:
    """Find hexes that are not all valid wherever the nodes are, by `Topology.overlapping_corners`.

    Let two corners at a node have the edges a, b, c and a, b, d, both right-handed: their faces with the edges a and b
    are two, and both hexes lie on one side of these. If both corners are positive, c = r a + s b + t d with
    t = det(a, b, c) / det(a, b, d) > 0, so that a + b + e c = (1 + e r) a + (1 + e s) b + e t d is in the cones of both
    for a small e > 0. A hex fills the cone of a positive corner near the node: the hexes overlap. Positive hexes less
    inverted ones cover each point inside a boundary that does not overlap itself once, so that a hex is inverted there.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    (k,) int32
        Numbers of hexes, ascending.
    """
    return np.unique(mesh.topology.overlapping_corners.items // 8)


def nodes_without_valid_position(mesh: Mesh) -> np.ndarray:
    """Find the nodes at which hexes of `hexes_without_valid_position` overlap, (k,) int64, ascending."""
    return np.flatnonzero(np.diff(mesh.topology.overlapping_corners.start))


def describe_overlap(mesh: Mesh) -> str:
    """Name the hexes of `hexes_without_valid_position` and the nodes at which they overlap; "" where there are none.

    >>> from hexmend.gallery import make
    >>> describe_overlap(make("cube", size=8))
    ''
    """
    hexes, nodes = hexes_without_valid_position(mesh), nodes_without_valid_position(mesh)
    if not hexes.size:
        return ""
    named = [
        with_ids(found[:_NAMED].tolist(), ids) + (f" and {found.size - _NAMED:,} more" if found.size > _NAMED else "")
        for found, ids in ((hexes, hex_ids(mesh)), (nodes, node_ids(mesh)))
    ]
    return (
        f"No position of the nodes makes all of {count_phrase(hexes.size, 'hex', 'hexes')} valid without overlap: "
        f"hexes {named[0]}. At {'node' if nodes.size == 1 else 'nodes'} {named[1]} two faces have the same two edges, "
        "so that hexes on the same side of them overlap or are inverted."
    )
