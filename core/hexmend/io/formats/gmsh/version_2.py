"""Sections of Gmsh's format of version 2, in decimals and binary."""

from __future__ import annotations

import numpy as np

from hexmend.io.base.cursor import ByteCursor
from hexmend.io.formats.gmsh.content import Elements, Read, width_of


def read_nodes(source: ByteCursor, order: str, result: Read) -> None:
    """$Nodes: a count, then the tag and the coordinates of each node."""
    if order:
        count = source.parse_count(source.next_line(), "the number of nodes")
        rows = source.read_binary("$Nodes", count, 1, [("tag", f"{order}i4"), ("x", f"{order}f8", 3)])[:, 0]
        result.tags, result.points = rows["tag"].astype(np.int64), rows["x"].astype(np.float64)
        _expect(source, "$EndNodes")
        return
    nodes_of_rows(source, "$Nodes", b"$EndNodes", result)


def nodes_of_rows(source: ByteCursor, name: str, end: bytes, result: Read) -> None:
    """Nodes in decimals: a count, then the tag and the coordinates of each."""
    values = source.read_numbers_until(name, end, np.float64)
    count = int(values[0]) if values.size and np.isfinite(values[0]) else 0
    if values.size != 1 + 4 * count:
        raise source.error(f"{name} holds {values.size} numbers: expected {1 + 4 * count} for {count} nodes")
    rows = values[1:].reshape(count, 4)
    result.tags, result.points = whole_tags(source, rows[:, 0]), np.ascontiguousarray(rows[:, 1:])


def read_elements(source: ByteCursor, order: str, result: Read) -> None:
    """$Elements: a count, then of each element its tag, type, number of groups, groups and nodes.

    In binary type, how many follow and number of groups stand before the elements that share them.
    """
    if order:
        result.elements = _binary(source, order)
        return
    values = source.read_numbers_until("$Elements", b"$EndElements", np.int64)
    count = int(values[0]) if values.size else 0
    starts, at, view, widths = [], 1, memoryview(values), {}
    while at + 2 < values.size:
        kind = view[at + 1]
        if kind not in widths:
            widths[kind] = 3 + width_of(source.path, kind)
        if view[at + 2] < 0:
            break
        starts.append(at)
        at += widths[kind] + view[at + 2]
    if len(starts) != count or at != values.size:
        raise source.error(f"$Elements holds {len(starts)} whole elements of {count}")
    begins = np.array(starts, np.int64)
    types, extra = values[begins + 1], values[begins + 2]
    result.elements = []
    for kind, more in np.unique(np.column_stack([types, extra]), axis=0).tolist():
        rows = begins[(types == kind) & (extra == more)]
        nodes = values[rows[:, None] + np.arange(3 + more, widths[kind] + more)]
        numbers = values[rows[:, None] + np.arange(3, 3 + more)]
        result.elements.append(Elements(kind, values[rows], nodes, *_group_and_partition(numbers)))


def _binary(source: ByteCursor, order: str) -> list[Elements]:
    count = source.parse_count(source.next_line(), "the number of elements")
    found, seen = [], 0
    while seen < count:
        kind, follow, more = source.read_binary("$Elements", 1, 3, f"{order}i4")[0].tolist()
        if follow < 1 or more < 0 or more > len(source.data):
            raise source.error(f"$Elements announces {follow} elements with {more} groups at {source.location}")
        rows = source.read_binary("$Elements", follow, 1 + more + width_of(source.path, kind), f"{order}i4")
        rows = rows.astype(np.int64)
        found.append(Elements(kind, rows[:, 0], rows[:, 1 + more :], *_group_and_partition(rows[:, 1 : 1 + more])))
        seen += follow
    if seen != count:
        raise source.error(f"$Elements holds {seen} elements: expected {count}")
    _expect(source, "$EndElements")
    return found


def _group_and_partition(numbers: np.ndarray) -> tuple[np.ndarray, np.ndarray | None]:
    """The physical group and the first partition of elements, (k,) int64 each; 0 where an element has none.

    Of the numbers (k, more) the first is the group, the third says how many partitions follow.
    """
    group = numbers[:, 0] if numbers.shape[1] else np.zeros(len(numbers), np.int64)
    return group, np.where(numbers[:, 2] > 0, numbers[:, 3], 0) if numbers.shape[1] > 3 else None


def whole_tags(source: ByteCursor, values: np.ndarray) -> np.ndarray:
    """Tags of nodes that stand among coordinates, (n,) int64."""
    tags = np.where(np.isfinite(values) & (np.abs(values) < 2.0**53), values, -0.5)
    if (tags != np.floor(tags)).any() or (tags < 1).any():
        wrong = values[(tags != np.floor(tags)) | (tags < 1)][0]
        raise source.error(f"$Nodes holds the tag {wrong:g}: expected a natural number")
    return tags.astype(np.int64)


def _expect(source: ByteCursor, end: str) -> None:
    if source.next_line() != end:
        raise source.error(f"a section ends without {end} before {source.location}")
