"""Sections of Gmsh's format of version 2, text and binary, and of version 1, which is text only."""

from __future__ import annotations

import numpy as np

from hexmend.io.base.cursor import ByteCursor
from hexmend.io.formats.gmsh.sections import ElementBlock, PeriodicLink, Sections, nodes_per_element
from hexmend.io.storage.binary_rows import native


def read_nodes(source: ByteCursor, order: str, sections: Sections) -> None:
    """Read $Nodes: a count, then the tag and the coordinates of each node."""
    if order:
        count = source.parse_count(source.next_line(), "the number of nodes")
        row = np.dtype([("tag", f"{order}i4"), ("x", f"{order}f8", 3)])
        sections.places = [(source.pos + row.fields["x"][1], count, row.itemsize)]
        blocks = source.binary_blocks("$Nodes", count, 1, row)
        sections.tags, sections.points = np.empty(count, np.int64), np.empty((count, 3))
        for part, rows in blocks:
            sections.tags[part], sections.points[part] = rows["tag"][:, 0], rows["x"][:, 0]
        _expect(source, "$EndNodes")
        return
    read_text_nodes(source, "$Nodes", b"$EndNodes", sections)


def read_text_nodes(source: ByteCursor, name: str, end: bytes, sections: Sections) -> None:
    """Read nodes as text up to the keyword `end`: a count, then the tag and the coordinates of each."""
    values = source.read_numbers_until(name, end, np.float64)
    count = int(values[0]) if values.size and np.isfinite(values[0]) else 0
    if values.size != 1 + 4 * count:
        raise source.error(f"{name} holds {values.size} numbers: expected {1 + 4 * count} for {count} nodes")
    rows, sections.places = values[1:].reshape(count, 4), [(2, count, 4)]
    sections.tags, sections.points = node_tags(source, rows[:, 0]), np.ascontiguousarray(rows[:, 1:])


def read_parametric_nodes(source: ByteCursor, order: str, sections: Sections) -> None:
    """Read $ParametricNodes: a count, then tag, coordinates, dimension, entity and its parameters of each node."""
    if order:
        raise source.error("has binary $ParametricNodes", "Save it as 4.1 with Gmsh, or as text.")
    values = source.read_numbers_until("$ParametricNodes", b"$EndParametricNodes", np.float64)
    count, at, starts = int(values[0]) if values.size and np.isfinite(values[0]) else 0, 1, []
    while at + 6 <= values.size:
        starts.append(at)
        at += 6 + {1: 1, 2: 2}.get(int(values[at + 4]), 0)
    if len(starts) != count or at != values.size:
        raise source.error(f"$ParametricNodes holds {len(starts)} whole nodes of {count}")
    begins = np.array(starts, np.int64)
    sections.places = [(one + 1, 1, 0) for one in starts]
    sections.tags = node_tags(source, values[begins])
    sections.points = values[begins[:, None] + np.arange(1, 4)]


def read_elements(source: ByteCursor, order: str, sections: Sections) -> None:
    """Read $Elements: a count, then tag, type, number of tags, tags and nodes of each element.

    In binary files the type, the number of elements and the number of tags come before the elements that share them.
    """
    if order:
        sections.elements = _binary_elements(source, order)
        return
    sections.elements = _text_elements(source, "$Elements", b"$EndElements", 3)


def read_elm(source: ByteCursor, order: str, sections: Sections) -> None:
    """Read $ELM: a count, then tag, type, physical group, entity, number of nodes and nodes of each element."""
    sections.elements = _text_elements(source, "$ELM", b"$ENDELM", 5)


def _text_elements(source: ByteCursor, name: str, end: bytes, n_head: int) -> list[ElementBlock]:
    """Elements as text up to the keyword `end`, of which each begins with so many numbers.

    They are tag, type and number of tags, or in version 1 tag, type, group, entity and number of nodes.
    """
    values, has_tags = source.read_numbers_until(name, end, np.int64), n_head == 3
    count = int(values[0]) if values.size else 0
    starts, at, view, widths = [], 1, memoryview(values), {}
    while at + n_head - 1 < values.size:
        type, number = view[at + 1], view[at + n_head - 1]
        if type not in widths:
            widths[type] = nodes_per_element(source.path, type)
        if not has_tags and number != widths[type]:
            problem = f"{name}: element {view[at]} of type {type} has {number} nodes: expected {widths[type]}"
            raise source.error(problem)
        if number < 0:
            break
        starts.append(at)
        at += n_head + widths[type] + (number if has_tags else 0)
    if len(starts) != count or at != values.size:
        raise source.error(f"{name} holds {len(starts)} whole elements of {count}")
    begins, blocks = np.array(starts, np.int64), []
    types, n_tags = values[begins + 1], values[begins + 2] * has_tags
    for type, number in np.unique(np.column_stack([types, n_tags]), axis=0).tolist():
        rows, first = begins[(types == type) & (n_tags == number)], n_head + number
        nodes = values[rows[:, None] + np.arange(first, first + widths[type])]
        tags = values[rows[:, None] + (np.arange(3, 3 + number) if has_tags else [2])]
        blocks.append(ElementBlock(type, values[rows], nodes, *_group_and_partition(tags)))
    return blocks


def _binary_elements(source: ByteCursor, order: str) -> list[ElementBlock]:
    count = source.parse_count(source.next_line(), "the number of elements")
    blocks, seen = [], 0
    while seen < count:
        type, follow, n_tags = source.read_binary("$Elements", 1, 3, f"{order}i4")[0].tolist()
        if follow < 1 or n_tags < 0 or n_tags > len(source.data):
            raise source.error(f"$Elements declares {follow} elements with {n_tags} groups at {source.location}")
        rows = source.read_binary("$Elements", follow, 1 + n_tags + nodes_per_element(source.path, type), f"{order}i4")
        rows = native(rows)
        tags, nodes = rows[:, 1 : 1 + n_tags].astype(np.int64), rows[:, 1 + n_tags :]
        blocks.append(ElementBlock(type, rows[:, 0].astype(np.int64), nodes, *_group_and_partition(tags)))
        seen += follow
    if seen != count:
        raise source.error(f"$Elements holds {seen} elements: expected {count}")
    _expect(source, "$EndElements")
    return blocks


def _group_and_partition(tags: np.ndarray) -> tuple[np.ndarray, np.ndarray | None]:
    """Physical group and first partition of elements, (k,) int64 each, 0 for none; of their tags, (k, n_tags).

    The tags are the group, the entity, the number of partitions, and the partitions.
    """
    group = tags[:, 0] if tags.shape[1] else np.zeros(len(tags), np.int64)
    return group, np.where(tags[:, 2] > 0, tags[:, 3], 0) if tags.shape[1] > 3 else None


def node_tags(source: ByteCursor, values: np.ndarray) -> np.ndarray:
    """Node tags that were parsed as real numbers, (n,) int64; `FileError` unless they are natural numbers."""
    tags = np.where(np.isfinite(values) & (np.abs(values) < 2.0**53), values, -0.5)
    if (tags != np.floor(tags)).any() or (tags < 1).any():
        wrong = values[(tags != np.floor(tags)) | (tags < 1)][0]
        raise source.error(f"$Nodes holds the tag {wrong:g}: expected a natural number")
    return tags.astype(np.int64)


def _expect(source: ByteCursor, end: str) -> None:
    """Raise unless the next line is the keyword `end`."""
    if source.next_line() != end:
        raise source.error(f"a section ends without {end} before {source.location}")


def read_periodic(source: ByteCursor, order: str, sections: Sections) -> None:
    """Read $Periodic of version 2, which is text in binary files too; see version 4."""
    for _ in range(source.parse_count(source.next_line(), "the number of periodic entities")):
        entity = _integers(source, source.next_line(), 3)
        line = source.next_line()
        if line.startswith("Affine"):
            line = source.next_line()
        count = source.parse_count(line, "the number of periodic nodes")
        if count > len(source.data):
            raise source.error(f"$Periodic declares {count} nodes before {source.location}")
        rows = [_integers(source, source.next_line(), 2) for _ in range(count)]
        sections.periodic.append(PeriodicLink(*entity, np.array(rows, np.int64).reshape(-1, 2)))
    if source.next_line() != "$EndPeriodic":
        raise source.error(f"$Periodic ends without $EndPeriodic before {source.location}")


def _integers(source: ByteCursor, line: str, count: int) -> list[int]:
    """Parse a line of `count` whole numbers."""
    words = line.split()
    if len(words) != count or not all(word.lstrip("-").isdigit() and len(word) < 19 for word in words):
        raise source.error(f"$Periodic has the line {line[:40]!r} before {source.location}: expected {count} numbers")
    return [int(word) for word in words]


def read_nod(source: ByteCursor, order: str, sections: Sections) -> None:
    """Read $NOD: a count, then the tag and the coordinates of each node."""
    read_text_nodes(source, "$NOD", b"$ENDNOD", sections)
