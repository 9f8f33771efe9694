"""Content of a mesh file, the same for all formats: points, blocks of cells of one kind, data and sets.

Number of nodes, dimension and node order of every kind of cell, hexahedra included.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path

import numpy as np

from hexmend.arrays import as_immutable_owned
from hexmend.errors import FileError
from hexmend.io.base.fixed_marks import find_marks
from hexmend.io.base.missing_coordinates import interpolate_missing
from hexmend.mesh.cells import CELL_KINDS, Cells
from hexmend.mesh.collapsed_hexes import with_collapsed_converted
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import as_hexes, as_points, check_node_numbers
from hexmend.terminal_text import count_phrase, listed

#: Kinds of hexes and their numbers of nodes, in the order of VTK's types 12, 25 and 29.
HEX_KINDS = {"hex": 8, "hex20": 20, "hex27": 27}


def node_count(kind: str) -> int:
    """Number of nodes of a cell of a kind, one of `HEX_KINDS` or `CELL_KINDS`."""
    return HEX_KINDS[kind] if kind in HEX_KINDS else CELL_KINDS[kind].nodes


def dimension(kind: str) -> int:
    """Dimension of a cell of a kind: 0 for a vertex up to 3 for a volume."""
    return 3 if kind in HEX_KINDS else CELL_KINDS[kind].dimension


#: Order of nodes of formats that list the mid-nodes of vertical edges before those of the upper face: see
#: `to_vtk_order`.
VERTICAL_EDGES_FIRST: dict[str, list[int]] = {
    "hex20": [*range(12), 16, 17, 18, 19, 12, 13, 14, 15],
    "wedge15": [*range(9), 12, 13, 14, 9, 10, 11],
}


def to_vtk_order(nodes: np.ndarray, kind: str, order: Mapping[str, Sequence[int] | np.ndarray]) -> np.ndarray:
    """Reorder the nodes of cells from the order of a format to VTK's.

    Parameters
    ----------
    nodes : (k, width) array
    kind : str
    order : mapping of str to (width,) int
        vtk = format[order[kind]]; kinds without an entry have one order in both.

    Returns
    -------
    (k, width) array
    """
    return nodes[:, order[kind]] if kind in order else nodes


def from_vtk_order(nodes: np.ndarray, kind: str, order: Mapping[str, Sequence[int] | np.ndarray]) -> np.ndarray:
    """Reorder the nodes of cells from VTK's order to the order of a format, the inverse of `to_vtk_order`."""
    return nodes[:, np.argsort(order[kind])] if kind in order else nodes


#: Ways to a mesh that can be read.
_ORDERS = "Write it with elements of order 1 or 2; Gmsh does: gmsh MODEL -3 -order 2."

#: True while a file is read whose nodes without finite coordinates are to be interpolated.
INTERPOLATE_MISSING: ContextVar[bool] = ContextVar("INTERPOLATE_MISSING", default=False)


#: Name of the data that hold the file's own numbers of nodes and cells.
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
    data : mapping of str to (k, ...) array
        "id" holds the file's own numbers of the cells.
    sets : mapping of str to (j,) int array
        Named groups of cells, as indices into the block.
    """

    kind: str
    nodes: np.ndarray
    data: Mapping[str, np.ndarray] = field(default_factory=dict)
    sets: Mapping[str, np.ndarray] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.nodes)


@dataclass(frozen=True, eq=False)
class Content:
    """Points, blocks of cells, and their data and sets.

    A mesh takes the points and the nodes of hexes over without a copy: nobody may write to them afterwards.

    Parameters
    ----------
    points : (n, 3) float64
    blocks : sequence of Block
    node_data : mapping of str to (n, ...) array
    node_sets : mapping of str to (k,) int array
    side_sets : mapping of str to (k, 2) int array
        Index of the hex, counted through the blocks of hexes, and of the face in `hexmend.mesh.hexahedron.FACES`.
    pinned : (n,) bool, optional
    field_data : mapping of str to object
    notes : sequence of str
        Sentences about changes made on reading.
    unread : mapping of str to int
        Number of cells of each kind that is not supported, by a description such as "type PRISM18".
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


def to_mesh(path: Path, content: Content) -> Mesh:
    """Make a mesh of a file's content.

    Parameters
    ----------
    path : Path
        Named in errors.
    content : Content

    Returns
    -------
    Mesh

    Raises
    ------
    FileError
        Where there are no solid cells: it lists the other cells.
    MeshError
        From `Mesh`.
    """
    hexes = [block for block in content.blocks if block.kind in HEX_KINDS and len(block)]
    others = [block for block in content.blocks if block.kind not in HEX_KINDS and len(block)]
    solids = [block for block in others if CELL_KINDS[block.kind].dimension == 3]
    if not hexes and not solids:
        found = f", but {_inventory(others, content.unread)}" if others or content.unread else ""
        remedy = "Hexmend works on meshes of solid cells, above all hexes."
        remedy = _ORDERS if any("of order" in kind for kind in content.unread) else remedy
        raise FileError(path, f"holds no hexahedra{found}", remedy)
    for block in content.blocks:
        if len(block):
            check_node_numbers(block.nodes, len(content.points))
    notes, points = list(content.notes), content.points
    if INTERPOLATE_MISSING.get() and not np.isfinite(points).all():
        points, note = interpolate_missing(points, [block.nodes for block in hexes])
        notes.append(note)
    if not hexes:
        notes.append(f"The mesh has no hexes, for which Hexmend is made, but {_inventory(solids)}.")
    pinned = content.pinned if content.pinned is not None else find_marks(content.node_data)[1]
    lengths, corners = [len(block) for block in hexes], [block.nodes[:, :8] for block in hexes]
    corners = corners or [np.empty((0, 8), np.int32)]
    mesh = Mesh(
        as_immutable_owned(as_points(points)),
        as_immutable_owned(as_hexes(corners[0] if len(corners) == 1 else np.concatenate(corners), len(points))),
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
    mesh, note = with_collapsed_converted(mesh)
    return mesh.replace(notes=(*mesh.notes, note)) if note else mesh


def from_mesh(mesh: Mesh) -> Content:
    """Make the content of a file that holds a mesh: blocks of hexes by their number of nodes, then other cells."""
    blocks, hexes = zip(*hex_blocks(mesh), strict=True) if mesh.n_hexes else ((), (np.empty(0, np.int64),))
    new_index = np.argsort(np.concatenate(hexes))  # of each hex of the mesh, counted through the blocks
    sides = {name: np.asarray(rows, np.int64).reshape(-1, 2) for name, rows in mesh.side_sets.items()}
    sides = {name: np.column_stack([new_index[rows[:, 0]], rows[:, 1]]) for name, rows in sides.items()}
    blocks += tuple(Block(cells.kind, cells.nodes, cells.data, cells.sets) for cells in mesh.cells)
    return Content(mesh.points, blocks, mesh.node_data, mesh.node_sets, sides, mesh.pinned, mesh.field_data)


def hex_blocks(mesh: Mesh) -> Iterator[tuple[Block, np.ndarray]]:
    """Yield a block for each kind of hexes, with the indices of its hexes in the mesh, (k,) int64."""
    if mesh.mid_nodes is None:
        yield Block("hex", mesh.hexes, mesh.hex_data, mesh.hex_sets), np.arange(mesh.n_hexes)
        return
    mid_nodes = (mesh.mid_nodes >= 0).sum(axis=1)
    for kind, width in HEX_KINDS.items():
        chosen = np.flatnonzero(mid_nodes == width - 8)
        if chosen.size:
            new_index = np.full(mesh.n_hexes, -1)
            new_index[chosen] = np.arange(chosen.size)
            nodes = np.column_stack([mesh.hexes[chosen], mesh.mid_nodes[chosen, : width - 8]])
            sets = {name: new_index[members][new_index[members] >= 0] for name, members in mesh.hex_sets.items()}
            data = {name: np.asarray(values)[chosen] for name, values in mesh.hex_data.items()}
            yield Block(kind, nodes, data, {name: members for name, members in sets.items() if members.size}), chosen


def concatenate_data(parts: Sequence[Mapping[str, np.ndarray]], lengths: list[int]) -> dict[str, np.ndarray]:
    """Concatenate the data of several blocks, name by name.

    Cells of a block without the name get NaN in real and complex arrays, else zero. Arrays of one name whose rows have
    different shapes, or of which only some hold numbers, are kept apart by a suffix: "stress", "stress_2".

    Parameters
    ----------
    parts : list of mapping of str to (length, ...) array
    lengths : list of int
        Number of cells of each part.

    Returns
    -------
    dict of str to (sum(lengths), ...) array
    """
    arrays = [{name: np.asarray(values) for name, values in part.items()} for part in parts]
    joined: dict[str, np.ndarray] = {}
    taken = {name for part in arrays for name in part}
    for name in dict.fromkeys(name for part in arrays for name in part):
        layouts = dict.fromkeys(_layout(part[name]) for part in arrays if name in part)
        for k, layout in enumerate(layouts):
            alike = [part.get(name) if name in part and _layout(part[name]) == layout else None for part in arrays]
            title = unused_name(name, taken) if k else name
            joined[title] = np.concatenate(
                [_fill(alike, n) if values is None else values for values, n in zip(alike, lengths, strict=True)]
            )
            taken.add(title)
    return joined


def merge_blocks(blocks: list[Block]) -> Block:
    """Concatenate blocks of one kind."""
    lengths, nodes = [len(block) for block in blocks], np.concatenate([block.nodes for block in blocks])
    data = concatenate_data([block.data for block in blocks], lengths)
    return Block(blocks[0].kind, nodes, data, concatenate_sets([block.sets for block in blocks], lengths))


def merge_other_kinds(blocks: Sequence[Block]) -> tuple[Block, ...]:
    """Return the blocks of hexes as they are, and behind them one block for each other kind."""
    hexes, others = ([one for one in blocks if (one.kind in HEX_KINDS) == is_hex] for is_hex in (True, False))
    kinds = dict.fromkeys(block.kind for block in others)
    return (*hexes, *(merge_blocks([block for block in others if block.kind == kind]) for kind in kinds))


def unused_name(name: str, taken: Collection[str]) -> str:
    """Append a number from 2 to a name so that it is not taken."""
    return next(title for k in count(2) if (title := f"{name}_{k}") not in taken)


def _layout(values: np.ndarray) -> tuple[tuple[int, ...], bool]:
    """Shape of a row, and True for numbers; arrays can be concatenated if both agree."""
    return values.shape[1:], values.dtype.kind in "biufc"


def _fill(arrays: list[np.ndarray | None], length: int) -> np.ndarray:
    """NaN or zero for cells without data, with the type and shape of the first array that is there."""
    first = next(values for values in arrays if values is not None)
    value = np.nan if first.dtype.kind in "fc" else np.zeros(1, first.dtype)[0]
    return np.full((length, *first.shape[1:]), value, first.dtype)


def concatenate_sets(parts: list[Mapping[str, np.ndarray]], lengths: list[int]) -> dict[str, np.ndarray]:
    """Concatenate the sets of several blocks, name by name; indices count through all blocks."""
    first = np.concatenate([[0], np.cumsum(lengths)])
    return {
        name: np.concatenate([np.asarray(part[name]) + first[k] for k, part in enumerate(parts) if name in part])
        for name in dict.fromkeys(name for part in parts for name in part)
    }


def _mid_nodes(hexes: list[Block]) -> np.ndarray | None:
    """Mid-nodes of all hexes, (m, 19) int32, -1 where a hex has fewer; None if no hex has any."""
    if all(block.kind == "hex" for block in hexes):  # or there are none
        return None
    missing = [((0, 0), (0, 27 - block.nodes.shape[1])) for block in hexes]
    rows = [block.nodes[:, 8:].astype(np.int32) for block in hexes]
    return np.concatenate([np.pad(own, pad, constant_values=-1) for own, pad in zip(rows, missing, strict=True)])


def _inventory(blocks: list[Block], unread: Mapping[str, int] | None = None) -> str:
    """List numbers of cells by kind for a message; of kinds that are not supported, the first six."""
    counts = Counter()
    for block in blocks:
        counts[block.kind] += len(block)
    phrases = [count_phrase(n, f"{kind} cell") for kind, n in counts.items()]
    phrases += [f"{count_phrase(n, 'cell')} of {kind}" for kind, n in list((unread or {}).items())[:6]]
    return listed(phrases, "and") or "no cells"
