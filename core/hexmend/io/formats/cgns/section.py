"""Elements_t section of an unstructured zone of a CGNS file.

Element types of CGNS: their kinds, and the order of their nodes and faces.

*The CGNS Standard Interface Data Structures*, section 3.3. A hex counts the nodes of its vertical edges before those of
its upper ones, and its faces are z-, y-, x+, y+, x-, z+::

    CGNS, from 1      9-12      13-16       17-20     21 22 23 24 25 26    27
    edges, faces      lower     vertical    upper     z- y- x+ y+ x- z+    inside
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import VERTICAL_EDGES_FIRST, to_vtk_order
from hexmend.io.base.polyhedra import RaggedArray
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.formats.cgns.zone import CGNSNode

#: Kind and number of nodes of each ElementType_t that is read. A kind may have fewer nodes than its type: those of the
#: faces and the inside of pyramids and wedges are left out.
TYPES = {
    2: ("vertex", 1), 3: ("line", 2), 4: ("line3", 3), 5: ("triangle", 3), 6: ("triangle6", 6), 7: ("quad", 4),
    8: ("quad8", 8), 9: ("quad9", 9), 10: ("tetra", 4), 11: ("tetra10", 10), 12: ("pyramid", 5), 13: ("pyramid13", 14),
    14: ("wedge", 6), 15: ("wedge15", 15), 16: ("wedge15", 18), 17: ("hex", 8), 18: ("hex20", 20), 19: ("hex27", 27),
    21: ("pyramid13", 13),
}  # fmt: skip
#: Types of sections whose elements differ in their number of nodes or faces.
MIXED, NGON, NFACE = 20, 22, 23

#: VTK's node order: vtk = cgns[ORDER[kind]]; kinds without an entry have one order in both.
ORDER = VERTICAL_EDGES_FIRST | {
    "hex27": [*VERTICAL_EDGES_FIRST["hex20"], 24, 22, 21, 23, 20, 25, 26], "pyramid13": [*range(13)],
}  # fmt: skip

#: Face, of `hexmend.mesh.hexahedron.FACES`, of a hex's faces 1 to 6.
FACE_OF_NUMBER = np.array([4, 2, 1, 3, 0, 5])


class CellGroup(NamedTuple):
    """Elements of one kind of a section.

    Parameters
    ----------
    kind : str
    nodes : (k, width) int64
        From 0, in VTK's order.
    numbers : (k,) int64
        Element numbers in the zone.
    section : str
        Name of the section.
    """

    kind: str
    nodes: np.ndarray
    numbers: np.ndarray
    section: str


class CGNSSection:
    """Section of elements with consecutive numbers.

    Parameters
    ----------
    node : CGNSNode

    Attributes
    ----------
    type : int
        ElementType_t.
    first, last : int
        Element numbers.
    connectivity : (m,) int64
    parents : (k, 2, 2) int64 or None
        For each face its two parent elements, each with the number of the element's face; 0 for none.
    """

    def __init__(self, node: CGNSNode):
        self.node, self.name = node, node.name
        none = np.empty(0, np.int64)
        type, span = node.integers().ravel(), node.integers_of("ElementRange")
        span = none if span is None else span
        if type.size < 1 or span.size != 2 or span[1] < span[0]:
            raise self.error(f"has the kind {type} and the range {span}")
        self.type, self.first, self.last = int(type[0]), int(span[0]), int(span[1])
        connectivity = node.integers_of("ElementConnectivity")
        self.connectivity = none if connectivity is None else connectivity
        self.parents = self._read_parents()

    def __len__(self) -> int:
        return self.last - self.first + 1

    def error(self, problem: str) -> FileError:
        """Make the error to raise."""
        return FileError(self.node.path, f"section {self.name!r} {problem}", DAMAGED)

    def rows(self) -> RaggedArray:
        """Entries of each element of an NGON_n or NFACE_n section, numbered as in the file.

        Raises
        ------
        FileError
            Unless there is a row for each element.
        """
        start, values = self.node.integers_of("ElementStartOffset"), self.connectivity
        if start is None:  # before version 4 each row follows its length
            rows, whole = RaggedArray.of_counted_rows(values)
            start, values = (rows.start if whole else rows.start[:1]), rows.values
        if len(start) != len(self) + 1 or start[0] != 0 or (np.diff(start) < 0).any() or start[-1] != values.size:
            raise self.error(f"does not have {len(self)} rows")
        return RaggedArray(start, values)

    def cell_groups(self, notes: list[str]) -> list[CellGroup]:
        """Elements by kind; none for faces known by their parents alone, and for polygons and polyhedra.

        Parameters
        ----------
        notes : list of str
            A note on elements that are left out is appended.

        Raises
        ------
        FileError
            Where the connectivity does not fit the elements.
        """
        if self.type in (NGON, NFACE) or (self.parents is not None and not self.connectivity.any()):
            return []
        if self.type == MIXED:
            types, starts = self._mixed_layout()
        elif self.type in TYPES:
            width = TYPES[self.type][1]
            if self.connectivity.size != len(self) * width:
                raise self.error(f"has {len(self)} elements of {width} nodes, and {self.connectivity.size} nodes")
            types, starts = np.full(len(self), self.type), width * np.arange(len(self))
        else:
            notes.append(f"{len(self):,} elements of type {self.type} of section {self.name!r} are left out.")
            return []
        groups = []
        for type in dict.fromkeys(types.tolist()):
            kind, width = TYPES[type]
            chosen = np.flatnonzero(types == type)
            nodes = self.connectivity[starts[chosen][:, None] + np.arange(width)] - 1
            groups.append(CellGroup(kind, to_vtk_order(nodes, kind, ORDER), self.first + chosen, self.name))
        return groups

    def _mixed_layout(self) -> tuple[np.ndarray, np.ndarray]:
        """Type of each element of a MIXED section, and the index of its first node, (k,) int64 each."""
        offsets, nodes = self.node.integers_of("ElementStartOffset"), self.connectivity
        if offsets is not None:
            starts = offsets[:-1]
            if len(starts) != len(self) or (len(starts) and (starts.min() < 0 or starts.max() >= nodes.size)):
                raise self.error("has a wrong ElementStartOffset")
        else:  # before version 4 elements follow one another
            starts, at, flat = [], 0, nodes.tolist()
            while len(starts) < len(self) and at < len(flat) and flat[at] in TYPES:
                starts.append(at)
                at += 1 + TYPES[flat[at]][1]
            starts = np.array(starts, np.int64)
        types = nodes[starts]
        widths = np.array([TYPES.get(type, ("", nodes.size))[1] for type in types.tolist()], np.int64)
        if len(starts) != len(self) or (len(starts) and (starts + 1 + widths > nodes.size).any()):
            raise self.error("has elements of unknown types")
        return types, starts + 1

    def _read_parents(self) -> np.ndarray | None:
        found = [self.node.integers_of(name) for name in ("ParentElements", "ParentElementsPosition")]
        if any(numbers is None for numbers in found):
            found = [self.node.integers_of("ParentData")]  # before version 3 one array holds both
        if found[0] is None:
            return None
        rows = np.concatenate(found)
        return rows.reshape(2, 2, -1).transpose(2, 1, 0) if rows.size == 4 * len(self) else None
