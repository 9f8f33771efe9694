"""Original file of a mesh, and its differences from a changed mesh other than the positions of nodes."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.base.format import Capability
from hexmend.mesh.cells import Cells
from hexmend.mesh.mesh import Mesh


@dataclass(frozen=True, eq=False)
class Original:
    """File of a mesh and the mesh that was read from it.

    Parameters
    ----------
    path : Path
    mesh : Mesh
        As it was read; changes of the file since then are recognised by its coordinates.
    """

    path: Path
    mesh: Mesh


def difference(given: Mesh, mesh: Mesh, capabilities: Collection[Capability] = frozenset(Capability)) -> str:
    """Describe the first difference of two meshes other than coordinates, notes and names; empty for none.

    Parameters
    ----------
    given, mesh : Mesh
    capabilities : collection of Capability
        Of the file's format: data that it cannot hold are not compared.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> mesh = Mesh(UNIT_CUBE, [[0, 1, 2, 3, 4, 5, 6, 7]])
    >>> difference(mesh, mesh.with_points(2 * UNIT_CUBE))
    ''
    >>> difference(mesh, mesh.replace(pinned=[True] * 8))
    'other fixed nodes'
    """
    always = {
        "nodes": (given.n_nodes, mesh.n_nodes),
        "hexes": (given.hexes, mesh.hexes),
        "nodes of second order": (given.mid_nodes, mesh.mid_nodes),
        "cells of other kinds": (given.cells, mesh.cells),
    }
    kept = {
        Capability.FIXED_NODES: (_marks(given), _marks(mesh)),
        Capability.NODE_DATA: (given.node_data, mesh.node_data),
        Capability.HEX_DATA: (given.hex_data, mesh.hex_data),
        Capability.NODE_SETS: (given.node_sets, mesh.node_sets),
        Capability.HEX_SETS: (given.hex_sets, mesh.hex_sets),
        Capability.SIDE_SETS: (given.side_sets, mesh.side_sets),
        Capability.FIELD_DATA: (given.field_data, mesh.field_data),
    }
    pairs = always | {kind.value: pair for kind, pair in kept.items() if kind in capabilities}
    return next((f"other {words}" for words, (before, after) in pairs.items() if not _equal(before, after)), "")


def _marks(mesh: Mesh) -> np.ndarray | None:
    return mesh.pinned if mesh.pinned is not None and mesh.pinned.any() else None


def _equal(a: object, b: object) -> bool:
    """Return True for values that are the same or hold the same."""
    if a is b:
        return True
    if isinstance(a, Cells) and isinstance(b, Cells):
        return _equal((a.kind, a.nodes, a.data, a.sets), (b.kind, b.nodes, b.data, b.sets))
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return list(a) == list(b) and all(_equal(a[name], b[name]) for name in a)
    if isinstance(a, list | tuple) and isinstance(b, list | tuple):
        return len(a) == len(b) and all(map(_equal, a, b))
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        if a.shape != b.shape or a.dtype != b.dtype:
            return False
        return a.tobytes() == b.tobytes() if a.dtype.kind != "O" else a.tolist() == b.tolist()
    return type(a) is type(b) and a == b
