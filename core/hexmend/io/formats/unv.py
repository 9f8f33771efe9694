"""Universal files of I-deas (.unv): nodes, elements and groups of nodes and elements.

*Universal File Datasets*, Structural Dynamics Research Laboratory: 781 and 2411 (nodes), 2412 (elements), 2435, 2452,
2467 and 2477 (groups).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hexmend.io.base import numbering
from hexmend.io.base.capabilities import altered_set_names, make_unique
from hexmend.io.base.content import concatenate_sets, from_mesh, from_vtk_order, node_count, to_mesh, to_vtk_order
from hexmend.io.base.format import Capability, register
from hexmend.io.base.lower_order import lost_mid_nodes, reduce_order
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.coordinates.joined_files import JoinedFiles
from hexmend.io.formats.decks.coordinates import DeckCoordinates
from hexmend.io.formats.decks.lines import CardLines, line_ranges
from hexmend.io.formats.decks.model import DeckModel
from hexmend.mesh.mesh import Mesh

#: Line before and behind a dataset.
_MARK = re.compile(rb"^ {4}-1[ \t]*$", re.MULTILINE)
_NODES, _GROUPS = (781, 2411), (2435, 2452, 2467, 2477)
#: Kinds by FE descriptor, the one that is written last; beams have a further line before their nodes.
_KINDS = {
    21: "line", 11: "line", 24: "line3", 22: "line3", 41: "triangle", 91: "triangle", 42: "triangle6", 92: "triangle6",
    44: "quad", 94: "quad", 45: "quad8", 95: "quad8", 111: "tetra", 118: "tetra10", 112: "wedge", 113: "wedge15",
    115: "hex", 116: "hex20",
}  # fmt: skip
_DESCRIPTORS = {kind: number for number, kind in _KINDS.items()}
_BEAMS = (11, 21, 22, 23, 24)
#: VTK's order of nodes: vtk = unv[ORDER[kind]]; nodes follow each face around, corners and mid-nodes in turn.
_ORDER = {
    "line3": [0, 2, 1], "triangle6": [0, 2, 4, 1, 3, 5], "quad8": [0, 2, 4, 6, 1, 3, 5, 7],
    "tetra10": [0, 2, 4, 9, 1, 3, 5, 6, 7, 8], "wedge15": [0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8],
    "hex20": [0, 2, 4, 6, 12, 14, 16, 18, 1, 3, 5, 7, 13, 15, 17, 19, 8, 9, 10, 11],
}  # fmt: skip
_INTEGERS, _REALS = (10,) * 8, (25,) * 3
#: Types of members of a group, and letters of its name.
_NODE, _ELEMENT, _NAME = 7, 8, 40


def read(path: Path) -> Mesh:
    """Read nodes, elements and groups.

    Raises
    ------
    FileError
        For a malformed dataset.
    MeshError
        From `Mesh`.
    """
    model = DeckModel(path, "dataset 2411 of nodes", "a universal file")
    for number, lines in _datasets(path):
        if number in _NODES:
            ids = lines.rows(slice(None, None, 2)).cards(_INTEGERS).integers(0, 1)[:, 0]
            model.nodes.append((ids, lines.rows(slice(1, None, 2)).cards(_REALS).reals(0, 3)[: len(ids)]))
            if len(lines.begin) % 2:
                raise lines.error("ends within a node", DAMAGED)
        elif number == 2412:
            _read_elements(model, lines)
        elif number in _GROUPS:
            _read_groups(model, lines)
        elif number not in (151, 164, 2420):
            model.others[lines.name] += 1
    return to_mesh(path, model.content())


def locate(path: Path) -> DeckCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    nodes = [lines.rows(slice(1, None, 2)) for number, lines in _datasets(path) if number in _NODES]
    return DeckCoordinates.of_lines(nodes, _REALS, 0)


def _datasets(path: Path) -> Iterator[tuple[int, CardLines]]:
    """Yield the number and the lines of each dataset."""
    files = JoinedFiles(path)
    marks = [found.span() for found in _MARK.finditer(files.data)]
    for (_, begin), (end, _) in zip(marks[::2], marks[1::2], strict=False):
        begins, ends = line_ranges(files.data, begin + 1, end)
        number = files.data[begins[0] : ends[0]].strip() if len(ends) else b""
        lines = CardLines(f"dataset {number[:20].decode('latin-1')}", files, begin + 1, begins[1:], ends[1:])
        yield int(number) if number.isdigit() and len(number) < 9 else 0, lines


def _read_elements(model: DeckModel, lines: CardLines) -> None:
    numbers, at, heads = lines.cards(_INTEGERS).integers(0, 8), 0, []
    counts, beams = numbers[:, 5].tolist(), np.isin(numbers[:, 1], _BEAMS).tolist()
    while at < len(numbers):
        heads.append(at)
        at += 1 + beams[at] + max(1, -(-counts[at] // 8))
    if at != len(numbers):
        raise lines.error("ends within an element", DAMAGED)
    rows = np.array(heads, np.int64)
    for descriptor in dict.fromkeys(numbers[rows, 1].tolist()):
        own, kind = rows[numbers[rows, 1] == descriptor], _KINDS.get(descriptor, "")
        width = node_count(kind) if kind else int(numbers[own, 5].max())
        first = own + 1 + (descriptor in _BEAMS)
        places = np.minimum(first[:, None] + np.arange(-(-width // 8)), len(numbers) - 1)
        nodes = numbers[places].reshape(len(own), -1)[:, :width]
        if not kind:
            model.others[f"elements of FE descriptor {descriptor}"] += len(own)
            model.fixed[f"elements of FE descriptor {descriptor}"].append(nodes.ravel())
            continue
        if (numbers[own, 5] != width).any():
            raise lines.error(f"has elements of FE descriptor {descriptor} without {width} nodes", DAMAGED)
        ids, parts = numbers[own, 0], numbers[own, 2]
        model.add_elements(kind, own, ids, parts, to_vtk_order(nodes, kind, _ORDER))


def _read_groups(model: DeckModel, lines: CardLines) -> None:
    """Read groups: a line of numbers, the last of which counts the members, a name, and two members a line."""
    names, at = lines.texts(), 0
    while at + 1 < len(names):
        count = int(lines.rows(slice(at, at + 1)).cards(_INTEGERS).integers(7, 8)[0, 0])
        after = at + 2 + (count + 1) // 2
        members = lines.rows(slice(at + 2, after)).cards(_INTEGERS).integers(0, 8).reshape(-1, 4)[:count]
        for kind, code in (("nodes", _NODE), ("elements", _ELEMENT)):
            if (own := members[members[:, 0] == code, 1]).size:
                model.add_set(kind, names[at + 1], own)
        at = after


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write nodes, elements, and sets as groups."""
    content = reduce_order(from_mesh(mesh), _DESCRIPTORS)
    node_ids = numbering.node_ids(dict(content.node_data), len(content.points))
    element_ids = numbering.element_ids(content.blocks)
    every = np.concatenate(element_ids)
    sets = concatenate_sets([block.sets for block in content.blocks], [len(block) for block in content.blocks])
    groups = [(_NODE, name, node_ids[np.asarray(nodes)]) for name, nodes in content.node_sets.items()]
    groups += [(_ELEMENT, name, every[members]) for name, members in sets.items()]
    titles = {name: make_unique(names, _clean) for name, names in ((_NODE, content.node_sets), (_ELEMENT, sets))}
    with open(path, "w", encoding="utf-8") as file:
        file.write("    -1\n  2411\n")
        for number, (x, y, z) in zip(node_ids.tolist(), content.points.tolist(), strict=True):
            file.write(f"{_line([number, 1, 1, 11])}{x:25.16E}{y:25.16E}{z:25.16E}\n")
        file.write("    -1\n    -1\n  2412\n")
        for block, ids in zip(content.blocks, element_ids, strict=True):
            descriptor, beam = _DESCRIPTORS[block.kind], ""
            if descriptor in _BEAMS:
                beam = _line([0, 1, 1])
            nodes = from_vtk_order(node_ids[block.nodes], block.kind, _ORDER).tolist()
            for number, row in zip(ids.tolist(), nodes, strict=True):
                file.write(_line([number, descriptor, 1, 1, 7, len(row)]) + beam + _line(row))
        file.write("    -1\n")
        if groups:
            file.write("    -1\n  2467\n")
            for number, (code, name, members) in enumerate(groups, 1):
                file.write(f"{_line([number, 0, 0, 0, 0, 0, 0, len(members)])}{titles[code][name]}\n")
                file.write(_line([entry for one in members.tolist() for entry in (code, one, 0, 0)]))
            file.write("    -1\n")


def _line(numbers: list[int]) -> str:
    """Lines of up to eight numbers in 10 columns each."""
    return "".join("".join(f"{one:10d}" for one in numbers[k : k + 8]) + "\n" for k in range(0, len(numbers), 8))


def _clean(name: str, end: str) -> str:
    return (" ".join(name.split())[: _NAME - len(end)] or "unnamed") + end


register(
    name="unv",
    title="I-deas universal",
    suffixes=(".unv",),
    encodings=("ascii",),
    read=read,
    write=write,
    capabilities=frozenset({
        Capability.IDS, Capability.NODE_SETS, Capability.HEX_SETS, Capability.CELL_SETS, Capability.LOWER_CELLS,
    }),
    limitations=lambda mesh: (
        numbering.unsupported_ids(mesh) + altered_set_names(mesh, _clean) + lost_mid_nodes(mesh, _DESCRIPTORS)
    ),
    matches=lambda head: re.match(rb"\s*-1\s+(?:151|15|164|2411|2412|2420|781)\b", head) is not None,
    locate=locate,
)  # fmt: skip
