"""Writer of Abaqus and CalculiX input files: nodes, elements by type, sets and surfaces."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import TextIO

import numpy as np

from hexmend.io.base import numbering
from hexmend.io.base.capabilities import altered_set_names, make_unique
from hexmend.io.base.content import HEX_KINDS, Block, Content, concatenate_sets, from_mesh, from_vtk_order
from hexmend.io.formats.abaqus.content import TYPE, TYPES
from hexmend.io.formats.abaqus.elements import DEFAULT_TYPES, ORDER, SIDE_OF_FACE, kind_of
from hexmend.mesh.mesh import Mesh

#: Names that need no quotes.
_LABEL = re.compile(r"[A-Za-z_][A-Za-z0-9_\-]*\Z")
#: Numbers that a data line may hold.
_LINE_LENGTH = 16


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write nodes, elements by type, sets and surfaces.

    Elements have the type that they were read with, else the default of their kind.
    """
    content = from_mesh(mesh)
    node_ids = numbering.node_ids(dict(content.node_data), len(content.points))
    element_ids = numbering.element_ids(content.blocks)
    with open(path, "w", encoding="utf-8") as file:
        file.write("*HEADING\nWritten by Hexmend\n*NODE\n")
        for node_id, (x, y, z) in zip(node_ids.tolist(), content.points.tolist(), strict=True):
            file.write(f"{node_id}, {x!r}, {y!r}, {z!r}\n")
        _write_elements(file, content, node_ids, element_ids)
        _write_sets(file, content, node_ids, element_ids)
        _write_surfaces(file, content, element_ids)


def _write_elements(file: TextIO, content: Content, node_ids: np.ndarray, element_ids: list[np.ndarray]) -> None:
    types = content.field_data.get(TYPES)
    types = types if isinstance(types, list | tuple) else []
    for block, ids in zip(content.blocks, element_ids, strict=True):
        rows = np.column_stack([ids, from_vtk_order(node_ids[block.nodes], block.kind, ORDER)])
        which = _type_indices(block, types)
        for run in numbering.runs(which):
            index = int(which[run.start])
            file.write(f"*ELEMENT, TYPE={types[index] if index >= 0 else DEFAULT_TYPES[block.kind]}\n")
            file.writelines(",\n".join(_lines(row)) + "\n" for row in rows[run].tolist())


def _write_sets(file: TextIO, content: Content, node_ids: np.ndarray, element_ids: list[np.ndarray]) -> None:
    element_sets = concatenate_sets([block.sets for block in content.blocks], [len(block) for block in content.blocks])
    for name, title in _titles(content.node_sets).items():
        file.write(f"*NSET, NSET={title}\n")
        file.write(_set_lines(node_ids[np.asarray(content.node_sets[name], np.int64)]))
    for name, title in _titles(element_sets).items():
        file.write(f"*ELSET, ELSET={title}\n")
        file.write(_set_lines(np.concatenate(element_ids)[element_sets[name]]))


def _write_surfaces(file: TextIO, content: Content, element_ids: list[np.ndarray]) -> None:
    blocks = zip(content.blocks, element_ids, strict=True)
    hex_ids = np.concatenate([np.empty(0, np.int64), *(ids for block, ids in blocks if block.kind in HEX_KINDS)])
    for name, title in _titles(content.side_sets).items():
        file.write(f"*SURFACE, NAME={title}, TYPE=ELEMENT\n")
        for hexa, face in np.asarray(content.side_sets[name]).tolist():
            file.write(f"{hex_ids[hexa]}, {SIDE_OF_FACE[face]}\n")


def _type_indices(block: Block, types: list[str]) -> np.ndarray:
    """Index of each element's type in the list, (k,) int; -1 where it is unknown or of another kind."""
    which = np.asarray(block.data.get(TYPE, np.full(len(block), -1)))
    fits = np.array([kind_of(name) == block.kind for name in types] + [False])
    if which.dtype.kind not in "iu" or which.shape != (len(block),):
        return np.full(len(block), -1)
    which = np.where((which < 0) | (which >= len(types)), len(types), which)
    return np.where(fits[which], which, -1)


def limitations(mesh: Mesh) -> list[str]:
    """List the ids and names of a mesh that a file cannot hold, in words."""
    return numbering.unsupported_ids(mesh) + altered_set_names(mesh, _clean)


def _titles(sets: Iterable[str]) -> dict[str, str]:
    """Names as the file has them: quoted where they are no labels, or differ only in upper and lower case."""
    titles = make_unique(sets, _clean)
    upper = Counter(title.upper() for title in titles.values())
    labels = {title for title in titles.values() if _LABEL.match(title) and upper[title.upper()] == 1}
    return {name: title if title in labels else f'"{title}"' for name, title in titles.items()}


def _clean(name: str, end: str) -> str:
    """Name without double quotes, with single spaces, and with an end."""
    return " ".join(name.replace('"', "'").split()) + end


def _set_lines(numbers: np.ndarray) -> str:
    """Data lines of a set."""
    return "".join(line + "\n" for line in _lines(numbers.tolist()))


def _lines(values: list[int]) -> list[str]:
    return [", ".join(map(str, values[k : k + _LINE_LENGTH])) for k in range(0, len(values), _LINE_LENGTH)]
