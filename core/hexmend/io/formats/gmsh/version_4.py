"""Sections of Gmsh's format of versions 4.1 and 4.0, text and binary."""

from __future__ import annotations

import numpy as np

from hexmend.io.base.cursor import ByteCursor
from hexmend.io.formats.gmsh.sections import ElementBlock, PeriodicLink, Sections, joined, nodes_per_element, split_tags
from hexmend.io.formats.gmsh.version_2 import node_tags
from hexmend.io.storage.binary_rows import native


class SectionNumbers:
    """The numbers of a section, one after the other; of a text all are parsed at once, as numbers of `dtype`.

    `order` is the byte order, "<" or ">", and "" for text.
    """

    def __init__(self, source: ByteCursor, order: str, name: str, dtype: type):
        self.source, self.order, self.name, self.at = source, order, name, 0
        self.values = None if order else source.read_numbers_until(f"${name}", f"$End{name}".encode(), dtype)

    def take(self, count: int, code: str) -> np.ndarray:
        """Take the next numbers, (count,); `code` is their binary type: i4, u8 or f8."""
        if count < 0:
            raise self.source.error(f"${self.name} declares {count} numbers")
        if self.values is None:
            return self.source.read_binary(f"${self.name}", count, 1, f"{self.order}{code}")[:, 0]
        if count > self.values.size - self.at:
            raise self.source.error(f"${self.name} ends early: {count} numbers more were declared")
        self.at += count
        return self.values[self.at - count : self.at]

    def take_node_tags(self, count: int) -> np.ndarray:
        """Take tags of nodes, (count,) int64."""
        if self.values is not None or count < 0:
            return node_tags(self.source, self.take(count, "u8"))
        blocks = self.source.binary_blocks(f"${self.name}", count, 1, f"{self.order}u8")
        tags = np.empty(count, np.int64)
        for part, rows in blocks:
            tags[part] = node_tags(self.source, rows[:, 0].astype(np.float64))
        return tags

    def take_elements(self, count: int, width: int, code: str) -> tuple[np.ndarray, np.ndarray]:
        """Take the tags, (count,) int64, and the nodes, (count, width) int, of elements; `code` is as of `take`."""
        if self.values is not None:
            rows = self.take(count * (1 + width), code).reshape(count, 1 + width).astype(np.int64, copy=False)
            return rows[:, 0], rows[:, 1:]
        blocks = self.source.binary_blocks(f"${self.name}", count, 1 + width, f"{self.order}{code}")
        return split_tags(blocks, count, width)

    def integers(self, count: int, code: str = "u8") -> list[int]:
        """Take a few whole numbers."""
        return [int(value) if np.isfinite(value) else -1 for value in self.take(count, code)]

    def close(self) -> None:
        """Raise `FileError` unless the section ends here."""
        if self.values is not None:
            if self.at != self.values.size:
                raise self.source.error(f"${self.name} holds {self.values.size - self.at} numbers too many")
        elif self.source.next_line() != f"$End{self.name}":
            raise self.source.error(f"${self.name} ends without $End{self.name} before {self.source.location}")


def read_entities(source: ByteCursor, order: str, sections: Sections, is_4_0: bool = False) -> None:
    """Read $Entities: points, curves, surfaces and volumes with their physical groups.

    Points of version 4.0 have a box like all others.
    """
    numbers = SectionNumbers(source, order, "Entities", np.float64)
    for dimension, count in enumerate(numbers.integers(4)):
        for _ in range(count):
            (tag,) = numbers.integers(1, "i4")
            sections.entities[dimension, tag] = _groups(numbers, dimension, is_4_0)
    numbers.close()


def read_partitioned_entities(source: ByteCursor, order: str, sections: Sections) -> None:
    """Read $PartitionedEntities: the parts of entities in each partition, with their physical groups or their parent's.

    They follow the number of partitions and the entities of ghost elements, which no other section refers to.
    """
    numbers = SectionNumbers(source, order, "PartitionedEntities", np.float64)
    ghosts = numbers.integers(2)[1]
    numbers.take(2 * ghosts, "i4")
    for dimension, count in enumerate(numbers.integers(4)):
        for _ in range(count):
            tag, *parent = numbers.integers(3, "i4")
            partitions = numbers.integers(numbers.integers(1)[0], "i4")
            groups = _groups(numbers, dimension)
            if not groups and parent[0] == dimension:
                groups = sections.entities.get(tuple(parent), [])
            sections.entities[dimension, tag] = groups
            sections.partitions[dimension, tag] = partitions[0] if partitions else 0
    numbers.close()


def _groups(numbers: SectionNumbers, dimension: int, is_4_0: bool = False) -> list[int]:
    """Take the rest of an entity after its tag: its box, its physical groups, which are returned, and its boundary."""
    numbers.take(6 if dimension or is_4_0 else 3, "f8")
    groups = numbers.integers(numbers.integers(1)[0], "i4")
    if dimension:
        numbers.take(numbers.integers(1)[0], "i4")
    return groups


def read_nodes(source: ByteCursor, order: str, sections: Sections, is_4_0: bool = False) -> None:
    """Read $Nodes: the tags of each entity's nodes, then their coordinates; in version 4.0 node by node."""
    numbers = SectionNumbers(source, order, "Nodes", np.float64)
    blocks, count = numbers.integers(2 if is_4_0 else 4)[:2]
    tags, points = [], []
    for _ in range(blocks):
        dimension, entity, parametric = numbers.integers(3, "i4")
        (n_nodes,) = numbers.integers(1)
        width = 3 + ((entity if is_4_0 else dimension) if parametric else 0)
        if is_4_0 and order:
            row = np.dtype([("tag", f"{order}i4"), ("x", f"{order}f8", width)])
            sections.places.append((source.pos + 4, n_nodes, row.itemsize))
            rows = source.read_binary("$Nodes", n_nodes, 1, row)[:, 0]
            tags.append(rows["tag"].astype(np.int64))
            points.append(native(rows["x"])[:, :3])
            continue
        if is_4_0:
            sections.places.append((numbers.at + 1, n_nodes, 1 + width))
            rows = numbers.take(n_nodes * (1 + width), "f8").reshape(n_nodes, 1 + width)
            tags.append(node_tags(source, rows[:, 0]))
            points.append(rows[:, 1:4])
            continue
        tags.append(numbers.take_node_tags(n_nodes))
        place, word = (source.pos, 8) if order else (numbers.at, 1)
        sections.places.append((place, n_nodes, word * width))
        points.append(native(numbers.take(n_nodes * width, "f8")).reshape(n_nodes, width)[:, :3])
    numbers.close()
    sections.tags, sections.points = joined(tags, np.int64), np.ascontiguousarray(joined(points, np.float64, 3))
    if len(sections.tags) != count:
        raise source.error(f"$Nodes holds {len(sections.tags)} nodes: expected {count}")


def read_elements(source: ByteCursor, order: str, sections: Sections, is_4_0: bool = False) -> None:
    """Read $Elements: the tags and nodes of the elements of each entity and type."""
    numbers = SectionNumbers(source, order, "Elements", np.int64)
    blocks, count = numbers.integers(2 if is_4_0 else 4)[:2]
    sections.elements, seen = [], 0
    for _ in range(blocks):
        dimension, entity, type = numbers.integers(3, "i4")
        if is_4_0:
            dimension, entity = entity, dimension
        (n_elements,) = numbers.integers(1)
        width = nodes_per_element(source.path, type)
        tags, nodes = numbers.take_elements(n_elements, width, "i4" if is_4_0 else "u8")
        groups = sections.entities.get((dimension, entity), ())
        number = sections.partitions.get((dimension, entity))
        partition = None if number is None else np.full(n_elements, number)
        sections.elements.append(ElementBlock(type, tags, nodes, groups, partition))
        seen += n_elements
    numbers.close()
    if seen != count:
        raise source.error(f"$Elements holds {seen} elements: expected {count}")


def read_periodic(source: ByteCursor, order: str, sections: Sections) -> None:
    """Read $Periodic of version 4.1: entities with their masters, transformations, and pairs of node tags."""
    numbers = SectionNumbers(source, order, "Periodic", np.float64)
    for _ in range(numbers.integers(1)[0]):
        entity = numbers.integers(3, "i4")
        numbers.take(numbers.integers(1)[0], "f8")  # the transformation, which the nodes tell too
        rows = numbers.take(2 * numbers.integers(1)[0], "u8").reshape(-1, 2)
        sections.periodic.append(PeriodicLink(*entity, rows.astype(np.int64)))
    numbers.close()
