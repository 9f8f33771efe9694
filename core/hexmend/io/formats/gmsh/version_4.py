"""Sections of Gmsh's format of version 4.1, in decimals and binary."""

from __future__ import annotations

import numpy as np

from hexmend.io.base.cursor import ByteCursor
from hexmend.io.formats.gmsh.content import Elements, Read, width_of
from hexmend.io.formats.gmsh.version_2 import whole_tags


class _Numbers:
    """The numbers of a section one after the other, whether in decimals or binary.

    Parameters
    ----------
    source : ByteCursor
    order : str
        The order of bytes; "" for decimals, of which all up to the section's end are taken at once.
    name : str
    dtype : dtype
        Of decimals.
    """

    def __init__(self, source: ByteCursor, order: str, name: str, dtype: type):
        self.source, self.order, self.name, self.at = source, order, name, 0
        self.values = None if order else source.read_numbers_until(f"${name}", f"$End{name}".encode(), dtype)

    def take(self, count: int, code: str) -> np.ndarray:
        """Numbers: of the type i4, u8 or f8 in binary."""
        if count < 0:
            raise self.source.error(f"${self.name} announces {count} numbers")
        if self.values is None:
            return self.source.read_binary(f"${self.name}", count, 1, f"{self.order}{code}")[:, 0]
        if count > self.values.size - self.at:
            raise self.source.error(f"${self.name} ends early: {count} numbers more were announced")
        self.at += count
        return self.values[self.at - count : self.at]

    def naturals(self, count: int, code: str = "u8") -> list[int]:
        """A few whole numbers, of the type i4 (which may be negative) or u8."""
        return [int(value) if np.isfinite(value) else -1 for value in self.take(count, code)]

    def close(self) -> None:
        """Raise unless the section ends here."""
        if self.values is not None:
            if self.at != self.values.size:
                raise self.source.error(f"${self.name} holds {self.values.size - self.at} numbers too many")
        elif self.source.next_line() != f"$End{self.name}":
            raise self.source.error(f"${self.name} ends without $End{self.name} before {self.source.location}")


def read_entities(source: ByteCursor, order: str, result: Read) -> None:
    """$Entities: points, curves, surfaces and volumes with their physical groups."""
    numbers = _Numbers(source, order, "Entities", np.float64)
    for dimension, count in enumerate(numbers.naturals(4)):
        for _ in range(count):
            (tag,) = numbers.naturals(1, "i4")
            result.entities[dimension, tag] = _groups(numbers, dimension)
    numbers.close()


def read_partitioned(source: ByteCursor, order: str, result: Read) -> None:
    """$PartitionedEntities: the parts of entities that processors have, with their physical groups or their parent's.

    Before them stand the number of partitions, and entities of ghost elements, which are in no other section.
    """
    numbers = _Numbers(source, order, "PartitionedEntities", np.float64)
    ghosts = numbers.naturals(2)[1]
    numbers.take(2 * ghosts, "i4")
    for dimension, count in enumerate(numbers.naturals(4)):
        for _ in range(count):
            tag, *parent = numbers.naturals(3, "i4")
            partitions = numbers.naturals(numbers.naturals(1)[0], "i4")
            groups = _groups(numbers, dimension)
            if not groups and parent[0] == dimension:
                groups = result.entities.get(tuple(parent), [])
            result.entities[dimension, tag] = groups
            result.partitions[dimension, tag] = partitions[0] if partitions else 0
    numbers.close()


def _groups(numbers: _Numbers, dimension: int) -> list[int]:
    """The physical groups of an entity, which stand between its place and what bounds it."""
    numbers.take(6 if dimension else 3, "f8")
    groups = numbers.naturals(numbers.naturals(1)[0], "i4")
    if dimension:
        numbers.take(numbers.naturals(1)[0], "i4")
    return groups


def read_nodes(source: ByteCursor, order: str, result: Read) -> None:
    """$Nodes: for each entity its nodes' tags, then their coordinates."""
    numbers = _Numbers(source, order, "Nodes", np.float64)
    blocks, count = numbers.naturals(4)[:2]
    tags, points = [np.zeros(0, np.int64)], [np.zeros((0, 3))]
    for _ in range(blocks):
        dimension, _, parametric = numbers.naturals(3, "i4")
        (many,) = numbers.naturals(1)
        found = numbers.take(many, "u8")
        tags.append(whole_tags(source, found.astype(np.float64)))
        width = 3 + (dimension if parametric else 0)
        points.append(numbers.take(many * width, "f8").reshape(many, width)[:, :3])
    numbers.close()
    result.tags, result.points = np.concatenate(tags), np.concatenate(points).astype(np.float64)
    if len(result.tags) != count:
        raise source.error(f"$Nodes holds {len(result.tags)} nodes: expected {count}")


def read_elements(source: ByteCursor, order: str, result: Read) -> None:
    """$Elements: for each entity and type the elements' tags and nodes."""
    numbers = _Numbers(source, order, "Elements", np.int64)
    blocks, count = numbers.naturals(4)[:2]
    result.elements, seen = [], 0
    for _ in range(blocks):
        dimension, entity, kind = numbers.naturals(3, "i4")
        (many,) = numbers.naturals(1)
        width = 1 + width_of(source.path, kind)
        rows = numbers.take(many * width, "u8").reshape(many, width).astype(np.int64)
        groups = result.entities.get((dimension, entity), ())
        number = result.partitions.get((dimension, entity))
        partition = None if number is None else np.full(many, number)
        result.elements.append(Elements(kind, rows[:, 0], rows[:, 1:], groups, partition))
        seen += many
    numbers.close()
    if seen != count:
        raise source.error(f"$Elements holds {seen} elements: expected {count}")
