"""What files hold beside points and hexes, in the terms of VTK: data, sets as arrays, cells of lower dimension."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.hexahedron import VOXEL_ORDER
from hexmend.mesh import Cells, Mesh, check_node_numbers

HEXAHEDRON, VOXEL = 12, 11

#: VTK's number of each cell of lower dimension that is carried: its kind and nodes.
LOWER = {1: ("vertex", 1), 3: ("line", 2), 5: ("triangle", 3), 9: ("quad", 4)}

#: Nodes of every cell type whose number of nodes is fixed, and its name for messages.
NAMES = {
    0: "VTK_EMPTY_CELL", 2: "VTK_POLY_VERTEX", 4: "VTK_POLY_LINE", 6: "VTK_TRIANGLE_STRIP", 7: "VTK_POLYGON",
    8: "VTK_PIXEL", 10: "VTK_TETRA", 13: "VTK_WEDGE", 14: "VTK_PYRAMID", 15: "VTK_PENTAGONAL_PRISM",
    16: "VTK_HEXAGONAL_PRISM", 21: "VTK_QUADRATIC_EDGE", 22: "VTK_QUADRATIC_TRIANGLE", 23: "VTK_QUADRATIC_QUAD",
    24: "VTK_QUADRATIC_TETRA", 25: "VTK_QUADRATIC_HEXAHEDRON", 26: "VTK_QUADRATIC_WEDGE", 27: "VTK_QUADRATIC_PYRAMID",
    29: "VTK_TRIQUADRATIC_HEXAHEDRON", 42: "VTK_POLYHEDRON", 72: "VTK_LAGRANGE_HEXAHEDRON",
}  # fmt: skip

_SET = "set:"
_FIXED = "fixed"


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
    """

    points: np.ndarray
    types: np.ndarray
    start: np.ndarray
    nodes: np.ndarray
    node_data: Mapping[str, np.ndarray]
    cell_data: Mapping[str, np.ndarray]


def to_mesh(path: Path, grid: Grid) -> Mesh:
    """The mesh that a grid holds.

    Raises
    ------
    FileError
        For cells that are neither hexahedra nor of lower dimension, or none that are hexahedra.
    MeshError
        From `Mesh`.
    """
    types = np.asarray(grid.types)
    known = np.isin(types, [HEXAHEDRON, VOXEL, *LOWER])
    if not known.all():
        first, others = int(np.flatnonzero(~known)[0]), int(np.count_nonzero(~known))
        name = NAMES.get(int(types[first]), f"cell of type {types[first]}")
        which = "the cell" if others == 1 else f"the {others} other cells"
        raise FileError(
            path, f"cell {first} is a {name}; Hexmend reads hexahedra (types 11, 12)", f"Convert or remove {which}."
        )
    is_hex = (types == HEXAHEDRON) | (types == VOXEL)
    if not is_hex.any():
        raise FileError(path, "holds no hexahedra (cell types 11, 12)", "Hexmend works on hexahedral meshes only.")
    check_sizes(path, grid)
    hexes = _rows(grid, np.flatnonzero(is_hex), 8)
    voxel = types[is_hex] == VOXEL
    hexes[voxel] = hexes[voxel][:, VOXEL_ORDER]
    lower = []
    for number, (kind, width) in LOWER.items():
        chosen = np.flatnonzero(types == number)
        if len(chosen):
            rows = _rows(grid, chosen, width)
            check_node_numbers(rows, len(grid.points))
            data = {name: values[chosen] for name, values in grid.cell_data.items()}
            lower.append(Cells(kind, rows.astype(np.int32), data))
    node_data, node_sets = _parted(grid.node_data)
    hex_data, hex_sets = _parted({name: values[is_hex] for name, values in grid.cell_data.items()})
    marks = [np.asarray(v) for k, v in node_data.items() if k.lower() == _FIXED and np.ndim(v) == 1]
    return Mesh(
        grid.points,
        hexes,
        pinned=marks[0] != 0 if marks else None,
        node_data=node_data,
        hex_data=hex_data,
        node_sets=node_sets,
        hex_sets=hex_sets,
        cells=tuple(lower),
    )


def from_mesh(mesh: Mesh) -> Grid:
    """The grid that holds a mesh: hexahedra first, cells of lower dimension after them."""
    number = {kind: key for key, (kind, _) in LOWER.items()}
    blocks = [(HEXAHEDRON, mesh.hexes), *((number[cells.kind], cells.nodes) for cells in mesh.cells)]
    types = np.concatenate([np.full(len(rows), kind, np.uint8) for kind, rows in blocks])
    widths = np.concatenate([np.full(len(rows), rows.shape[1], np.int64) for _, rows in blocks])
    node_data = dict(mesh.node_data)
    if mesh.pinned is not None:
        name = next((name for name in node_data if name.lower() == _FIXED), _FIXED)
        if name not in node_data or not np.array_equal(np.asarray(node_data[name]) != 0, mesh.pinned):
            node_data[name] = mesh.pinned.astype(np.int32)  # what the file said, unless the pins have changed since
    for name, members in mesh.node_sets.items():
        node_data[_SET + name] = _mask(members, mesh.n_nodes)
    hex_data = dict(mesh.hex_data) | {_SET + k: _mask(v, mesh.n_hexes) for k, v in mesh.hex_sets.items()}
    return Grid(
        points=mesh.points,
        types=types,
        start=np.concatenate([[0], np.cumsum(widths)]),
        nodes=np.concatenate([rows.ravel() for _, rows in blocks]),
        node_data=node_data,
        cell_data=_joined([hex_data, *(dict(cells.data) for cells in mesh.cells)], [len(rows) for _, rows in blocks]),
    )


def check_sizes(path: Path, grid: Grid) -> None:
    """Raise `FileError` naming the first cell whose number of nodes is not that of its type."""
    widths = np.diff(grid.start)
    expected = np.zeros(256, np.int64)
    expected[[HEXAHEDRON, VOXEL]] = 8
    for number, (_, width) in LOWER.items():
        expected[number] = width
    wrong = np.flatnonzero(widths != expected[np.asarray(grid.types)])
    if len(wrong):
        i = int(wrong[0])
        raise FileError(
            path,
            f"cell {i} is of type {grid.types[i]} and has {widths[i]} nodes: expected {expected[grid.types[i]]}",
            "Write the file again with the program that made it.",
        )


def _rows(grid: Grid, chosen: np.ndarray, width: int) -> np.ndarray:
    if len(chosen) == len(grid.types):
        return np.array(grid.nodes, dtype=np.int64).reshape(-1, width)
    return np.asarray(grid.nodes, dtype=np.int64)[grid.start[chosen][:, None] + np.arange(width)]


def _parted(data: Mapping[str, np.ndarray]) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Arrays, and the sets among them."""
    arrays, sets = {}, {}
    for name, values in data.items():
        if name.startswith(_SET) and np.ndim(values) == 1:
            sets[name[len(_SET) :]] = np.flatnonzero(values)
        else:
            arrays[name] = values
    return arrays, sets


def _mask(members: np.ndarray, length: int) -> np.ndarray:
    mask = np.zeros(length, np.uint8)
    mask[members] = 1
    return mask


def _joined(blocks: list[dict[str, np.ndarray]], lengths: list[int]) -> dict[str, np.ndarray]:
    """One array over all cells for each name; zeros where a block has none of that name."""
    joined = {}
    for name in dict.fromkeys(name for block in blocks for name in block):
        sample = next(np.asarray(block[name]) for block in blocks if name in block)
        parts = [
            np.asarray(block[name]) if name in block else np.zeros((length, *sample.shape[1:]), sample.dtype)
            for block, length in zip(blocks, lengths, strict=True)
        ]
        if all(part.shape[1:] == sample.shape[1:] for part in parts):
            joined[name] = np.concatenate(parts)
    return joined
