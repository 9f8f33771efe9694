"""Sections of Gmsh's format of version 1, which is text only."""

from __future__ import annotations

import numpy as np

from hexmend.io.base.cursor import ByteCursor
from hexmend.io.formats.gmsh.sections import ElementBlock, Sections, nodes_per_element
from hexmend.io.formats.gmsh.version_2 import read_text_nodes


def read_nodes(source: ByteCursor, order: str, sections: Sections) -> None:
    """Read $NOD: a count, then the tag and the coordinates of each node."""
    read_text_nodes(source, "$NOD", b"$ENDNOD", sections)


def read_elements(source: ByteCursor, order: str, sections: Sections) -> None:
    """Read $ELM: a count, then tag, type, physical group, entity, number of nodes and nodes of each element."""
    values = source.read_numbers_until("$ELM", b"$ENDELM", np.int64)
    count = int(values[0]) if values.size else 0
    starts, at, view, widths = [], 1, memoryview(values), {}
    while at + 4 < values.size:
        type, width = view[at + 1], view[at + 4]
        if type not in widths:
            widths[type] = nodes_per_element(source.path, type)
        if width != widths[type]:
            raise source.error(f"$ELM: element {view[at]} of type {type} has {width} nodes: expected {widths[type]}")
        starts.append(at)
        at += 5 + width
    if len(starts) != count or at != values.size:
        raise source.error(f"$ELM holds {len(starts)} whole elements of {count}")
    begins = np.array(starts, np.int64)
    types = values[begins + 1]
    sections.elements = []
    for type in np.unique(types).tolist():
        rows = begins[types == type]
        nodes = values[rows[:, None] + np.arange(5, 5 + widths[type])]
        sections.elements.append(ElementBlock(type, values[rows], nodes, values[rows + 2]))
