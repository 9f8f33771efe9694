"""Materials: the partition of the hexes of a mesh by the sets or data of its file, and the interfaces between them."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import count
from typing import NamedTuple

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.mesh.cells import Cells
from hexmend.mesh.solid_cells import face_nodes, solid_blocks
from hexmend.mesh.topology import Topology

#: Name of field data that list hex sets that are only blocks of a structured grid, and no materials.
STRUCTURED_BLOCKS = "structured blocks"
#: Name of field data that list cards of a file by which bodies touch or are joined: nodes at one position are meant to
#: be two.
CONTACT_CARDS = "contact cards"

#: Names of hex data that number materials, the most specific first; compared without case, spaces and punctuation.
_DATA_NAMES = (
    *("materialids", "materialid", "material", "materials", "matids", "matid", "mat"),
    *("nastranpid", "propertyids", "propertyid", "pid", "gmshphysical", "physical", "meditref"),
    *("elementblockids", "elementblockid", "blockids", "blockid", "block", "objectid"),
    *("regionids", "regionid", "regions", "region", "subdomains", "subdomainid", "subdomain"),
    *("cellzone", "cellzones", "zoneids", "zoneid", "zone", "partids", "partid", "attributes", "attribute"),
    *("grainids", "grainid", "grains", "grain", "featureids", "phaseids", "phaseid", "celltags", "cellmarkers"),
)
#: Overlapping hex sets up to this number are searched for some that divide the mesh.
_MAX_SETS = 62
#: Steps after which that search is given up.
_MAX_SEARCH_STEPS = 10_000


@dataclass(frozen=True, eq=False)
class Materials:
    """Partition of the hexes of a mesh into two or more materials.

    Parameters
    ----------
    names : tuple of str
        Names of sets, or numbers as text.
    of_hex : (m,) int32
        Index of each hex's material in `names`.
    topology : Topology
        Topology of the mesh.
    """

    names: tuple[str, ...]
    of_hex: np.ndarray
    topology: Topology

    @cached_property
    def interface_nodes(self) -> np.ndarray:
        """True for nodes of hexes of two or more materials, (n,) bool."""
        hexes, marks = self.topology.elements, np.zeros(self.topology.n, dtype=bool)
        some = np.zeros(self.topology.n, dtype=np.int32)  # the material of one hex of each node
        some[hexes] = self.of_hex[:, None]
        marks[hexes[some[hexes] != self.of_hex[:, None]]] = True
        return as_immutable(marks)

    @cached_property
    def interface_sides(self) -> np.ndarray:
        """Faces between hexes of two materials, each once, (k, 4) int64.

        In each row a cell, its face in `hexmend.mesh.solid_cells.SolidKind.faces`, the cell across it, and that one's
        face; the first cell is of the material with the lower index, so that the faces of one interface have one
        orientation.
        """
        near = self.interface_nodes[self.topology.elements].sum(axis=1) >= 3
        hexes = np.flatnonzero(near)
        across = self.topology.face_neighbours[hexes]
        of_both = self.of_hex[hexes][:, None] < np.where(across < 0, -1, self.of_hex[across])
        row, face = np.nonzero(of_both)
        one, other = hexes[row], across[row, face].astype(np.int64)
        back = (self.topology.face_neighbours[other] == one[:, None]).argmax(axis=1)
        return as_immutable(np.stack([one, face, other, back], axis=1))

    @cached_property
    def interface_faces(self) -> np.ndarray:
        """Nodes of each face of `interface_sides`, counter-clockwise from the hex across it, (k, 4) int32."""
        hexes, sides = self.interface_sides[:, 0], self.interface_sides[:, 1]
        return as_immutable(face_nodes(self.topology.elements, hexes, sides))

    def __len__(self) -> int:
        return len(self.names)


class _Part(NamedTuple):
    """Cells of one block: their kind, data, sets and number."""

    kind: str
    data: Mapping[str, np.ndarray]
    sets: Mapping[str, np.ndarray]
    length: int


def find_materials(
    topology: Topology,
    hex_sets: Mapping[str, np.ndarray],
    hex_data: Mapping[str, np.ndarray],
    blocks: Collection[str] = (),
    cells: Sequence[Cells] = (),
) -> Materials | None:
    """Find the materials of a mesh: by data that number them, else by sets that divide the cells.

    A block of wedges, pyramids or tetrahedra without these data or sets is a material of its own, if there are two.

    Parameters
    ----------
    topology : Topology
    hex_sets : mapping of name to (k,) int array
        Sets of all hexes, and empty ones, are no materials; of overlapping sets those count that together hold every
        hex exactly once.
    hex_data : mapping of name to (m, ...) array
        Whole numbers under a usual name such as "MaterialIds", "medit:ref" or "region".
    blocks : collection of str
        Names of sets that are no materials.
    cells : sequence of Cells
        Blocks of other cells of the mesh.

    Returns
    -------
    Materials or None
        None for a mesh of one material.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> cube = make("cube", size=8)
    >>> found = find_materials(cube.topology, {"low": np.arange(4), "high": np.arange(4, 8)}, {})
    >>> found.names, int(found.interface_nodes.sum()), len(found.interface_faces)
    (('low', 'high'), 9, 4)
    """
    solids = [_Part(one.kind, one.data, one.sets, len(one.nodes)) for one in solid_blocks(cells)]
    hexes = len(topology.elements) - sum(part.length for part in solids)
    parts = [part for part in (_Part("hex", hex_data, hex_sets, hexes), *solids) if part.length]
    found = _by_data(parts) or _by_sets(parts, blocks)
    return None if found is None else Materials(found[0], as_immutable(found[1]), topology)


def is_name_of_materials(name: str) -> bool:
    """Return True if data of this name may number materials."""
    return _key(name) in _DATA_NAMES


def _key(name: str) -> str:
    return "".join(filter(str.isalnum, name.lower()))


def _by_data(parts: Sequence[_Part]) -> tuple[tuple[str, ...], np.ndarray] | None:
    """Materials by the first data with a usual name and two or more whole numbers, fewer than half the cells."""
    names = {_key(name): name for part in reversed(parts) for name in reversed(list(part.data))}
    for name in _DATA_NAMES:
        of_parts = [_numbers(part, names.get(name, "")) for part in parts]
        known = [values for values in of_parts if values is not None]
        if not known:
            continue
        values = np.concatenate(known)
        low, high = values.min(), values.max()
        if not low < high or not (np.isfinite(low) and np.isfinite(high)) or (values != np.floor(values)).any():
            continue
        numbers, of_cell = np.unique(values, return_inverse=True)
        if 2 * len(numbers) <= len(values):
            has_numbers = [values is not None for values in of_parts]
            return _with_own(tuple(str(int(number)) for number in numbers), of_cell.ravel(), parts, has_numbers)
    return None


def _numbers(part: _Part, name: str) -> np.ndarray | None:
    """Values of the data of this name, a number for each cell; None if the part has none."""
    values = np.asarray(part.data.get(name, ()))
    return values.ravel() if values.shape in ((part.length,), (part.length, 1)) and values.dtype.kind in "iuf" else None


def _by_sets(parts: Sequence[_Part], blocks: Collection[str]) -> tuple[tuple[str, ...], np.ndarray] | None:
    """Materials by sets that hold every cell exactly once, but those of blocks without a set."""
    has_sets = [any(name not in blocks and len(rows) for name, rows in part.sets.items()) for part in parts]
    sets: dict[str, np.ndarray] = {}
    m = 0
    for part in (part for part, has in zip(parts, has_sets, strict=True) if has):
        for name, rows in part.sets.items():
            sets[name] = np.concatenate([sets[name], np.asarray(rows) + m]) if name in sets else np.asarray(rows) + m
        m += part.length
    found = _dividing({name: rows for name, rows in sets.items() if name not in blocks and 0 < len(rows) < m}, m)
    return None if found is None else _with_own(*found, parts, has_sets)


def _with_own(
    names: tuple[str, ...], of_cell: np.ndarray, parts: Sequence[_Part], known: Sequence[bool]
) -> tuple[tuple[str, ...], np.ndarray]:
    """Return the names and the place (m,) of each cell's, with one more material for each part that is not known."""
    answer, rows, first = list(names), [], 0
    for part, is_known in zip(parts, known, strict=True):
        if is_known:
            rows.append(of_cell[first : first + part.length])
            first += part.length
        else:
            rows.append(np.full(part.length, len(answer)))
            titles = (part.kind if k == 1 else f"{part.kind} {k}" for k in count(1))
            answer.append(next(title for title in titles if title not in answer))
    return tuple(answer), np.concatenate(rows).astype(np.int32)


def _dividing(sets: Mapping[str, np.ndarray], m: int) -> tuple[tuple[str, ...], np.ndarray] | None:
    """Names of sets that hold each of m cells exactly once, and the place of each cell's among them."""
    names, members = tuple(sets), list(sets.values())
    if sum(map(len, members)) < m:
        return None
    of_hex = _numbered(members, m)
    if of_hex is None:
        return None
    if sum(map(len, members)) > m:
        chosen = _exact_cover(members, m)
        if chosen is None:
            return None
        names, of_hex = tuple(names[k] for k in chosen), _numbered([members[k] for k in chosen], m)
    return None if of_hex is None or len(names) < 2 else (names, of_hex)


def _numbered(members: Sequence[np.ndarray], m: int) -> np.ndarray | None:
    """Index of the last set that holds each of m hexes, (m,) int32; None if one is in no set."""
    number = np.full(m, -1, dtype=np.int32)
    for k, rows in enumerate(members):
        number[rows] = k
    return None if m and number.min() < 0 else number


def _exact_cover(members: Sequence[np.ndarray], m: int) -> list[int] | None:
    """Indices of sets that hold each of m hexes exactly once, ascending, by Knuth's algorithm X; None without any."""
    if not 2 <= len(members) <= _MAX_SETS:
        return None
    bits = np.zeros(m, dtype=np.uint64)
    for k, rows in enumerate(members):
        bits[rows] |= np.uint64(1 << k)  # a member that is there twice does no harm
    groups = [int(one) for one in np.unique(bits)]  # hexes of the same sets are one item
    items = [[g for g, of in enumerate(groups) if of >> k & 1] for k in range(len(members))]
    steps = 0

    def search(left: int, allowed: int) -> list[int] | None:
        nonlocal steps
        steps += 1
        if not left or steps > _MAX_SEARCH_STEPS:
            return None if left else []
        open_groups = [groups[g] & allowed for g in range(len(groups)) if left >> g & 1]
        fewest = min(open_groups, key=int.bit_count)
        for k in (k for k in range(len(members)) if fewest >> k & 1):
            rest, clash = left, 0
            for g in items[k]:
                rest &= ~(1 << g)
                clash |= groups[g]
            found = search(rest, allowed & ~clash)
            if found is not None:
                return [k, *found]
        return None

    found = search((1 << len(groups)) - 1, (1 << len(members)) - 1)
    return None if found is None else sorted(found)
