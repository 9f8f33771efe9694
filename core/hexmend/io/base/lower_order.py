"""Reduction of second-order cells for formats that support lower orders only."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from hexmend.io.base.content import Content, node_count
from hexmend.io.base.format import Capability
from hexmend.mesh.mesh import Mesh

#: Kind of cell that remains without the last nodes of a kind.
_LOWER = {
    "hex27": "hex20", "hex20": "hex", "tetra10": "tetra", "wedge15": "wedge", "pyramid13": "pyramid",
    "quad9": "quad8", "quad8": "quad", "triangle6": "triangle", "line3": "line",
}  # fmt: skip


def reduce_order(content: Content, kinds: Collection[str]) -> Content:
    """Restrict a content to some kinds of cells: others lose mid-nodes or are left out.

    Nodes that belonged to cells and no longer do are left out, with their data and their entries in sets.

    Parameters
    ----------
    content : Content
    kinds : collection of str
        Kinds that may remain.

    Returns
    -------
    Content
    """
    before, after = np.zeros(len(content.points), bool), np.zeros(len(content.points), bool)
    blocks = []
    for block in content.blocks:
        kind = block.kind
        while kind not in kinds and kind in _LOWER:
            kind = _LOWER[kind]
        if kind in kinds:
            before[block.nodes] = True
            blocks.append(replace(block, kind=kind, nodes=block.nodes[:, : node_count(kind)]))
            after[blocks[-1].nodes] = True
    kept = after | ~before
    if kept.all():
        return replace(content, blocks=tuple(blocks))
    new_index, points = np.cumsum(kept) - 1, content.points[kept]
    blocks = tuple(replace(block, nodes=new_index[block.nodes]) for block in blocks)
    data = {name: np.asarray(values)[kept] for name, values in content.node_data.items()}
    sets = {name: new_index[np.asarray(nodes)[kept[nodes]]] for name, nodes in content.node_sets.items()}
    pinned = None if content.pinned is None else content.pinned[kept]
    return replace(content, points=points, blocks=blocks, node_data=data, node_sets=sets, pinned=pinned)


def lost_mid_nodes(mesh: Mesh, kinds: Collection[str]) -> list[str]:
    """Describe the mid-nodes that `reduce_order` removes from cells next to hexes of first order."""
    reduced = any(cells.kind in _LOWER and cells.kind not in kinds for cells in mesh.cells)
    return [Capability.SECOND_ORDER.value] if reduced and mesh.mid_nodes is None else []
