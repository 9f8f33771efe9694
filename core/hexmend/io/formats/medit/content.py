"""Sections of a Medit file, the same in decimals and binary, and their conversion to and from meshes."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.arrays import mask
from hexmend.errors import FileError
from hexmend.io.base.content import Block, Content, hex_blocks
from hexmend.io.base.content import from_mesh as content_of
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.fixed_marks import needs_marks
from hexmend.io.base.format import Capability
from hexmend.io.base.lower_order import lost_mid_nodes, reduce_order
from hexmend.io.base.numbering import first_out_of_range
from hexmend.io.base.remedies import some_names, unread_note
from hexmend.io.storage.binary_rows import gather_integers, row_blocks
from hexmend.mesh.mesh import Mesh


@dataclass(frozen=True)
class MeditSection:
    """Section of integers.

    Parameters
    ----------
    name : str
        Keyword in text files.
    code : int
        Code in binary files.
    width : int
        Integers a row: the nodes of a cell and its reference, or one number.
    """

    name: str
    code: int
    width: int


#: Sections that are read and written, in this order, except Vertices.
SECTIONS = {
    name: MeditSection(name, code, width) for name, code, width in (
        ("Edges", 5, 3), ("Triangles", 6, 4), ("Quadrilaterals", 7, 5), ("Tetrahedra", 8, 5), ("Prisms", 9, 7),
        ("Hexahedra", 10, 9), ("Pyramids", 49, 6), ("Corners", 13, 1), ("Ridges", 14, 1), ("RequiredVertices", 15, 1),
        ("RequiredEdges", 16, 1), ("RequiredTriangles", 17, 1), ("RequiredQuadrilaterals", 18, 1),
    )
}  # fmt: skip
#: Name of the data that hold references.
REF = "medit:ref"
_CELLS = {
    "Edges": "line", "Triangles": "triangle", "Quadrilaterals": "quad",
    "Tetrahedra": "tetra", "Prisms": "wedge", "Pyramids": "pyramid",
}  # fmt: skip
_KINDS = frozenset({"hex", *_CELLS.values()})
#: Sections that list cells, which become data of these cells: section, kind of cells, name of the data.
_FLAGS = (
    ("Ridges", "line", "medit:ridge"),
    ("RequiredEdges", "line", "medit:required"),
    ("RequiredTriangles", "triangle", "medit:required"),
    ("RequiredQuadrilaterals", "quad", "medit:required"),
)
_NODE_SETS = {"Corners": "corners", "RequiredVertices": "required"}


def to_mesh(
    path: Path, points: np.ndarray, refs: np.ndarray, sections: dict[str, np.ndarray], skipped: Collection[str] = ()
) -> Mesh:
    """Make a mesh of the sections of a file.

    Parameters
    ----------
    path : Path
    points : (n, 3) float64
    refs : (n,) int
        References of the nodes.
    sections : mapping of keyword to (rows, width) int array
        Nodes and cells are numbered from 1.
    skipped : collection of str
        Other sections, which are not read; a note names them.

    Returns
    -------
    Mesh

    Raises
    ------
    FileError
        For numbers of nodes or cells that do not exist.
    """
    flags = {(kind, flag): sections[name][:, 0] - 1 for name, kind, flag in _FLAGS if name in sections}
    blocks = []
    for name, kind in _CELLS.items():
        if len(sections.get(name, ())):
            rows = sections[name]
            data = {REF: rows[:, -1].copy()}
            for (flagged, flag), members in flags.items():
                if flagged == kind:
                    data[flag] = _mask(path, flag, members, len(rows)).view(np.uint8)
            blocks.append(Block(kind, _from_zero(rows[:, :-1]), data))
    node_sets = {}
    for name, title in _NODE_SETS.items():
        if name in sections:
            members = sections[name][:, 0] - 1
            _mask(path, name, members, len(points))
            node_sets[title] = members
    pinned = None
    if "required" in node_sets:
        pinned = _mask(path, "RequiredVertices", node_sets["required"], len(points))
    hexes = sections.get("Hexahedra", np.empty((0, 9), np.int64))
    blocks.append(Block("hex", _from_zero(hexes[:, :8]), {REF: hexes[:, 8].copy()}))
    notes = (unread_note(f"sections ({some_names(dict.fromkeys(skipped))})"),) if skipped else ()
    content = Content(points, tuple(blocks), {REF: refs}, node_sets, pinned=pinned, notes=notes)
    return mesh_of(path, content)


def from_mesh(mesh: Mesh) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
    """Convert a mesh to the sections of a file; cells of second order keep their corners only.

    Returns
    -------
    points : (n, 3) float64
    refs : (n,) int64
        References of the nodes.
    sections : dict of keyword to (rows, width) int array
        Nodes and cells are numbered from 1.
    """
    content = reduce_order(content_of(mesh), _KINDS)
    order = np.argsort(np.concatenate([numbers for _, numbers in hex_blocks(mesh)]))  # back to the order of the mesh
    rows: dict[str, list[np.ndarray]] = {}
    for block in content.blocks:
        rows.setdefault(block.kind, []).append(_with_refs(block.nodes, block.data.get(REF)))
    sections = {name: np.concatenate(rows[kind]) for name, kind in _CELLS.items() if kind in rows}
    sections["Hexahedra"] = np.concatenate(rows.get("hex", [np.empty((0, 9), np.int64)]))[order]
    for name, title in _NODE_SETS.items():
        if title in content.node_sets:
            sections[name] = np.asarray(content.node_sets[title]).reshape(-1, 1) + 1
    required = np.zeros(mesh.n_nodes, bool)
    required[mesh.node_sets.get("required", [])] = True
    if needs_marks(mesh, required):  # changed since reading, or from another format
        sections["RequiredVertices"] = np.flatnonzero(content.pinned).reshape(-1, 1) + 1
    for name, kind, flag in _FLAGS:
        blocks = [block for block in content.blocks if block.kind == kind]
        marks = [np.asarray(block.data.get(flag, np.zeros(len(block)))) for block in blocks]
        if any(flag in block.data for block in blocks):
            sections[name] = np.flatnonzero(np.concatenate(marks)).reshape(-1, 1) + 1
    refs = np.asarray(content.node_data.get(REF, np.zeros(len(content.points))))
    kept = {name: rows for name, rows in sections.items() if len(rows) or name == "Hexahedra"}
    return content.points, refs.astype(np.int64), kept


#: Fields of `Format` that the decimal and the binary format have in common: only mid-nodes are lost besides.
DECLARATION = {
    "capabilities": frozenset({Capability.FIXED_NODES, Capability.LOWER_CELLS, Capability.OTHER_CELLS}),
    "stored_names": frozenset({REF, "corners", "required", *(flag for _, _, flag in _FLAGS)}),
    "limitations": lambda mesh: lost_mid_nodes(mesh, _KINDS),
}


def _from_zero(numbers: np.ndarray) -> np.ndarray:
    """Convert node numbers that count from 1 to numbers from 0, (k, width), in 32 bits where they fit."""
    parts = row_blocks(len(numbers), numbers.shape[1] * numbers.itemsize)
    return gather_integers(numbers.shape, ((part, numbers[part] - 1) for part in parts))


def _with_refs(nodes: np.ndarray, refs: np.ndarray | None) -> np.ndarray:
    refs = np.zeros(len(nodes), np.int64) if refs is None else np.asarray(refs).astype(np.int64)
    return np.column_stack([nodes.astype(np.int64) + 1, refs])


def _mask(path: Path, name: str, members: np.ndarray, length: int) -> np.ndarray:
    """Mark members in (length,) bool; `name` is their section, for errors."""
    outside = first_out_of_range(members, length)
    if outside is not None:
        raise FileError(
            path, f"{name} refer to {outside + 1}: expected numbers from 1 to {length}", "Correct the file."
        )
    return mask(members, length)
