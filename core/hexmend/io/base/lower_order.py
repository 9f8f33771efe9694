"""Cells of second order cut down to what a format has, for those that have less."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from hexmend.io.base.content import HEX_KINDS, Content
from hexmend.io.base.format import Capability
from hexmend.mesh.cells import CELL_KINDS
from hexmend.mesh.mesh import Mesh

#: What is left of a kind of cell without its last nodes.
_LESS = {
    "hex27": "hex20", "hex20": "hex", "tetra10": "tetra", "wedge15": "wedge", "pyramid13": "pyramid",
    "quad9": "quad8", "quad8": "quad", "triangle6": "triangle", "line3": "line",
}  # fmt: skip


def reduce_order(content: Content, kinds: Collection[str]) -> Content:
    """The content with cells of some kinds only: others lose nodes of second order, or are left out.

    Nodes that no cell has any longer, but had, are left out too, with their data and their places in sets.

    Parameters
    ----------
    content : Content
    kinds : collection of str
        What may be kept.
    """
    had, has = np.zeros(len(content.points), bool), np.zeros(len(content.points), bool)
    blocks = []
    for block in content.blocks:
        kind = block.kind
        while kind not in kinds and kind in _LESS:
            kind = _LESS[kind]
        if kind in kinds:
            width = HEX_KINDS[kind] if kind in HEX_KINDS else CELL_KINDS[kind].nodes
            had[block.nodes] = True
            blocks.append(replace(block, kind=kind, nodes=block.nodes[:, :width]))
            has[blocks[-1].nodes] = True
    kept = has | ~had
    if kept.all():
        return replace(content, blocks=tuple(blocks))
    place = np.cumsum(kept) - 1
    return replace(
        content,
        points=content.points[kept],
        blocks=tuple(replace(block, nodes=place[block.nodes]) for block in blocks),
        node_data={name: np.asarray(values)[kept] for name, values in content.node_data.items()},
        node_sets={name: place[np.asarray(one)[kept[one]]] for name, one in content.node_sets.items()},
        pinned=None if content.pinned is None else content.pinned[kept],
    )


def lost_mid_nodes(mesh: Mesh, kinds: Collection[str]) -> list[str]:
    """Describe the mid-nodes that `reduce_order` removes from cells next to hexes of first order."""
    cut = any(cells.kind in _LESS and cells.kind not in kinds for cells in mesh.cells)
    return [Capability.SECOND_ORDER.value] if cut and mesh.mid_nodes is None else []
