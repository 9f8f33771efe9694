"""Removal of hexes and merging of nodes; data and sets of the others are kept."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from hexmend.arrays import mask
from hexmend.mesh.cells import Cells
from hexmend.mesh.collapsed_hexes import keep_hexes, renumbered_sets
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import solid_blocks


def extract_hexes(mesh: Mesh, kept: np.ndarray) -> Mesh:
    """Return the mesh of some cells: their nodes, and cells of lower dimension on these; sets and data are kept.

    Parameters
    ----------
    mesh : Mesh
    kept : (m,) bool
        True for the cells of `Mesh.elements` in the new mesh.

    Returns
    -------
    Mesh
    """
    ends = mesh.n_hexes + np.cumsum([0, *(len(block.nodes) for block in solid_blocks(mesh.cells))])
    of_blocks = [kept[start:end] for start, end in pairwise(ends)]
    solids = [_some_of(block, rows) for block, rows in zip(solid_blocks(mesh.cells), of_blocks, strict=True)]
    kept = kept[: mesh.n_hexes]
    used = mask(mesh.hexes[kept], mesh.n_nodes)
    if mesh.mid_nodes is not None:
        mids = mesh.mid_nodes[kept]
        used[mids[mids >= 0]] = True
    for block in solids:
        used[block.nodes] = True
    cells = (*solids, *(_some_of(c, used[c.nodes].all(axis=1)) for c in mesh.cells if c.dimension < 3))
    part = keep_hexes(mesh.rebuilt(cells=tuple(c for c in cells if len(c.nodes))), kept)
    return renumber_nodes(part, np.where(used, np.cumsum(used) - 1, -1))


def _some_of(cells: Cells, kept: np.ndarray) -> Cells:
    """Cells that are marked in `kept`, (k,) bool, with their data and sets."""
    data = {name: values[kept] for name, values in cells.data.items()}
    return Cells(
        cells.kind, cells.nodes[kept], data, renumbered_sets(cells.sets, np.where(kept, np.cumsum(kept) - 1, -1))
    )


def renumber_nodes(mesh: Mesh, target: np.ndarray) -> Mesh:
    """Return the mesh with its nodes renumbered, merged or removed.

    Parameters
    ----------
    mesh : Mesh
    target : (n,) int
        New number of each node; nodes of one number are merged into the first of them, nodes of -1 removed.

    Returns
    -------
    Mesh
    """
    kept, first = np.unique(target, return_index=True)
    first = first[kept >= 0]
    mids = mesh.mid_nodes
    rebuilt = mesh.rebuilt(
        points=mesh.points[first],
        hexes=target[mesh.hexes],
        mid_nodes=None if mids is None else np.where(mids >= 0, target[mids], -1),
        pinned=None if mesh.pinned is None else np.isin(np.arange(len(first)), target[mesh.pinned]),
        node_data={name: values[first] for name, values in mesh.node_data.items()},
        node_sets=renumbered_sets(mesh.node_sets, target),
        cells=tuple(Cells(c.kind, target[c.nodes].astype(np.int32), c.data, c.sets) for c in mesh.cells),
    )
    own = mesh.without_motion_of_rules()  # the rules name nodes as they were, and are gone
    motion = own.linear_motion
    return rebuilt if motion is None else rebuilt.with_linear_motion(motion.renumbered(target), own.motion_start[first])


def referenced_nodes(mesh: Mesh) -> np.ndarray:
    """Return True for nodes that a hex (as corner or mid-node), another cell, a named set or a pin uses, (n,) bool."""
    used = mesh.topology.used.copy()
    if mesh.pinned is not None:  # such as the reference node of a rigid body
        used |= mesh.pinned
    if mesh.mid_nodes is not None:
        used[mesh.mid_nodes[mesh.mid_nodes >= 0]] = True
    for cells in mesh.cells:
        used[cells.nodes] = True
    for members in mesh.node_sets.values():  # such as a reference point
        used[members] = True
    return used
