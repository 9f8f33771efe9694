"""Kratos's model parts (.mdpa): nodes, elements and conditions, whose properties are sets, and submodel parts."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import numbering
from hexmend.io.base.content import from_mesh, node_count, to_mesh
from hexmend.io.base.cursor import quoted, read_text_bytes
from hexmend.io.base.decimals import format_rows, parse_numbers
from hexmend.io.base.format import Capability, register
from hexmend.io.base.lower_order import lost_mid_nodes, reduce_order
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.formats.decks.model import DeckModel
from hexmend.mesh.mesh import Mesh

_BLOCK = re.compile(rb"^[ \t]*Begin[ \t]+(\w+)[ \t]*([^\n]*)\n(.*?)^[ \t]*End[ \t]+\1\b", re.MULTILINE | re.DOTALL)
_COMMENT = re.compile(rb"//[^\n]*")
_WIDTH = re.compile(rb"[23]D(\d+)")
#: Kinds of elements and conditions by their number of nodes.
_ELEMENTS = {8: "hex", 4: "tetra", 6: "wedge", 5: "pyramid"}
_CONDITIONS = {1: "vertex", 2: "line", 3: "triangle", 4: "quad"}
#: Kinds that are written.
_KINDS = {"hex": 8, "tetra": 4, "wedge": 6}


def read(path: Path) -> Mesh:
    """Read nodes, elements and conditions; those of properties N become the set "properties N".

    Raises
    ------
    FileError
        For a block that is malformed, or a node that does not exist.
    MeshError
        From `Mesh`.
    """
    text = _COMMENT.sub(b"", read_text_bytes(path).replace(b"\r\n", b"\n"))
    found = [(one[1].decode("latin-1"), one[2], one[3]) for one in _BLOCK.finditer(text)]
    model = DeckModel(path, "block of Nodes with its End", "a model part of Kratos")
    for name, title, body in found:
        width = _WIDTH.search(title)
        kind = {"Elements": _ELEMENTS, "Conditions": _CONDITIONS}.get(name, {}).get(int(width[1])) if width else None
        if name == "Nodes":
            table = _rows(path, name, body, 4, numbers=1)
            model.nodes.append((table[:, 0].astype(np.int64), np.ascontiguousarray(table[:, 1:])))
        elif kind is None:
            model.others[f"{name} {title.decode('latin-1').strip()}"] += 1
        else:
            n_numbers = 2 + node_count(kind)
            rows = _rows(path, name, body, n_numbers, numbers=n_numbers).astype(np.int64)
            model.add_elements(kind, np.zeros(len(rows)), *rows[:, :2].T, rows[:, 2:])
    model.given_nodes()
    if text.count(b"Begin ") != text.count(b"End "):
        raise FileError(path, "has a block without its End", DAMAGED)
    return to_mesh(path, model.content(lambda number: f"properties {number}" if number else ""))


def _rows(path: Path, name: str, body: bytes, width: int, numbers: int) -> np.ndarray:
    """Rows of the numbers of a block, (k, width) float64, of which the first columns are whole numbers."""
    values = parse_numbers(body, np.float64)
    if values is None or values.size % width or not np.isfinite(values).all():
        raise FileError(path, f"a block of {quoted(name)} holds no rows of {width} numbers", DAMAGED)
    rows = values.reshape(-1, width)
    if (np.abs(rows[:, :numbers]) > 2.0**62).any():
        raise FileError(path, f"a block of {quoted(name)} has numbers that are too large", DAMAGED)
    return rows


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write nodes and elements."""
    content = reduce_order(from_mesh(mesh), _KINDS)
    node_ids = numbering.node_ids(dict(content.node_data), len(content.points))
    with open(path, "wb") as file:
        file.write(b"Begin ModelPartData\nEnd ModelPartData\n\nBegin Properties 0\nEnd Properties\n\nBegin Nodes\n")
        for number, line in zip(node_ids.tolist(), format_rows(content.points).splitlines(True), strict=True):
            file.write(b"%d %s" % (number, line))
        file.write(b"End Nodes\n")
        for block, ids in zip(content.blocks, numbering.element_ids(content.blocks), strict=True):
            file.write(b"\nBegin Elements Element3D%dN\n" % _KINDS[block.kind])
            file.write(format_rows(np.column_stack([ids, np.zeros_like(ids), node_ids[block.nodes]])))
            file.write(b"End Elements\n")


register(
    name="kratos",
    title="Kratos",
    suffixes=(".mdpa",),
    encodings=("ascii",),
    read=read,
    write=write,
    capabilities=frozenset({Capability.IDS}),
    limitations=lambda mesh: numbering.unsupported_ids(mesh) + lost_mid_nodes(mesh, _KINDS),
    matches=lambda head: re.match(rb"\s*(?://[^\n]*\n\s*)*Begin \w", head) is not None,
)
