"""Hexes that stay inverted while the boundary is fixed, and proofs that sliding does not free them.

Hexes that no position of the nodes makes valid, as the connectivity at a node lets them overlap.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE
from hexmend.boundary.sliding import SlidingBoundary
from hexmend.locking.locked_corners import LockedCorner, find_locked_corners, nodes_without_space
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, locked_hexes, measure
from hexmend.quality.file_ids import name_cells, node_ids, with_ids
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
        words + (f" and {found.size - _NAMED:,} more" if found.size > _NAMED else "")
        for found, words in (
            (hexes, name_cells(mesh, hexes[:_NAMED].tolist())),
            (nodes, with_ids(nodes[:_NAMED].tolist(), node_ids(mesh))),
        )
    ]
    return (
        f"No position of the nodes makes all of {count_phrase(hexes.size, 'hex', 'hexes')} valid without overlap: "
        f"hexes {named[0]}. At {'node' if nodes.size == 1 else 'nodes'} {named[1]} two faces have the same two edges, "
        "so that hexes on the same side of them overlap or are inverted."
    )


#: Scaled Jacobian up to which a hex may be flat but for rounding.
_FLAT = 1e-5


@dataclass(frozen=True, eq=False)
class Locking:
    """Locked hexes of a mesh.

    Parameters
    ----------
    hexes : (k,) int64
        Hexes with a corner that is inverted, or flat, wherever the free nodes are while the boundary is fixed.
    needs_layer : (k,) bool
        True for those with a corner of `corners`: no movement mends them while the boundary keeps its patches and
        curves. A layer of hexes under the boundary takes them off it (`hexmend.pad`).
    unmendable : (k,) bool
        True for those that no layer mends either: at a node of theirs the faces of the boundary leave no space for
        sound hexes, such as a face with two edges on one line; or fixed nodes inside lock them.
    corners : tuple of LockedCorner
        Proofs.
    """

    hexes: np.ndarray
    needs_layer: np.ndarray
    unmendable: np.ndarray
    corners: tuple[LockedCorner, ...] = field(default=())

    @property
    def undecided(self) -> np.ndarray:
        """True for hexes that sliding may free: nothing was proved of them, (k,) bool."""
        return ~self.needs_layer & ~self.unmendable

    @property
    def phrase(self) -> str:
        """The counts as a phrase; "" without locked hexes.

        >>> from hexmend.gallery import make
        >>> find_locking(make("cube", size=8)).phrase
        ''
        """
        if not self.hexes.size:
            return ""
        marks = self.needs_layer, self.unmendable, self.undecided
        layer, neither, undecided = (int(np.count_nonzero(which)) for which in marks)
        words = [f"{self.hexes.size:,} locked"]
        if undecided:
            words.append(f"sliding may free {undecided:,}")
        if layer:
            words.append(f"{layer:,} {'needs' if layer == 1 else 'need'} another layer")
        if neither:
            words.append(f"{neither:,} that neither mends")
        return "; ".join(words)

    def to_dict(self) -> dict[str, Any]:
        """Return the lists of hexes and the proofs as plain data."""
        marks = {
            "need_layer": self.needs_layer,
            "unmendable": self.unmendable,
            "undecided": self.undecided,
        }
        corners = [
            {"hex": one.hex, "corner": one.corner, "nodes": list(one.nodes), "reason": one.reason.value}
            for one in self.corners
        ]
        lists = {name: self.hexes[which].tolist() for name, which in marks.items()}
        return {"hexes": self.hexes.tolist(), **lists, "corners": corners}


def find_locking(mesh: Mesh, feature_angle: float = FEATURE_ANGLE, quality: ElementQuality | None = None) -> Locking:
    """Find the locked hexes of a mesh, and proofs that sliding does not free them.

    Parameters
    ----------
    mesh : Mesh
    feature_angle : float
        Dihedral angle beyond which an edge is a feature; see `hexmend.boundary.boundary_of`.
    quality : ElementQuality, optional
        Of the hexes; measured if None.

    Returns
    -------
    Locking

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = make("cube", size=27)
    >>> points = mesh.points.copy()
    >>> points[0] = points[[1, 4]].mean(axis=0)  # a corner between its neighbours: two edges on one line
    >>> find_locking(mesh.with_points(points)).phrase
    '1 locked; 1 that neither mends'
    """
    quality = measure(mesh.points, mesh.elements) if quality is None else quality
    locked = locked_hexes(mesh.points, mesh.elements, mesh.fixed, quality.inverted)
    candidates = np.flatnonzero(locked | (quality.scaled_jacobian <= _FLAT))
    if not candidates.size:
        nothing = np.empty(0, dtype=bool)
        return Locking(candidates, nothing, nothing)
    sliding = SlidingBoundary(mesh, feature_angle)
    corners = find_locked_corners(mesh, sliding, candidates)
    proven = np.unique(np.array([one.hex for one in corners], dtype=np.int64))
    hexes = np.union1d(np.flatnonzero(locked), proven)
    is_proven = np.isin(hexes, proven)
    mended_by_no_layer = np.isin(hexes, _without_layer(mesh, corners, proven)) | (hexes >= mesh.n_hexes)
    unmendable = is_proven & mended_by_no_layer
    return Locking(hexes, is_proven & ~unmendable, unmendable, corners)


def _without_layer(mesh: Mesh, corners: tuple[LockedCorner, ...], hexes: np.ndarray) -> np.ndarray:
    """Find the hexes, of some (k,) with these locked corners, that no layer under the boundary mends."""
    blocked = mask(nodes_without_space(mesh, hexes), mesh.n_nodes)[mesh.elements[hexes]].any(axis=1)
    inside = [one.hex for one in corners if not mesh.topology.boundary[list(one.nodes)].any()]
    return np.union1d(hexes[blocked], np.array(inside, dtype=np.int64))
