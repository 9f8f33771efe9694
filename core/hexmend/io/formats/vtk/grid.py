"""Unstructured grids of VTK's formats, and their conversion to and from the content of a file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from hexmend.arrays import mask
from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, Block, Content, concatenate_data, merge_blocks, node_count
from hexmend.io.base.content import from_mesh as content_of
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.polyhedra import RaggedArray, cells_from_faces
from hexmend.io.base.remedies import unread_note
from hexmend.mesh.cells import CELL_KINDS
from hexmend.mesh.hexahedron import VOXEL_ORDER
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase

HEXAHEDRON, VOXEL, QUAD, PIXEL, POLYHEDRON = 12, 11, 9, 8, 42

#: Kinds of cells that are read, by VTK's type number.
KIND_BY_TYPE = {12: "hex", 25: "hex20", 29: "hex27", **{kind.vtk: name for name, kind in CELL_KINDS.items()}}
#: VTK's type number by kind.
TYPE_BY_KIND = {name: number for number, name in KIND_BY_TYPE.items()}
#: Number of nodes by type number.
WIDTH_BY_TYPE = {number: node_count(name) for number, name in KIND_BY_TYPE.items()}
WIDTH_BY_TYPE |= {VOXEL: 8, PIXEL: 4}

#: Types with any number of nodes: the type that a cell with so many nodes is read as.
_VARIABLE_WIDTH = {2: {1: 1}, 4: {2: 3, 3: 21}, 7: {3: 5, 4: 9}}
#: Hexes of second order that are labelled as those of first order.
_VARIABLE_WIDTH |= {HEXAHEDRON: {20: 25, 27: 29}}
#: Lagrange and Bézier cells of order 1: line, triangle, quad, tetrahedron, hex, wedge, pyramid.
_ORDER_1 = ({2: 3}, {3: 5}, {4: 9}, {4: 10}, {8: 12}, {6: 13}, {5: 14})
_VARIABLE_WIDTH |= dict(enumerate(_ORDER_1, 68)) | dict(enumerate(_ORDER_1, 75))
#: Names of types that are not read, for messages.
NAMES = {
    0: "VTK_EMPTY_CELL", 2: "VTK_POLY_VERTEX", 4: "VTK_POLY_LINE", 6: "VTK_TRIANGLE_STRIP", 7: "VTK_POLYGON",
    15: "VTK_PENTAGONAL_PRISM", 16: "VTK_HEXAGONAL_PRISM", 42: "VTK_POLYHEDRON", 72: "VTK_LAGRANGE_HEXAHEDRON",
}  # fmt: skip

#: quad = pixel[PIXEL_ORDER].
PIXEL_ORDER = np.array([0, 1, 3, 2])

#: Prefix of arrays of ones and zeros that hold sets.
_SET = "set:"


@dataclass(frozen=True, eq=False)
class Grid:
    """Unstructured grid in the layout of VTK's formats.

    Parameters
    ----------
    points : (n, 3) float64
    types : (c,) int
        VTK cell types.
    start : (c + 1,) int64
        Cell i has the nodes nodes[start[i]:start[i + 1]].
    nodes : (start[-1],) int
    node_data, cell_data : mapping of str to (n, ...) or (c, ...) array
    field_data : mapping of str to array or list of str
    notes : sequence of str
        Sentences about changes made on reading.
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
    """Make a mesh of a grid; see `to_content` and `hexmend.io.base.content.to_mesh`."""
    return mesh_of(path, to_content(path, grid))


def to_content(path: Path, grid: Grid) -> Content:
    """Make the content of a file of a grid.

    Cells labelled as tetrahedra are read as hexes if all of them have eight nodes. Cells of other types (polyhedra,
    Lagrange cells) are left out. Notes say so.

    Parameters
    ----------
    path : Path
        Named in errors.
    grid : Grid

    Returns
    -------
    Content

    Raises
    ------
    FileError
        Where no cell is a hex, the number of nodes of a cell does not fit its type, or the type is not one of VTK's.
    """
    types, notes = _correct_types(path, grid)
    check_sizes(path, grid, types)
    blocks = []
    for number in _distinct(types):
        if number not in WIDTH_BY_TYPE:
            continue
        chosen = np.flatnonzero(types == number)
        rows = _rows(grid, chosen, WIDTH_BY_TYPE[number])
        rows = rows[:, VOXEL_ORDER] if number == VOXEL else rows[:, PIXEL_ORDER] if number == PIXEL else rows
        data, sets = _split_sets({name: _select(values, chosen) for name, values in grid.cell_data.items()})
        blocks.append(Block(KIND_BY_TYPE[{VOXEL: HEXAHEDRON, PIXEL: QUAD}.get(number, number)], rows, data, sets))
    unknown = np.flatnonzero(~mask(np.array(list(WIDTH_BY_TYPE)), 256)[types])
    if unknown.size:
        if not any(block.kind in HEX_KINDS or CELL_KINDS[block.kind].dimension == 3 for block in blocks):
            first = int(unknown[0])
            name = NAMES.get(int(types[first]), f"cell of type {types[first]}")
            problem = f"cell {first} is a {name}; Hexmend reads hexahedra (types 11, 12, 25, 29)"
            raise FileError(path, problem, "Hexmend works on hexahedral meshes only.")
        names = sorted({NAMES.get(int(number), f"type {number}") for number in types[unknown]})
        kinds = f"({', '.join(names)})"
        some = count_phrase(unknown.size, f"cell of another kind {kinds}", f"cells of other kinds {kinds}")
        notes.append(unread_note(some))
    blocks.sort(key=lambda block: [*HEX_KINDS, *CELL_KINDS].index(block.kind))
    node_data, node_sets = _split_sets(grid.node_data)
    if all(block.kind != "hex20" and block.kind != "hex27" for block in blocks):
        blocks = _merge_voxels(types, blocks)
    notes = (*grid.notes, *notes)
    return Content(grid.points, tuple(blocks), node_data, node_sets, field_data=grid.field_data, notes=notes)


def with_polyhedra_converted(grid: Grid, faces: RaggedArray) -> Grid:
    """Make hexes, wedges, pyramids and tetrahedra of polyhedra that are such; other polyhedra stay.

    Parameters
    ----------
    grid : Grid
    faces : RaggedArray
        Of each polyhedron the number of its faces, then of each face the number of its nodes and these.
    """
    which, heads = np.flatnonzero(np.asarray(grid.types) == POLYHEDRON), faces.start[:-1]
    if not len(which) or not faces.lengths.all():
        return grid
    loops, whole = RaggedArray.of_counted_rows(np.delete(faces.values, heads))
    first = np.concatenate([[0], np.cumsum(faces.values[heads])])
    if not whole or len(which) != len(heads) or len(loops) != first[-1] or (np.diff(first) < 0).any():
        return grid
    found = cells_from_faces(loops, RaggedArray(first, np.arange(len(loops))), np.ones(len(loops), bool))
    types, widths = np.array(grid.types), np.diff(grid.start)
    kept, given = np.ones(len(types), dtype=bool), widths.copy()
    for kind, (rows, nodes) in found.items():
        types[which[rows]], widths[which[rows]], kept[which[rows]] = TYPE_BY_KIND[kind], nodes.shape[1], False
    start = np.concatenate([[0], np.cumsum(widths)])
    nodes = np.empty(start[-1], np.int64)
    nodes[np.repeat(kept, widths)] = grid.nodes[np.repeat(kept, given)]
    for rows, own in found.values():
        nodes[start[which[rows]][:, None] + np.arange(own.shape[1])] = own
    return replace(grid, types=types, start=start, nodes=nodes)


def from_mesh(mesh: Mesh, kinds: str = "biufU") -> Grid:
    """Make a grid of a mesh, hexahedra first; sets become arrays named "set:...", fixed nodes one named "fixed".

    Parameters
    ----------
    mesh : Mesh
    kinds : str
        Kinds of NumPy types of data that are kept. VTK's formats have no complex numbers.
    """
    content = content_of(mesh)
    blocks = tuple(replace(block, data=_of_kinds(block.data, kinds)) for block in content.blocks)
    return from_content(replace(content, blocks=blocks, node_data=_of_kinds(with_marks(mesh), kinds)))


def from_content(content: Content) -> Grid:
    """Make a grid of a content; sets become arrays named "set:..."."""
    lengths = [len(block) for block in content.blocks]
    node_data = dict(content.node_data)
    for name, members in content.node_sets.items():
        node_data[_SET + name] = mask(members, len(content.points)).view(np.uint8)
    widths = np.concatenate([np.full(len(block), block.nodes.shape[1], np.int64) for block in content.blocks])
    types = np.concatenate([np.full(len(block), TYPE_BY_KIND[block.kind], np.uint8) for block in content.blocks])
    start, nodes = np.concatenate([[0], np.cumsum(widths)]), [block.nodes.ravel() for block in content.blocks]
    cell_data = concatenate_data([_with_set_arrays(block) for block in content.blocks], lengths)
    return Grid(content.points, types, start, np.concatenate(nodes), node_data, cell_data, content.field_data)


def _with_set_arrays(block: Block) -> dict[str, np.ndarray]:
    marks = {_SET + name: mask(members, len(block)).view(np.uint8) for name, members in block.sets.items()}
    return {**block.data, **marks}


def _of_kinds(data: Mapping[str, np.ndarray], kinds: str) -> dict[str, np.ndarray]:
    return {name: values for name, values in data.items() if np.asarray(values).dtype.kind in kinds}


def check_sizes(path: Path, grid: Grid, types: np.ndarray) -> None:
    """Raise a `FileError` that names the first cell whose number of nodes does not fit its type."""
    widths = np.diff(grid.start)
    expected = np.array([WIDTH_BY_TYPE.get(number, -1) for number in range(256)], np.int16)[types]
    wrong = np.flatnonzero((widths != expected) & (expected >= 0))
    if len(wrong):
        i = int(wrong[0])
        problem = f"cell {i} is of type {types[i]} and has {widths[i]} nodes: expected {expected[i]}"
        raise FileError(path, problem, "Write the file again with the program that made it.")


def _correct_types(path: Path, grid: Grid) -> tuple[np.ndarray, list[str]]:
    """Correct the types of cells by their numbers of nodes; returns types (c,) uint8 and notes."""
    given, widths, notes = np.asarray(grid.types), np.diff(grid.start), []
    outside = np.flatnonzero((given < 0) | (given > 255))
    if outside.size:
        problem = f"cell {outside[0]} is of type {given[outside[0]]}: expected one of VTK's types, 0 to 255"
        raise FileError(path, problem, "Write the file again with the program that made it.")
    types = given = given.astype(np.uint8)
    for number, others in _VARIABLE_WIDTH.items():
        for width, other in others.items():
            which = (given == number) & (widths == width)
            types = np.where(which, np.uint8(other), types) if which.any() else types
    tetra = given == TYPE_BY_KIND["tetra"]
    if tetra.any() and (widths[tetra] == 8).all():
        types = np.where(tetra, np.uint8(HEXAHEDRON), types)
        some = count_phrase(int(tetra.sum()), "cell of eight nodes is", "cells of eight nodes are")
        notes.append(f"{some} labelled as tetrahedra in the file: read as hexes.")
    return types, notes


def _merge_voxels(types: np.ndarray, blocks: list[Block]) -> list[Block]:
    """Merge hexahedra and voxels into one block, in the order of the file."""
    hexes = [block for block in blocks if block.kind == "hex"]
    if len(hexes) < 2:
        return blocks
    hex_types = [number for number in _distinct(types) if number in (VOXEL, HEXAHEDRON)]
    order = np.argsort(np.concatenate([np.flatnonzero(types == number) for number in hex_types]), kind="stable")
    merged = merge_blocks([replace(block, data=_with_set_arrays(block), sets={}) for block in hexes])
    data, sets = _split_sets({name: values[order] for name, values in merged.data.items()})
    merged = Block("hex", merged.nodes[order], data, sets)
    return [merged, *(block for block in blocks if block.kind != "hex")]


def _distinct(types: np.ndarray) -> list[int]:
    """Types that occur among those of cells, (c,) uint8, in the order of the first cell of each."""
    return sorted(np.unique(types).tolist(), key=lambda number: int(np.argmax(types == number)))


def _rows(grid: Grid, chosen: np.ndarray, width: int) -> np.ndarray:
    if len(chosen) == len(grid.types):
        return grid.nodes.reshape(-1, width)
    return np.asarray(grid.nodes, dtype=np.int64)[grid.start[chosen][:, None] + np.arange(width)]


def _select(values: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    return values if len(chosen) == len(values) else np.asarray(values)[chosen]


def _split_sets(data: Mapping[str, np.ndarray]) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Separate arrays that hold sets; returns the other arrays and the members of sets."""
    arrays, sets = {}, {}
    for name, values in data.items():
        if name.startswith(_SET) and np.ndim(values) == 1 and np.isin(values, (0, 1)).all():
            members = np.flatnonzero(values)
            if members.size:
                sets[name[len(_SET) :]] = members
        else:
            arrays[name] = values
    return arrays, sets
