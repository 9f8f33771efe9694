"""Meshes with hexes or nodes fewer: what came with them is kept for those that stay."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.cells import Cells
from hexmend.mesh.mesh import Mesh


def keep_hexes(mesh: Mesh, kept: np.ndarray, stands_for: np.ndarray | None = None) -> Mesh:
    """The mesh of some of its hexes; all nodes stay.

    Parameters
    ----------
    mesh : Mesh
    kept : (m,) bool
    stands_for : (m,) int, optional
        The hex whose place in sets each one takes, where that is another: of a duplicate the one that is kept.
    """
    rows = np.flatnonzero(kept)
    place = np.full(mesh.n_hexes, -1)
    place[rows] = np.arange(len(rows))
    if stands_for is not None:
        place = place[stands_for]
    sides = {
        name: np.column_stack([place[np.asarray(faces)[:, 0]], np.asarray(faces)[:, 1]])
        for name, faces in mesh.side_sets.items()
    }
    return mesh.rebuilt(
        hexes=mesh.hexes[rows],
        hex_data={name: np.asarray(values)[rows] for name, values in mesh.hex_data.items()},
        hex_sets=_renumbered_sets(mesh.hex_sets, place),
        side_sets={name: faces[faces[:, 0] >= 0] for name, faces in sides.items() if (faces[:, 0] >= 0).any()},
        mid_nodes=None if mesh.mid_nodes is None else mesh.mid_nodes[rows],
    )


def renumber_nodes(mesh: Mesh, target: np.ndarray) -> Mesh:
    """The mesh whose nodes are renumbered.

    Parameters
    ----------
    target : (n,) int
        Where each node goes; nodes that go to one place become one, the first of them, and -1 is left out.
    """
    kept, first = np.unique(target, return_index=True)
    first = first[kept >= 0]
    mids = mesh.mid_nodes
    if mids is not None:
        mids = np.where(mids >= 0, target[mids], -1)
    return mesh.rebuilt(
        points=mesh.points[first],
        hexes=target[mesh.hexes],
        mid_nodes=mids,
        pinned=None if mesh.pinned is None else _any_by_target(mesh.pinned, target, len(first)),
        node_data={name: np.asarray(values)[first] for name, values in mesh.node_data.items()},
        node_sets=_renumbered_sets(mesh.node_sets, target),
        cells=tuple(Cells(c.kind, target[c.nodes].astype(np.int32), c.data, c.sets) for c in mesh.cells),
    )


def has_repeated_node(hexes: np.ndarray) -> np.ndarray:
    """True for each hex (m, 8) that uses a node twice, (m,) bool."""
    rows = np.sort(hexes, axis=1)
    return (rows[:, 1:] == rows[:, :-1]).any(axis=1)


def referenced_nodes(mesh: Mesh) -> np.ndarray:
    """True for each node that a hex, of whatever order, another cell or a named set uses, (n,) bool."""
    used = mesh.topology.used.copy()
    if mesh.mid_nodes is not None:
        used[mesh.mid_nodes[mesh.mid_nodes >= 0]] = True
    for cells in mesh.cells:
        used[cells.nodes] = True
    for members in mesh.node_sets.values():  # a reference point, say
        used[np.asarray(members, dtype=np.int64)] = True
    return used


def _renumbered_sets(sets: dict, place: np.ndarray) -> dict[str, np.ndarray]:
    """Sets of those that stay, in their new numbers; a set of which nothing stays is left out."""
    answer = {}
    for name, members in sets.items():
        there = place[np.asarray(members, dtype=np.int64)]
        there = np.unique(there[there >= 0])
        if len(there):
            answer[name] = there
    return answer


def _any_by_target(marks: np.ndarray, target: np.ndarray, count: int) -> np.ndarray:
    answer = np.zeros(count, dtype=bool)
    answer[target[marks & (target >= 0)]] = True
    return answer
