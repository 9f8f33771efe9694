"""Sections of Gmsh's format of version 1, which is in decimals only."""

from __future__ import annotations

import numpy as np

from hexmend.io.base.cursor import ByteCursor
from hexmend.io.formats.gmsh.content import Elements, Read, width_of
from hexmend.io.formats.gmsh.version_2 import nodes_of_rows


def read_nodes(source: ByteCursor, order: str, result: Read) -> None:
    """$NOD: a count, then the tag and the coordinates of each node."""
    nodes_of_rows(source, "$NOD", b"$ENDNOD", result)


def read_elements(source: ByteCursor, order: str, result: Read) -> None:
    """$ELM: a count, then of each element its tag, type, physical group, entity, number of nodes, and nodes."""
    values = source.read_numbers_until("$ELM", b"$ENDELM", np.int64)
    count = int(values[0]) if values.size else 0
    starts, at, view, widths = [], 1, memoryview(values), {}
    while at + 4 < values.size:
        kind, width = view[at + 1], view[at + 4]
        if kind not in widths:
            widths[kind] = width_of(source.path, kind)
        if width != widths[kind]:
            raise source.error(f"$ELM: element {view[at]} of type {kind} has {width} nodes: expected {widths[kind]}")
        starts.append(at)
        at += 5 + width
    if len(starts) != count or at != values.size:
        raise source.error(f"$ELM holds {len(starts)} whole elements of {count}")
    begins = np.array(starts, np.int64)
    types = values[begins + 1]
    result.elements = []
    for kind in np.unique(types).tolist():
        rows = begins[types == kind]
        nodes = values[rows[:, None] + np.arange(5, 5 + widths[kind])]
        result.elements.append(Elements(kind, values[rows], nodes, values[rows + 2]))
