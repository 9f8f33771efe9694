"""An unstructured grid as VTK's formats hold it, and the content that it is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, Block, Content, concatenate_data
from hexmend.io.base.content import from_mesh as content_of
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.fixed_marks import with_marks
from hexmend.mesh.cells import CELL_KINDS
from hexmend.mesh.hexahedron import VOXEL_ORDER
from hexmend.mesh.mesh import Mesh

HEXAHEDRON, VOXEL, QUAD, PIXEL = 12, 11, 9, 8

#: VTK's number of every kind of cell that is read.
KINDS = {12: "hex", 25: "hex20", 29: "hex27", **{kind.vtk: name for name, kind in CELL_KINDS.items()}}
NUMBERS = {name: number for number, name in KINDS.items()}
WIDTHS = {number: HEX_KINDS[name] if name in HEX_KINDS else CELL_KINDS[name].nodes for number, name in KINDS.items()}
WIDTHS |= {VOXEL: 8, PIXEL: 4}

#: Types whose cells may have any number of nodes; of these, those with the nodes of another kind are of that one.
_ANY = {2: {1: 1}, 4: {2: 3, 3: 21}, 7: {3: 5, 4: 9}}
#: Names of types that are not read, for messages.
NAMES = {
    0: "VTK_EMPTY_CELL", 2: "VTK_POLY_VERTEX", 4: "VTK_POLY_LINE", 6: "VTK_TRIANGLE_STRIP", 7: "VTK_POLYGON",
    15: "VTK_PENTAGONAL_PRISM", 16: "VTK_HEXAGONAL_PRISM", 42: "VTK_POLYHEDRON",
    72: "VTK_LAGRANGE_HEXAHEDRON",
}  # fmt: skip

#: quad = pixel[PIXEL_ORDER].
PIXEL_ORDER = np.array([0, 1, 3, 2])

_SET = "set:"


@dataclass(frozen=True, eq=False)
class Grid:
    """An unstructured grid as VTK's formats hold it.

    Parameters
    ----------
    points : (n, 3) float64
    types : (c,) int
        VTK cell types.
    start : (c + 1,) int64
        Nodes of cell i are nodes[start[i]:start[i + 1]].
    nodes : (start[-1],) int64
    node_data, cell_data : mapping of name to (n, ...) or (c, ...) array
    field_data : mapping of name to array or list of str
    notes : sequence of str
        What was done to it on reading, in sentences.
    """

    points: np.ndarray
    types: np.ndarray
    start: np.ndarray
    nodes: np.ndarray
    node_data: Mapping[str, np.ndarray]
    cell_data: Mapping[str, np.ndarray]
    field_data: Mapping[str, object] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def to_mesh(path: Path, grid: Grid) -> Mesh:
    """The mesh that a grid holds; see `to_content` and `hexmend.io.base.content.to_mesh`."""
    return mesh_of(path, to_content(path, grid))


def to_content(path: Path, grid: Grid) -> Content:
    """The content that a grid holds.

    Cells of eight nodes that are labelled as tetrahedra are hexes where all of them are, and a note says so. Cells of
    kinds that are not known (polyhedra, Lagrange's) are left out, and a note says so.

    Raises
    ------
    FileError
        Where no cell is a hex, a cell has not the nodes of its type, or its type is none.
    """
    types, notes = _true_types(path, grid)
    check_sizes(path, grid, types)
    blocks = []
    for number in dict.fromkeys(types.tolist()):
        if number not in WIDTHS:
            continue
        chosen = np.flatnonzero(types == number)
        rows = _rows(grid, chosen, WIDTHS[number])
        rows = rows[:, VOXEL_ORDER] if number == VOXEL else rows[:, PIXEL_ORDER] if number == PIXEL else rows
        data, sets = _parted({name: _taken(values, chosen) for name, values in grid.cell_data.items()})
        blocks.append(Block(KINDS[{VOXEL: HEXAHEDRON, PIXEL: QUAD}.get(number, number)], rows, data, sets))
    unknown = np.flatnonzero(~np.isin(types, list(WIDTHS)))
    if unknown.size:
        if not any(block.kind in HEX_KINDS for block in blocks):
            first = int(unknown[0])
            name = NAMES.get(int(types[first]), f"cell of type {types[first]}")
            raise FileError(
                path,
                f"cell {first} is a {name}; Hexmend reads hexahedra (types 11, 12, 25, 29)",
                "Hexmend works on hexahedral meshes only.",
            )
        names = sorted({NAMES.get(int(number), f"type {number}") for number in types[unknown]})
        notes.append(f"{unknown.size:,} cells of other kinds ({', '.join(names)}) are left out.")
    blocks.sort(key=lambda block: [*HEX_KINDS, *CELL_KINDS].index(block.kind))
    node_data, node_sets = _parted(grid.node_data)
    if all(block.kind != "hex20" and block.kind != "hex27" for block in blocks):
        blocks = _in_order(grid, types, blocks)
    said = (*grid.notes, *notes)
    return Content(grid.points, tuple(blocks), node_data, node_sets, field_data=grid.field_data, notes=said)


def from_mesh(mesh: Mesh, kinds: str = "biufU") -> Grid:
    """The grid that holds a mesh, hexahedra first; sets are arrays named "set:...", pins one named "fixed".

    Parameters
    ----------
    mesh : Mesh
    kinds : str
        Kinds of NumPy types of which data of cells and nodes are kept. VTK's formats have no complex numbers.
    """
    content = content_of(mesh)
    blocks = tuple(replace(block, data=_of_kinds(block.data, kinds)) for block in content.blocks)
    return from_content(replace(content, blocks=blocks, node_data=_of_kinds(with_marks(mesh), kinds)))


def from_content(content: Content) -> Grid:
    """The grid of a content's blocks and arrays, one behind the other; sets are arrays named "set:..."."""
    lengths = [len(block) for block in content.blocks]
    node_data = dict(content.node_data)
    for name, members in content.node_sets.items():
        node_data[_SET + name] = _mask(members, len(content.points))
    widths = np.concatenate([np.full(len(block), block.nodes.shape[1], np.int64) for block in content.blocks])
    return Grid(
        points=content.points,
        types=np.concatenate([np.full(len(block), NUMBERS[block.kind], np.uint8) for block in content.blocks]),
        start=np.concatenate([[0], np.cumsum(widths)]),
        nodes=np.concatenate([block.nodes.ravel() for block in content.blocks]),
        node_data=node_data,
        cell_data=concatenate_data(
            [
                {**block.data, **{_SET + name: _mask(members, len(block)) for name, members in block.sets.items()}}
                for block in content.blocks
            ],
            lengths,
        ),
        field_data=content.field_data,
    )


def _of_kinds(data: Mapping[str, np.ndarray], kinds: str) -> dict[str, np.ndarray]:
    return {name: values for name, values in data.items() if np.asarray(values).dtype.kind in kinds}


def check_sizes(path: Path, grid: Grid, types: np.ndarray) -> None:
    """Raise `FileError` naming the first cell whose number of nodes is not that of its type."""
    widths = np.diff(grid.start)
    expected = np.array([WIDTHS.get(number, -1) for number in range(256)])[types]
    wrong = np.flatnonzero((widths != expected) & (expected >= 0))
    if len(wrong):
        i = int(wrong[0])
        raise FileError(
            path,
            f"cell {i} is of type {types[i]} and has {widths[i]} nodes: expected {expected[i]}",
            "Write the file again with the program that made it.",
        )


def _true_types(path: Path, grid: Grid) -> tuple[np.ndarray, list[str]]:
    """Types of the cells by what they are, and what is to be said of it."""
    given, widths, notes = np.asarray(grid.types).astype(np.int64), np.diff(grid.start), []
    outside = np.flatnonzero((given < 0) | (given > 255))
    if outside.size:
        raise FileError(
            path,
            f"cell {outside[0]} is of type {given[outside[0]]}: expected one of VTK's types, 0 to 255",
            "Write the file again with the program that made it.",
        )
    types = given.copy()
    for number, others in _ANY.items():
        for width, other in others.items():
            types[(given == number) & (widths == width)] = other
    tetra = given == NUMBERS["tetra"]
    if tetra.any() and (widths[tetra] == 8).all():
        types[tetra] = HEXAHEDRON
        notes.append(
            f"{int(tetra.sum()):,} cells of eight nodes are labelled as tetrahedra in the file: read as hexes."
        )
    return types, notes


def _in_order(grid: Grid, types: np.ndarray, blocks: list[Block]) -> list[Block]:
    """Hexahedra and voxels as one block, in the order of the file."""
    hexes = [block for block in blocks if block.kind == "hex"]
    if len(hexes) < 2:
        return blocks
    places = [np.flatnonzero(types == number) for number in dict.fromkeys(types.tolist()) if number in (11, 12)]
    order = np.argsort(np.concatenate(places), kind="stable")
    lengths = [len(block) for block in hexes]
    data, sets = _parted(
        concatenate_data(
            [
                {**block.data, **{_SET + name: _mask(members, len(block)) for name, members in block.sets.items()}}
                for block in hexes
            ],
            lengths,
        )
    )
    nodes = np.concatenate([block.nodes for block in hexes])[order]
    place = np.argsort(order)
    whole = Block(
        "hex",
        nodes,
        {name: values[order] for name, values in data.items()},
        {name: np.sort(place[members]) for name, members in sets.items()},
    )
    return [whole, *(block for block in blocks if block.kind != "hex")]


def _rows(grid: Grid, chosen: np.ndarray, width: int) -> np.ndarray:
    if len(chosen) == len(grid.types):
        return np.array(grid.nodes, dtype=np.int64).reshape(-1, width)
    return np.asarray(grid.nodes, dtype=np.int64)[grid.start[chosen][:, None] + np.arange(width)]


def _taken(values: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    return values if len(chosen) == len(values) else np.asarray(values)[chosen]


def _parted(data: Mapping[str, np.ndarray]) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Arrays, and the sets among them, which are of ones and zeros."""
    arrays, sets = {}, {}
    for name, values in data.items():
        if name.startswith(_SET) and np.ndim(values) == 1 and np.isin(values, (0, 1)).all():
            members = np.flatnonzero(values)
            if members.size:
                sets[name[len(_SET) :]] = members
        else:
            arrays[name] = values
    return arrays, sets


def _mask(members: np.ndarray, length: int) -> np.ndarray:
    mask = np.zeros(length, np.uint8)
    mask[np.asarray(members, dtype=np.int64)] = 1
    return mask
