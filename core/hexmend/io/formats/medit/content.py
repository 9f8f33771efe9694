"""What a Medit file holds, whether in decimals or binary: its sections, and the mesh they make."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import Block, Content, hex_blocks
from hexmend.io.base.content import from_mesh as content_of
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.fixed_marks import needs_marks
from hexmend.io.base.format import Capability
from hexmend.io.base.lower_order import lost_mid_nodes, reduce_order
from hexmend.mesh.mesh import Mesh


@dataclass(frozen=True)
class MeditSection:
    """A section of the format: its keyword, its number in binary files, whole numbers a row, and what they are.

    `corners` is the number of nodes of a cell, followed by its reference; 0 for lists of numbers.
    """

    name: str
    code: int
    width: int
    corners: int = 0


#: Sections that are read and written, Vertices apart, in the order in which they are written.
SECTIONS = {
    section.name: section
    for section in (
        MeditSection("Edges", 5, 3, 2),
        MeditSection("Triangles", 6, 4, 3),
        MeditSection("Quadrilaterals", 7, 5, 4),
        MeditSection("Tetrahedra", 8, 5, 4),
        MeditSection("Prisms", 9, 7, 6),
        MeditSection("Hexahedra", 10, 9, 8),
        MeditSection("Pyramids", 49, 6, 5),
        MeditSection("Corners", 13, 1),
        MeditSection("Ridges", 14, 1),
        MeditSection("RequiredVertices", 15, 1),
        MeditSection("RequiredEdges", 16, 1),
        MeditSection("RequiredTriangles", 17, 1),
        MeditSection("RequiredQuadrilaterals", 18, 1),
    )
}
REF = "medit:ref"
_CELLS = {
    "Edges": "line", "Triangles": "triangle", "Quadrilaterals": "quad",
    "Tetrahedra": "tetra", "Prisms": "wedge", "Pyramids": "pyramid",
}  # fmt: skip
_KINDS = frozenset({"hex", *_CELLS.values()})
#: Lists of cells, as flags on these cells: section, kind of cell, name of the flag.
_FLAGS = (
    ("Ridges", "line", "medit:ridge"),
    ("RequiredEdges", "line", "medit:required"),
    ("RequiredTriangles", "triangle", "medit:required"),
    ("RequiredQuadrilaterals", "quad", "medit:required"),
)
#: What the format holds, and which names of data and sets.
CAPABILITIES = frozenset({Capability.FIXED_NODES, Capability.LOWER_CELLS, Capability.OTHER_CELLS})
STORED_NAMES = frozenset({REF, "corners", "required", *(flag for _, _, flag in _FLAGS)})
_NODE_SETS = {"Corners": "corners", "RequiredVertices": "required"}


def to_mesh(path: Path, points: np.ndarray, refs: np.ndarray, sections: dict[str, np.ndarray]) -> Mesh:
    """The mesh that a file's sections make.

    Parameters
    ----------
    path : Path
    points : (n, 3) float64
    refs : (n,) int
    sections : mapping of keyword to (rows, width) int array
        Numbers from 1, as the format counts.
    """
    flags = {(kind, flag): sections[name][:, 0] - 1 for name, kind, flag in _FLAGS if name in sections}
    blocks = []
    for name, kind in _CELLS.items():
        if len(sections.get(name, ())):
            rows = sections[name]
            data = {REF: rows[:, -1].copy()}
            for (of, flag), members in flags.items():
                if of == kind:
                    data[flag] = _mask(path, flag, members, len(rows))
            blocks.append(Block(kind, rows[:, :-1] - 1, data))
    node_sets = {}
    for name, title in _NODE_SETS.items():
        if name in sections:
            members = sections[name][:, 0] - 1
            _mask(path, name, members, len(points))
            node_sets[title] = members
    pinned = None
    if "required" in node_sets:
        pinned = _mask(path, "RequiredVertices", node_sets["required"], len(points)).astype(bool)
    hexes = sections.get("Hexahedra", np.empty((0, 9), np.int64))
    blocks.append(Block("hex", hexes[:, :8] - 1, {REF: hexes[:, 8].copy()}))
    content = Content(points, tuple(blocks), {REF: refs}, node_sets, pinned=pinned)
    return mesh_of(path, content)


def from_mesh(mesh: Mesh) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
    """Points (n, 3), their references (n,), and the sections by keyword, numbers from 1.

    Cells of second order are written with their corners, and nodes that no cell has any longer are left out.
    """
    content = reduce_order(content_of(mesh), _KINDS)
    order = np.argsort(np.concatenate([numbers for _, numbers in hex_blocks(mesh)]))  # which is that of the mesh
    rows: dict[str, list[np.ndarray]] = {}
    for block in content.blocks:
        rows.setdefault(block.kind, []).append(_with_refs(block.nodes, block.data.get(REF)))
    sections = {name: np.concatenate(rows[kind]) for name, kind in _CELLS.items() if kind in rows}
    sections["Hexahedra"] = np.concatenate(rows["hex"])[order]
    for name, title in _NODE_SETS.items():
        if title in content.node_sets:
            sections[name] = np.asarray(content.node_sets[title]).reshape(-1, 1) + 1
    required = np.zeros(mesh.n_nodes, bool)
    required[mesh.node_sets.get("required", [])] = True
    if needs_marks(mesh, required):  # changed since it was read, or read elsewhere
        sections["RequiredVertices"] = np.flatnonzero(content.pinned).reshape(-1, 1) + 1
    for name, kind, flag in _FLAGS:
        blocks = [block for block in content.blocks if block.kind == kind]
        marks = [np.asarray(block.data.get(flag, np.zeros(len(block)))) for block in blocks]
        if any(flag in block.data for block in blocks):
            sections[name] = np.flatnonzero(np.concatenate(marks)).reshape(-1, 1) + 1
    refs = np.asarray(content.node_data.get(REF, np.zeros(len(content.points))))
    kept = {name: rows for name, rows in sections.items() if len(rows) or name == "Hexahedra"}
    return content.points, refs.astype(np.int64), kept


def limitations(mesh: Mesh) -> list[str]:
    """Nodes of second order of cells beside hexes of first order, in words."""
    return lost_mid_nodes(mesh, _KINDS)


def _with_refs(nodes: np.ndarray, refs: np.ndarray | None) -> np.ndarray:
    refs = np.zeros(len(nodes), np.int64) if refs is None else np.asarray(refs).astype(np.int64)
    return np.column_stack([nodes.astype(np.int64) + 1, refs])


def _mask(path: Path, name: str, members: np.ndarray, length: int) -> np.ndarray:
    if len(members) and (members.min() < 0 or members.max() >= length):
        wrong = int(members[(members < 0) | (members >= length)][0]) + 1
        raise FileError(path, f"{name} names {wrong}: expected numbers from 1 to {length}", "Correct the file.")
    mask = np.zeros(length, np.uint8)
    mask[members] = 1
    return mask
