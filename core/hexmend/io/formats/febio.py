"""Models of FEBio (.feb): nodes, elements, named parts, sets and surfaces; coordinates are replaced.

*FEBio User's Manual*, sections Geometry and Mesh, versions 1.2 to 4.0. The text is searched for the elements of XML
that define a mesh; all else stays as it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import unescape
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import node_count, to_mesh, to_vtk_order
from hexmend.io.base.cursor import quoted
from hexmend.io.base.format import Capability, register
from hexmend.io.coordinates.joined_files import JoinedFiles
from hexmend.io.formats.decks.coordinates import DeckCoordinates
from hexmend.io.formats.decks.lines import CardLines
from hexmend.io.formats.decks.model import DeckModel
from hexmend.mesh.mesh import Mesh

#: Kinds of cells by FEBio's names.
_KINDS = {
    "hex8": "hex", "hex20": "hex20", "hex27": "hex27", "penta6": "wedge", "penta15": "wedge15", "pyra5": "pyramid",
    "pyra13": "pyramid13", "tet4": "tetra", "tet10": "tetra10", "quad4": "quad", "quad8": "quad8", "quad9": "quad9",
    "tri3": "triangle", "tri6": "triangle6", "line2": "line", "truss2": "line",
}  # fmt: skip
#: VTK's order of nodes: vtk = febio[ORDER[kind]]; the faces of a hex are y-, x+, y+, x-, z-, z+.
_ORDER = {"hex27": [*range(20), 23, 21, 20, 22, 24, 25, 26]}
#: Sets of a model by the names of their elements of XML.
_SETS = {"NodeSet": "nodes", "ElementSet": "elements", "Surface": "faces"}
_SECTION = re.compile(
    rb"<(Nodes|Elements|NodeSet|ElementSet|Surface|DiscreteSet|contact)\b([^>]*)(?<!/)>(.*?)</\1\s*>", re.DOTALL
)
_ENTRY = re.compile(rb"<(\w+)\b([^>]*)>([^<>]*)</\1\s*>")
_COMMENT = re.compile(rb"<!--.*?-->", re.DOTALL)
_FIRST = re.compile(rb"\s*(?:<\?xml[^>]*>\s*)?(?:<!--.*?-->\s*)*<febio_spec", re.DOTALL)
_ID = re.compile(rb"\bid\s*=\s*[\"']\s*(\d{1,18})\s*[\"']")
_ELSEWHERE = re.compile(rb"<(?:Geometry|Mesh)\b[^>]*\bfrom\s*=\s*[\"']([^\"'>]*)")


def read(path: Path) -> Mesh:
    """Read nodes, elements and sets; the elements of a named part are a set.

    Raises
    ------
    FileError
        For malformed nodes or elements, and a mesh in another file.
    MeshError
        From `Mesh`.
    """
    files, model = JoinedFiles(path), DeckModel(path, "<Nodes>", "a model of FEBio")
    for number, (name, head, begin, body) in enumerate(_sections(files), 1):
        title = _attribute(head, "name") or _attribute(head, "elset")
        if name == "Nodes":
            ids, lines = _entries(files, name, begin, body)["node"]
            model.nodes.append((ids, lines.cards((1,) * 3).reals(0, 3)))
        elif name == "Elements":
            model.part_names[number] = title
            _read_elements(model, _entries(files, name, begin, body), _attribute(head, "type"), number)
        elif name == "Surface":
            for kind, (_, lines) in _entries(files, name, begin, body).items():
                if kind.startswith("quad"):
                    model.add_set("faces", title, lines.cards((1,) * 4).integers(0, 4))
        elif name in _SETS:
            words = _ID.findall(body) or re.findall(rb"\b\d{1,18}\b", re.sub(rb"<[^>]*>", b"", body))
            model.add_set(_SETS[name], title, np.array(words, dtype="S18").astype(np.int64))
        elif name == "contact":
            model.joining.append("contact")
        else:
            for _, lines in _entries(files, name, begin, body).values():
                model.fixed[name].append(lines.cards((1, 1)).integers(0, 2).ravel())
    return to_mesh(path, model.content(lambda number: model.part_names.get(number, "")))


def locate(path: Path) -> DeckCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    files = JoinedFiles(path)
    found = [_entries(files, name, begin, body) for name, _, begin, body in _sections(files) if name == "Nodes"]
    return DeckCoordinates.of_lines([entries["node"][1] for entries in found], (1,) * 3, 0)


def _sections(files: JoinedFiles) -> Iterator[tuple[str, bytes, int, bytes]]:
    """Yield the elements of XML that define a mesh: name, attributes, the offset of the content, and the content."""
    data = _COMMENT.sub(lambda found: b" " * len(found[0]), files.data)
    if elsewhere := _ELSEWHERE.search(data):
        problem = f"has its mesh in {quoted(elsewhere[1].decode('utf-8', 'replace'))}"
        raise FileError(files.root.path, problem, "Open that file.")
    for found in _SECTION.finditer(data):
        yield found[1].decode(), found[2], found.start(3), found[3]


def _entries(files: JoinedFiles, name: str, begin: int, body: bytes) -> dict[str, tuple[np.ndarray, CardLines]]:
    """Numbers, (k,) int64, and texts of the elements of XML in a section, by their names."""
    rows: dict[str, list[tuple[int, int, int]]] = {"node": []} if name == "Nodes" else {}
    for found in _ENTRY.finditer(body):
        number = _ID.search(found[2])
        row = int(number[1]) if number else 0, begin + found.start(3), begin + found.end(3)
        rows.setdefault(found[1].decode("latin-1"), []).append(row)
    tables = {kind: np.array(own, dtype=np.int64).reshape(-1, 3).T for kind, own in rows.items()}
    return {
        kind: (ids, CardLines(f"<{name}>", files, begin, first, last, None))
        for kind, (ids, first, last) in tables.items()
    }


def _read_elements(model: DeckModel, entries: dict[str, tuple[np.ndarray, CardLines]], type: str, part: int) -> None:
    """Add elements, whose kind is that of the section, or in version 1 that of each."""
    for name, (ids, lines) in entries.items():
        kind = _KINDS.get((type or name).lower())
        if kind is None:
            model.others[f"elements {type or name}"] += len(ids)
            model.fixed[type or name].append(
                np.array(re.findall(r"\d+", " ".join(lines.texts())), "S18").astype(np.int64)
            )
            continue
        width = node_count(kind)
        nodes = lines.cards((1,) * width).integers(0, width)
        model.add_elements(kind, lines.begin, ids, part, to_vtk_order(nodes, kind, _ORDER))


def _attribute(head: bytes, name: str) -> str:
    found = re.search(rb"\b%s\s*=\s*(?:\"([^\"]*)\"|'([^']*)')" % name.encode(), head)
    return unescape((found[1] or found[2] or b"").decode("utf-8", "replace")) if found else ""


register(
    name="febio",
    title="FEBio",
    suffixes=(".feb",),
    encodings=(),
    read=read,
    capabilities=frozenset(Capability) - {Capability.NODE_DATA, Capability.HEX_DATA, Capability.FIELD_DATA},
    matches=lambda head: _FIRST.match(head) is not None,
    locate=locate,
)
