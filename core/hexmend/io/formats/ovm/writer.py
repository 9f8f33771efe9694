"""Writing of OpenVolumeMesh's format in decimals: each edge and face once, and cells as lists of half-faces.

The half-faces of a hex come in pairs, z- and z+ before x- and x+, as in OpenVolumeMesh's own hexahedral meshes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import BinaryIO

import numpy as np

from hexmend.io.base.capabilities import altered_names, make_unique
from hexmend.io.base.content import from_mesh as content_of
from hexmend.io.base.decimals import format_rows, row_chunks
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.lower_order import lost_mid_nodes, reduce_order
from hexmend.io.base.numbering import runs
from hexmend.io.base.polyhedra import LOOPS, RaggedArray, check_distinct_nodes, faces_from_cells
from hexmend.io.formats.vtk.grid import from_content
from hexmend.mesh.mesh import Mesh

#: Kinds of cells that are written.
_KINDS = frozenset(LOOPS)


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write vertices, edges, faces, polyhedra and properties; mid-nodes are left out."""
    content = reduce_order(replace(content_of(mesh), node_data=with_marks(mesh)), _KINDS)
    check_distinct_nodes(path, content.blocks, "OpenVolumeMesh cannot store its faces")
    loops, halves = faces_from_cells([(block.kind, block.nodes) for block in content.blocks])
    edges, around = _edges(loops, len(content.points))
    grid = from_content(content)
    with open(path, "wb") as file:
        file.write(b"OVM ASCII\n")
        _write_rows(file, "Vertices", content.points)
        _write_rows(file, "Edges", edges)
        _write_lists(file, "Faces", around)
        _write_lists(file, "Polyhedra", halves)
        _write_properties(file, "VProp", grid.node_data)
        _write_properties(file, "CProp", grid.cell_data)


def limitations(mesh: Mesh) -> list[str]:
    """Describe data without a type of the format, names that are altered, and mid-nodes that are lost."""
    grid = from_content(replace(content_of(mesh), node_data=with_marks(mesh)))
    phrases = []
    for kind, data in (("point data", grid.node_data), ("cell data", grid.cell_data)):
        odd = sorted(name for name, values in data.items() if _type(np.asarray(values)) is None)
        phrases += [f"{kind} of more than 4 columns, or no numbers ({', '.join(odd)})"] if odd else []
        phrases += altered_names(_titles(data), f"{kind} and sets")
    return phrases + lost_mid_nodes(mesh, _KINDS)


def _edges(loops: np.ndarray, count: int) -> tuple[np.ndarray, RaggedArray]:
    """Nodes of the edges, (e, 2), and the half-edges of each face: 2 k, or 2 k + 1 for edge k reversed."""
    widths = (loops >= 0).sum(axis=1)
    inside = np.arange(4) < widths[:, None]
    begin = loops[inside]
    end = np.where(np.arange(1, 5) < widths[:, None], np.roll(loops, -1, axis=1), loops[:, :1])[inside]
    low, high = np.minimum(begin, end), np.maximum(begin, end)
    _, first, which = np.unique(low * count + high, return_index=True, return_inverse=True)
    number = np.argsort(np.argsort(first))[which]  # in the order of the faces
    pairs = np.column_stack([begin, end])[np.sort(first)]
    return pairs, RaggedArray(np.concatenate([[0], np.cumsum(widths)]), 2 * number + (pairs[number, 0] != begin))


def _write_rows(file: BinaryIO, name: str, rows: np.ndarray) -> None:
    file.write(f"{name}\n{len(rows)}\n".encode())
    for part in row_chunks(len(rows)):
        file.write(format_rows(rows[part]))


def _write_lists(file: BinaryIO, name: str, lists: RaggedArray) -> None:
    file.write(f"{name}\n{len(lists)}\n".encode())
    for part in runs(lists.lengths):
        rows = lists.values[lists.start[part.start] : lists.start[part.stop]].reshape(part.stop - part.start, -1)
        file.write(format_rows(np.column_stack([np.full(len(rows), rows.shape[1]), rows])))


def _write_properties(file: BinaryIO, entity: str, data: Mapping[str, np.ndarray]) -> None:
    titles = _titles(data)
    for name, values in data.items():
        array = np.asarray(values)
        kind = _type(array)
        if kind is not None:
            file.write(f'{entity} {kind} "{titles[name]}"\n'.encode("utf-8", "replace"))
            for part in row_chunks(len(array)):
                file.write(format_rows(array[part].astype(np.int64) if array.dtype.kind == "b" else array[part]))


def _type(values: np.ndarray) -> str | None:
    """Name of the type of an array in the format; None if there is none."""
    if values.dtype.kind not in "biuf" or values.ndim > 2 or (values.ndim == 2 and not 1 <= values.shape[1] <= 4):
        return None
    real, limit = values.dtype.kind == "f", np.iinfo(np.int32)
    small = real or not values.size or (values.min() >= limit.min and values.max() <= limit.max)
    if values.ndim == 2 and values.shape[1] > 1:
        return f"vec{values.shape[1]}{'d' if real else 'i'}" if small else None
    if real:
        return "double"
    return "int" if small else "long" if int(values.max()) <= np.iinfo(np.int64).max else None


def _titles(data: Mapping[str, np.ndarray]) -> dict[str, str]:
    """Names as they are written: between quotes, in one line."""

    def form(name: str, suffix: str) -> str:
        clean = "".join(letter if letter.isprintable() else " " for letter in name.replace('"', "'"))
        return (clean.strip() or "property") + suffix

    return make_unique(data, form)
