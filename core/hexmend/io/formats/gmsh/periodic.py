"""Periodic surfaces of a Gmsh file: the nodes of each and of its master become two node sets, a periodic pair."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.io.base.cursor import ByteCursor
from hexmend.io.base.numbering import find_ids
from hexmend.io.formats.gmsh.sections import PeriodicLink, Sections
from hexmend.io.formats.gmsh.version_4 import SectionNumbers
from hexmend.mesh.mesh import Mesh


def read_version_4(source: ByteCursor, order: str, sections: Sections) -> None:
    """Read $Periodic of version 4.1: entities with their masters, transformations, and pairs of node tags."""
    numbers = SectionNumbers(source, order, "Periodic", np.float64)
    for _ in range(numbers.integers(1)[0]):
        entity = numbers.integers(3, "i4")
        numbers.take(numbers.integers(1)[0], "f8")  # the transformation, which the nodes tell too
        rows = numbers.take(2 * numbers.integers(1)[0], "u8").reshape(-1, 2)
        sections.periodic.append(PeriodicLink(*entity, rows.astype(np.int64)))
    numbers.close()


def read_version_2(source: ByteCursor, order: str, sections: Sections) -> None:
    """Read $Periodic of version 2, which is text in binary files too; see `read_version_4`."""
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


def with_periodic_surfaces(path: Path, mesh: Mesh, sections: Sections) -> Mesh:
    """Add the nodes of periodic surfaces as node sets such as "surface 3", and their names as periodic pairs.

    Links of points and curves, and surfaces whose nodes no hex uses, are left out: those of surfaces have them all.
    """
    sets, pairs = dict(mesh.node_sets), []
    for link in sections.periodic:
        nodes = find_ids(path, sections.tags, link.nodes, "node") if link.dimension == 2 else np.empty((0, 2), int)
        nodes = nodes[mesh.topology.boundary[nodes].all(axis=1)]
        if not len(nodes):
            continue
        pair = tuple(f"surface {tag}" for tag in (link.master, link.entity))
        for name, members in zip(pair, nodes.T[::-1], strict=True):
            sets[name] = np.union1d(sets.get(name, []), members).astype(np.int64)
        pairs.append(pair)
    return mesh.replace(node_sets=sets, periodic_pairs=(*mesh.periodic_pairs, *pairs)) if pairs else mesh


def _integers(source: ByteCursor, line: str, count: int) -> list[int]:
    """Parse a line of `count` whole numbers."""
    words = line.split()
    if len(words) != count or not all(word.lstrip("-").isdigit() and len(word) < 19 for word in words):
        raise source.error(f"$Periodic has the line {line[:40]!r} before {source.location}: expected {count} numbers")
    return [int(word) for word in words]
