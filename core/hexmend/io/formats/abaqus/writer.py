"""Writes Abaqus's and CalculiX's input files: nodes, elements by their types, sets and surfaces."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from hexmend.io.base.content import HEX_KINDS, Block, from_mesh
from hexmend.io.base.numbering import element_ids, node_ids, runs, unsupported_ids
from hexmend.io.base.unique_names import altered_names, make_unique
from hexmend.io.formats.abaqus.content import TYPE, TYPES
from hexmend.io.formats.abaqus.elements import ORDER, SIDE_OF_FACE, kind_of
from hexmend.io.formats.abaqus.elements import TYPES as DEFAULT_TYPES
from hexmend.mesh.mesh import Mesh

_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_\-]*\Z")
#: How many numbers a line may have.
_WIDTH = 16


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write nodes, elements by their types, sets and surfaces."""
    content = from_mesh(mesh)
    tags, numbers = node_ids(dict(content.node_data), len(content.points)), element_ids(content.blocks)
    types = mesh.field_data.get(TYPES)
    types = types if isinstance(types, list | tuple) else []
    element_sets: dict[str, list[np.ndarray]] = {}
    with open(path, "w", encoding="utf-8") as file:
        file.write("*HEADING\nWritten by Hexmend\n*NODE\n")
        for tag, (x, y, z) in zip(tags.tolist(), content.points.tolist(), strict=True):
            file.write(f"{tag}, {x!r}, {y!r}, {z!r}\n")
        for block, own in zip(content.blocks, numbers, strict=True):
            rows = np.column_stack([own, tags[block.nodes]])
            if block.kind in ORDER:
                rows[:, 1:] = rows[:, 1:][:, np.argsort(ORDER[block.kind])]
            which = _types(block, types)
            for stretch in runs(which):
                file.write(f"*ELEMENT, TYPE={_type_named(block.kind, types, int(which[stretch.start]))}\n")
                file.writelines(_wrapped(row) for row in rows[stretch].tolist())
            for name, members in block.sets.items():
                element_sets.setdefault(name, []).append(own[members])
        for name, title in _titles(content.node_sets).items():
            file.write(f"*NSET, NSET={title}\n")
            file.write(_listed(tags[np.asarray(content.node_sets[name], np.int64)]))
        for name, title in _titles(element_sets).items():
            file.write(f"*ELSET, ELSET={title}\n")
            file.write(_listed(np.concatenate(element_sets[name])))
        hexes = [own for block, own in zip(content.blocks, numbers, strict=True) if block.kind in HEX_KINDS]
        for name, title in _titles(content.side_sets).items():
            file.write(f"*SURFACE, NAME={title}, TYPE=ELEMENT\n")
            for hexa, face in np.asarray(content.side_sets[name]).tolist():
                file.write(f"{np.concatenate(hexes)[hexa]}, {SIDE_OF_FACE[face]}\n")


def _types(block: Block, types: list[str]) -> np.ndarray:
    """The place of each element's type in the list; -1 where it is not known."""
    which = np.asarray(block.data.get(TYPE, np.full(len(block), -1)))
    right = np.array([kind_of(name) == block.kind for name in types] + [False])
    if which.dtype.kind not in "iu" or which.shape != (len(block),):
        return np.full(len(block), -1)
    which = np.where((which < 0) | (which >= len(types)), len(types), which)
    return np.where(right[which], which, -1)


def _type_named(kind: str, types: list[str], place: int) -> str:
    return types[place] if place >= 0 else DEFAULT_TYPES[kind]


def limitations(mesh: Mesh) -> list[str]:
    """Ids that are none here, and names with quotation marks, in words."""
    cells = [name for one in mesh.cells for name in one.sets]
    kinds = (mesh.node_sets, [*mesh.hex_sets, *cells], mesh.side_sets)
    titles = {name: title for names in kinds for name, title in make_unique(names, _clean).items()}
    return unsupported_ids(mesh) + altered_names(titles)


def _titles(sets: Iterable[str]) -> dict[str, str]:
    """Names as they are written: quoted unless they are plain words that differ in more than capitals."""
    titles = make_unique(sets, _clean)
    upper = Counter(title.upper() for title in titles.values())
    return {
        name: title if _PLAIN.match(title) and upper[title.upper()] == 1 else f'"{title}"'
        for name, title in titles.items()
    }


def _clean(name: str, end: str) -> str:
    return " ".join(name.replace('"', "'").split()) + end


def _wrapped(row: list[int]) -> str:
    """A line, or several of which all but the last end with a comma."""
    parts = [row[k : k + _WIDTH] for k in range(0, len(row), _WIDTH)]
    return ",\n".join(", ".join(map(str, part)) for part in parts) + "\n"


def _listed(numbers: np.ndarray) -> str:
    values = numbers.tolist()
    return "".join(", ".join(map(str, values[k : k + _WIDTH])) + "\n" for k in range(0, len(values), _WIDTH))
