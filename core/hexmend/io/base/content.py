"""What a file holds, as every reader hands it over and every writer takes it: blocks of cells of one kind."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from contextvars import ContextVar
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.fixed_marks import find_marks
from hexmend.mesh.cells import CELL_KINDS, Cells
from hexmend.mesh.hexahedron import EDGES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import MID_NODE_WEIGHTS
from hexmend.mesh.validation import check_node_numbers

#: Kinds of hexes, and how many nodes they have; in the order of VTK's types 12, 25 and 29.
HEX_KINDS = {"hex": 8, "hex20": 20, "hex27": 27}

#: Names of data that hold the file's own numbers of nodes and cells.
ID = "id"


@dataclass(frozen=True, eq=False)
class Block:
    """Cells of one kind.

    Parameters
    ----------
    kind : str
        One of `HEX_KINDS` or `CELL_KINDS`.
    nodes : (k, width) int array
        From 0, in the order of VTK.
    data : mapping of name to (k, ...) array
        "id" holds the file's own numbers of the cells.
    sets : mapping of name to (j,) int array
        Named groups of the block's cells, by their places in it.
    """

    kind: str
    nodes: np.ndarray
    data: Mapping[str, np.ndarray] = field(default_factory=dict)
    sets: Mapping[str, np.ndarray] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.nodes)


@dataclass(frozen=True, eq=False)
class Content:
    """Points, blocks of cells, and what is said of them.

    Parameters
    ----------
    points : (n, 3) float64
    blocks : sequence of Block
    node_data : mapping of name to (n, ...) array
    node_sets : mapping of name to (k,) int array
    side_sets : mapping of name to (k, 2) int array
        The hex, counted through the blocks of hexes, and which of `hexmend.mesh.hexahedron.FACES`.
    pinned : (n,) bool, optional
    field_data : mapping
    notes : sequence of str
    unread : mapping of str to int
        How many cells of kinds that are not read the file has, by what they are, such as "type PRISM18".
    """

    points: np.ndarray
    blocks: tuple[Block, ...]
    node_data: Mapping[str, np.ndarray] = field(default_factory=dict)
    node_sets: Mapping[str, np.ndarray] = field(default_factory=dict)
    side_sets: Mapping[str, np.ndarray] = field(default_factory=dict)
    pinned: np.ndarray | None = None
    field_data: Mapping[str, object] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    unread: Mapping[str, int] = field(default_factory=dict)


#: Whether nodes without finite coordinates are put between their neighbours, as who repairs a mesh wants it.
INTERPOLATE_MISSING: ContextVar[bool] = ContextVar("INTERPOLATE_MISSING", default=False)


def to_mesh(path: Path, content: Content) -> Mesh:
    """The mesh that a file's content makes.

    Raises
    ------
    FileError
        Where no cell is a hex: it says what there is.
    MeshError
        From `Mesh`.
    """
    hexes = [block for block in content.blocks if block.kind in HEX_KINDS and len(block)]
    others = [block for block in content.blocks if block.kind not in HEX_KINDS and len(block)]
    if not hexes:
        what = f", but {_inventory(others, content.unread)}" if others or content.unread else ""
        raise FileError(path, f"holds no hexahedra{what}", "Hexmend works on hexahedral meshes only.")
    for block in content.blocks:
        if len(block):
            check_node_numbers(block.nodes, len(content.points))
    lengths = [len(block) for block in hexes]
    volumes = [block for block in others if CELL_KINDS[block.kind].dimension == 3]
    notes, points = list(content.notes), content.points
    if INTERPOLATE_MISSING.get() and not np.isfinite(points).all():
        points, note = _placed(points, hexes)
        notes.append(note)
    if volumes:
        notes.append(f"{_inventory(volumes)} beside the hexes are kept as they are, and their nodes fixed.")
    pinned = _pinned(content)
    if volumes:
        pinned = np.zeros(len(content.points), bool) if pinned is None else pinned.copy()
        for block in volumes:
            pinned[block.nodes] = True
    return Mesh(
        points,
        np.concatenate([block.nodes[:, :8] for block in hexes]),
        pinned=pinned,
        node_data=content.node_data,
        hex_data=concatenate_data([block.data for block in hexes], lengths),
        node_sets=content.node_sets,
        hex_sets=concatenate_sets([block.sets for block in hexes], lengths),
        cells=tuple(Cells(block.kind, block.nodes.astype(np.int32), block.data, block.sets) for block in others),
        side_sets=content.side_sets,
        mid_nodes=_mid_nodes(hexes),
        field_data=content.field_data,
        notes=tuple(notes),
    )


def from_mesh(mesh: Mesh) -> Content:
    """The content that a file of the mesh holds: blocks of hexes first, by the number of their nodes."""
    blocks, chosen = zip(*hex_blocks(mesh), strict=True)
    place = np.argsort(np.concatenate(chosen))  # of each hex of the mesh, counted through the blocks
    side_sets = {name: np.asarray(rows, np.int64).reshape(-1, 2) for name, rows in mesh.side_sets.items()}
    return Content(
        mesh.points,
        (*blocks, *(Block(c.kind, c.nodes, c.data, c.sets) for c in mesh.cells)),
        mesh.node_data,
        mesh.node_sets,
        {name: np.column_stack([place[rows[:, 0]], rows[:, 1]]) for name, rows in side_sets.items()},
        mesh.pinned,
        mesh.field_data,
    )


def hex_blocks(mesh: Mesh) -> Iterator[tuple[Block, np.ndarray]]:
    """The hexes of first and second order as blocks, with their numbers in the mesh."""
    if mesh.mid_nodes is None:
        yield Block("hex", mesh.hexes, mesh.hex_data, mesh.hex_sets), np.arange(mesh.n_hexes)
        return
    more = (mesh.mid_nodes >= 0).sum(axis=1)
    for kind, width in HEX_KINDS.items():
        chosen = np.flatnonzero(more == width - 8)
        if chosen.size:
            place = np.full(mesh.n_hexes, -1)
            place[chosen] = np.arange(chosen.size)
            nodes = np.column_stack([mesh.hexes[chosen], mesh.mid_nodes[chosen, : width - 8]])
            sets = {name: place[members][place[members] >= 0] for name, members in mesh.hex_sets.items()}
            data = {name: np.asarray(values)[chosen] for name, values in mesh.hex_data.items()}
            yield Block(kind, nodes, data, {name: members for name, members in sets.items() if members.size}), chosen


def concatenate_data(parts: list[Mapping[str, np.ndarray]], lengths: list[int]) -> dict[str, np.ndarray]:
    """One array over all cells for each name; where a block has none of it, reals are NaN and all else is zero.

    Arrays of one name that have other widths, or are no numbers as the first are, go by that name and a number:
    "stress", "stress_2".
    """
    named = [{name: np.asarray(values) for name, values in part.items()} for part in parts]
    answer: dict[str, np.ndarray] = {}
    taken = {name for part in named for name in part}
    for name in dict.fromkeys(name for part in named for name in part):
        sorts = dict.fromkeys(_sort(part[name]) for part in named if name in part)
        for k, sort in enumerate(sorts):
            alike = [part.get(name) if name in part and _sort(part[name]) == sort else None for part in named]
            title = unused_name(name, taken) if k else name
            answer[title] = np.concatenate(
                [_missing(alike, length) if one is None else one for one, length in zip(alike, lengths, strict=True)]
            )
            taken.add(title)
    return answer


def unused_name(name: str, taken: Collection[str]) -> str:
    """A name that is none of those taken: with a number behind it, from 2."""
    return next(title for k in count(2) if (title := f"{name}_{k}") not in taken)


def _sort(values: np.ndarray) -> tuple[tuple[int, ...], bool]:
    """What arrays must have in common to be one: the shape of a row, and whether it holds numbers."""
    return values.shape[1:], values.dtype.kind in "biufc"


def _missing(arrays: list[np.ndarray | None], length: int) -> np.ndarray:
    """Values for cells that have none, like those of other cells."""
    one = next(one for one in arrays if one is not None)
    return np.full((length, *one.shape[1:]), np.nan if one.dtype.kind in "fc" else np.zeros(1, one.dtype)[0], one.dtype)


def concatenate_sets(parts: list[Mapping[str, np.ndarray]], lengths: list[int]) -> dict[str, np.ndarray]:
    """The sets of all parts, whose cells are counted through them."""
    first = np.concatenate([[0], np.cumsum(lengths)])
    return {
        name: np.concatenate([np.asarray(part[name]) + first[k] for k, part in enumerate(parts) if name in part])
        for name in dict.fromkeys(name for part in parts for name in part)
    }


def _neighbours(kind: str) -> list[tuple[int, int]]:
    """Pairs of a hex's nodes beside each other: along edges; each node of second order with the corners around."""
    pairs = [(int(a), int(b)) for a, b in EDGES]
    middles = range(8, HEX_KINDS[kind])
    return pairs + [(k, int(corner)) for k in middles for corner in np.flatnonzero(MID_NODE_WEIGHTS[k - 8])]


def _placed(points: np.ndarray, blocks: list[Block]) -> tuple[np.ndarray, str]:
    """Points with those that are no numbers put between their neighbours, and a note that says so."""
    points = np.array(points, dtype=np.float64)
    lost = ~np.isfinite(points).all(axis=1)
    count = int(lost.sum())
    ends = np.concatenate([block.nodes[:, edge] for block in blocks for edge in _neighbours(block.kind)])
    ends = np.concatenate([ends, ends[:, ::-1]])
    points[lost] = points[~lost].mean(axis=0) if (~lost).any() else 0.0
    known = ~lost
    while not known.all():
        rows = ends[~known[ends[:, 0]] & known[ends[:, 1]]]
        if not len(rows):
            break
        total = np.zeros_like(points)
        np.add.at(total, rows[:, 0], points[rows[:, 1]])
        times = np.bincount(rows[:, 0], minlength=len(points))
        found = np.flatnonzero(times)
        points[found] = total[found] / times[found, None]
        known[found] = True
    return points, f"{count:,} nodes had no finite coordinates, and have been put between their neighbours."


def _mid_nodes(hexes: list[Block]) -> np.ndarray | None:
    if all(block.kind == "hex" for block in hexes):
        return None
    rows = []
    for block in hexes:
        row = np.full((len(block), 19), -1, np.int32)
        row[:, : block.nodes.shape[1] - 8] = block.nodes[:, 8:]
        rows.append(row)
    return np.concatenate(rows)


def _pinned(content: Content) -> np.ndarray | None:
    """Pins of the file, or those that data named "fixed" make."""
    return content.pinned if content.pinned is not None else find_marks(content.node_data)[1]


def _inventory(blocks: list[Block], unread: Mapping[str, int] | None = None) -> str:
    """What cells there are, and of which kinds others are that are not read, in words."""
    counts: dict[str, int] = {}
    for block in blocks:
        counts[block.kind] = counts.get(block.kind, 0) + len(block)
    words = [f"{count:,} {kind} cell{'s' * (count != 1)}" for kind, count in counts.items()]
    words += [f"{count:,} cell{'s' * (count != 1)} of {kind}" for kind, count in list((unread or {}).items())[:6]]
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words) or "no cells"
