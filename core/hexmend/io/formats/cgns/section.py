"""A section of elements of an unstructured zone of a CGNS file."""

from __future__ import annotations

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.polyhedra import RaggedArray
from hexmend.io.formats.cgns.elements import MIXED, ORDER, POLYGONS, POLYHEDRA, TYPES
from hexmend.io.formats.cgns.tree import CGNSNode
from hexmend.io.formats.cgns.zone import DAMAGED


class CGNSSection:
    """A section of elements, whose numbers follow one another."""

    def __init__(self, node: CGNSNode):
        self.node, self.name = node, node.name
        kind, span = node.numbers().ravel(), node.named("ElementRange")
        span = span.numbers().ravel() if span is not None else np.empty(0, np.int64)
        if kind.size < 1 or span.size != 2 or span[1] < span[0]:
            raise FileError(node.path, f"section {node.name!r} has the kind {kind} and the range {span}", DAMAGED)
        self.type, self.first, self.last = int(kind[0]), int(span[0]), int(span[1])
        nodes = node.named("ElementConnectivity")
        self.nodes = nodes.numbers().ravel() if nodes is not None else np.empty(0, np.int64)
        self.parents = self._parents()

    def __len__(self) -> int:
        return self.last - self.first + 1

    def rows(self) -> RaggedArray:
        """What the elements of a section of polygons or polyhedra name, as the file has it.

        Raises
        ------
        FileError
            Where their lengths are not those of the section.
        """
        offsets, values = self.node.named("ElementStartOffset"), self.nodes
        if offsets is not None:
            start = offsets.numbers().ravel()
        else:  # of versions before 4: each behind its length
            begins, at, flat = [], 0, values.tolist()
            while at < len(flat) and flat[at] >= 0:
                begins.append(at)
                at += 1 + flat[at]
            lengths = values[begins] if at == len(flat) else np.empty(0, np.int64)
            start, values = np.concatenate([[0], np.cumsum(lengths)]), np.delete(values, begins)
        if len(start) != len(self) + 1 or start[0] != 0 or (np.diff(start) < 0).any() or start[-1] != values.size:
            raise FileError(self.node.path, f"section {self.name!r} does not name {len(self)} rows", DAMAGED)
        return RaggedArray(start, values)

    def parts(self, notes: list[str]) -> list[tuple[str, np.ndarray, np.ndarray]]:
        """Kind, nodes from 0 in VTK's order, and numbers in the zone of the elements of each kind."""
        if self.parents is not None and not self.nodes.any():
            return []
        if self.type == MIXED:
            types, starts = self._mixed()
        elif self.type in TYPES:
            width = TYPES[self.type][1]
            if self.nodes.size != len(self) * width:
                raise FileError(
                    self.node.path,
                    f"section {self.name!r} has {len(self)} elements of {width} nodes, and {self.nodes.size} nodes",
                    DAMAGED,
                )
            types, starts = np.full(len(self), self.type), width * np.arange(len(self))
        elif self.type in (POLYGONS, POLYHEDRA):  # which belong together: see hexmend.io.formats.cgns.polyhedra
            return []
        else:
            notes.append(f"{len(self):,} elements of type {self.type} of section {self.name!r} are left out.")
            return []
        answer = []
        for number in dict.fromkeys(types.tolist()):
            kind, width = TYPES[number]
            chosen = np.flatnonzero(types == number)
            rows = self.nodes[starts[chosen][:, None] + np.arange(width)] - 1
            answer.append((kind, rows[:, ORDER[kind]] if kind in ORDER else rows, self.first + chosen))
        return answer

    def _mixed(self) -> tuple[np.ndarray, np.ndarray]:
        """Types of the elements, and where the nodes of each begin."""
        offsets, nodes = self.node.named("ElementStartOffset"), self.nodes
        if offsets is not None:
            starts = offsets.numbers().ravel()[:-1]
            if len(starts) != len(self) or (len(starts) and (starts.min() < 0 or starts.max() >= nodes.size)):
                raise FileError(self.node.path, f"section {self.name!r} has wrong ElementStartOffset", DAMAGED)
        else:  # of versions before 4: one after the other
            starts, place, flat = [], 0, nodes.tolist()
            while len(starts) < len(self) and place < len(flat) and flat[place] in TYPES:
                starts.append(place)
                place += 1 + TYPES[flat[place]][1]
            starts = np.array(starts, np.int64)
        types = nodes[starts]
        widths = np.array([TYPES.get(number, ("", nodes.size))[1] for number in types.tolist()], np.int64)
        if len(starts) != len(self) or (len(starts) and (starts + 1 + widths > nodes.size).any()):
            raise FileError(
                self.node.path, f"section {self.name!r} names elements of types that are not known", DAMAGED
            )
        return types, starts + 1

    def _parents(self) -> np.ndarray | None:
        """The elements that each face belongs to, and which of their faces it is: (k, 2, 2), 0 where there is none."""
        found = [self.node.named(name) for name in ("ParentElements", "ParentElementsPosition")]
        if None in found:
            found = [self.node.named("ParentData")]  # of versions before 3, both in one
        if None in found:
            return None
        rows = np.concatenate([one.numbers().ravel() for one in found])
        return rows.reshape(2, 2, -1).transpose(2, 1, 0) if rows.size == 4 * len(self) else None
