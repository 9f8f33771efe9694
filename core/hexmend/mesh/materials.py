"""Materials: the partition of the hexes of a mesh by the sets or data of its file, and the interfaces between them."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.mesh.hexahedron import FACES
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
        hexes, marks = self.topology.hexes, np.zeros(self.topology.n, dtype=bool)
        some = np.zeros(self.topology.n, dtype=np.int32)  # the material of one hex of each node
        some[hexes] = self.of_hex[:, None]
        marks[hexes[some[hexes] != self.of_hex[:, None]]] = True
        return as_immutable(marks)

    @cached_property
    def interface_sides(self) -> np.ndarray:
        """Faces between hexes of two materials, each once, (k, 4) int64.

        In each row a hex, its face in `hexmend.mesh.hexahedron.FACES`, the hex across it, and that one's face; the
        first hex is of the material with the lower index, so that the faces of one interface have one orientation.
        """
        near = self.interface_nodes[self.topology.hexes].sum(axis=1) >= 4
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
        return as_immutable(self.topology.hexes[hexes[:, None], FACES[sides]])

    def __len__(self) -> int:
        return len(self.names)


def find_materials(
    topology: Topology,
    hex_sets: Mapping[str, np.ndarray],
    hex_data: Mapping[str, np.ndarray],
    blocks: Collection[str] = (),
) -> Materials | None:
    """Find the materials of a mesh: by data that number them, else by sets that divide the hexes.

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
    m = len(topology.hexes)
    found = _by_data(hex_data, m)
    if found is None:
        sets = {name: members for name, members in hex_sets.items() if name not in blocks and 0 < len(members) < m}
        found = _by_sets(sets, m)
    return None if found is None else Materials(found[0], as_immutable(found[1]), topology)


def is_name_of_materials(name: str) -> bool:
    """Return True if data of this name may number materials."""
    return _key(name) in _DATA_NAMES


def _key(name: str) -> str:
    return "".join(filter(str.isalnum, name.lower()))


def _by_data(hex_data: Mapping[str, np.ndarray], m: int) -> tuple[tuple[str, ...], np.ndarray] | None:
    """Materials by the first data with a usual name and two or more whole numbers, fewer than half the hexes."""
    names = {_key(name): name for name in reversed(list(hex_data))}
    for name in _DATA_NAMES:
        if name not in names:
            continue
        values = np.asarray(hex_data[names[name]])
        if values.shape not in ((m,), (m, 1)) or values.dtype.kind not in "iuf":
            continue
        values = values.ravel()
        low, high = values.min(), values.max()
        if not low < high or not (np.isfinite(low) and np.isfinite(high)) or (values != np.floor(values)).any():
            continue
        numbers, of_hex = np.unique(values, return_inverse=True)
        if 2 * len(numbers) <= m:
            return tuple(str(int(number)) for number in numbers), of_hex.ravel().astype(np.int32)
    return None


def _by_sets(sets: Mapping[str, np.ndarray], m: int) -> tuple[tuple[str, ...], np.ndarray] | None:
    """Materials by sets that hold every hex exactly once."""
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
