"""SU2's format (.su2): zones of elements with VTK's type numbers, and markers of boundary faces."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hexmend.io.base.capabilities import altered_names, make_unique
from hexmend.io.base.content import HEX_KINDS, Block, Content, dimension, from_mesh, node_count
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.cursor import ByteCursor, quoted, read_text_bytes
from hexmend.io.base.decimals import format_rows, row_chunks
from hexmend.io.base.format import Capability, register
from hexmend.io.base.lower_order import lost_mid_nodes, reduce_order
from hexmend.io.base.numbering import first_out_of_range
from hexmend.io.base.remedies import check_suffix
from hexmend.io.coordinates.text_coordinates import TextCoordinates, blanked, fields_of_words, word_ranges
from hexmend.mesh.mesh import Mesh

#: Kinds of elements by type number; the format has no others.
KIND_BY_TYPE = {3: "line", 5: "triangle", 9: "quad", 10: "tetra", 12: "hex", 13: "wedge", 14: "pyramid"}
TYPE_BY_KIND = {kind: number for number, kind in KIND_BY_TYPE.items()}
_KEY = re.compile(rb"^[ \t]*([A-Za-z_]+)[ \t]*=[ \t]*([^\n]*)", re.MULTILINE)
_COMMENT = re.compile(rb"%[^\n]*")


@dataclass(eq=False)
class _Zone:
    points: np.ndarray | None = None
    place: tuple[int, int] = (0, 0)  # byte range of the points
    cells: dict[str, np.ndarray] | None = None
    markers: list[tuple[str, dict[str, np.ndarray]]] = field(default_factory=list)


def read(path: Path) -> Mesh:
    """Read all zones as one mesh; markers are sets of boundary cells."""
    cursor = ByteCursor(path, blanked(read_text_bytes(path), b"%"))
    return mesh_of(path, _merge_zones(cursor, _zones(cursor)))


def locate(path: Path) -> TextCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    data = read_text_bytes(path)
    cursor = ByteCursor(path, blanked(data, b"%"))
    points, first, last = [], [], []
    for zone in _zones(cursor):
        points.append(zone.points)
        for ranges, found in zip((first, last), word_ranges(cursor.data, *zone.place), strict=True):
            ranges.append(found.reshape(len(zone.points), -1)[:, :3])
    return TextCoordinates(data, np.concatenate(points), fields_of_words(np.concatenate(first), np.concatenate(last)))


def _zones(cursor: ByteCursor) -> list[_Zone]:
    keys = list(_KEY.finditer(cursor.data))
    zones = [_Zone()]
    announced, tag = 1, ""
    for k, found in enumerate(keys):
        key, value = found[1].decode().upper(), found[2].decode("utf-8", errors="replace").strip()
        cursor.pos = min(found.end() + 1, len(cursor.data))
        end = keys[k + 1].start() if k + 1 < len(keys) else len(cursor.data)
        if key == "NZONE":
            announced = cursor.parse_count(value, "NZONE")
        elif key == "IZONE":
            if zones[-1].points is not None or zones[-1].cells is not None:
                zones.append(_Zone())
        elif key == "NDIME":
            if value != "3":
                raise cursor.error(f"NDIME is {quoted(value)}: expected 3", "Hexmend needs a three-dimensional mesh.")
        elif key == "NELEM":
            zones[-1].cells = _read_cells(cursor, end, cursor.parse_count(value, "NELEM"), "NELEM")
        elif key == "NPOIN":
            zones[-1].place = cursor.pos, end
            zones[-1].points = _read_points(cursor, end, cursor.parse_count((value.split() or [""])[0], "NPOIN"))
        elif key == "MARKER_TAG":
            tag = value
        elif key == "MARKER_ELEMS":
            count = cursor.parse_count(value, "MARKER_ELEMS")
            zones[-1].markers.append((tag, _read_cells(cursor, end, count, quoted(tag))))
    if zones[0].points is None and zones[0].cells is None:
        raise cursor.error("has neither NELEM= nor NPOIN=", check_suffix("an SU2 file"))
    if len(zones) != announced:
        raise cursor.error(f"holds {len(zones)} zones: expected {announced} as NZONE says")
    return zones


def _merge_zones(cursor: ByteCursor, zones: list[_Zone]) -> Content:
    """Concatenate zones; their elements are sets if there are several."""
    rows: dict[str, list[np.ndarray]] = {}
    sets: dict[str, dict[str, list[np.ndarray]]] = {}
    count = 0

    def add(kind: str, nodes: np.ndarray, name: str) -> None:
        first = sum(map(len, rows.setdefault(kind, [])))
        rows[kind].append(nodes + count)
        if name and len(nodes):
            sets.setdefault(kind, {}).setdefault(name, []).append(np.arange(first, first + len(nodes)))

    for k, zone in enumerate(zones):
        if zone.points is None or zone.cells is None:
            raise cursor.error(f"zone {k + 1} has no {'NPOIN' if zone.points is None else 'NELEM'}=")
        for cells in (zone.cells, *(cells for _, cells in zone.markers)):
            for nodes in cells.values():
                outside = first_out_of_range(nodes, len(zone.points))
                if outside is not None:
                    problem = f"an element of zone {k + 1} refers to node {outside}"
                    raise cursor.error(f"{problem}: expected numbers from 0 to {len(zone.points) - 1}")
        for kind, nodes in zone.cells.items():
            add(kind, nodes, f"zone {k + 1}" if len(zones) > 1 else "")
        for tag, cells in zone.markers:
            for kind, nodes in cells.items():
                add(kind, nodes, tag)
        count += len(zone.points)
    note = f"{len(zones)} zones are read as one mesh; nodes where they meet are not joined."
    blocks = []
    for kind in sorted(rows, key=lambda kind: (kind not in HEX_KINDS, -dimension(kind))):
        named = {name: np.concatenate(members) for name, members in sets.get(kind, {}).items()}
        blocks.append(Block(kind, np.concatenate(rows[kind]), sets=named))
    points = np.concatenate([zone.points for zone in zones])
    return Content(points, tuple(blocks), notes=(note,) if len(zones) > 1 else ())


def _read_points(cursor: ByteCursor, end: int, count: int) -> np.ndarray:
    """Read coordinates, (count, 3) float64; an index may follow each node."""
    values = cursor.read_numbers_to("NPOIN", end, np.float64)
    for width in (3, 4):
        if values.size == count * width:
            return np.ascontiguousarray(values.reshape(count, width)[:, :3])
    raise cursor.error(f"NPOIN holds {values.size} numbers: expected 3 or 4 for each of {count} nodes")


def _read_cells(cursor: ByteCursor, end: int, count: int, name: str) -> dict[str, np.ndarray]:
    """Read elements, (k, width) nodes by kind; each is its type, its nodes and in some files an index."""
    values = cursor.read_numbers_to(name, end, np.int64)
    for indices in (0, 1):
        starts, at, view = [], 0, memoryview(values)
        while at < values.size and view[at] in KIND_BY_TYPE and len(starts) < count:
            starts.append(at)
            at += 1 + node_count(KIND_BY_TYPE[view[at]]) + indices
        if len(starts) == count and at == values.size:
            begins, found = np.array(starts, np.int64), {}
            for number in np.unique(values[begins]).tolist():
                own, kind = begins[values[begins] == number], KIND_BY_TYPE[number]
                found[kind] = values[own[:, None] + np.arange(1, 1 + node_count(kind))]
            return found
    types = ", ".join(map(str, KIND_BY_TYPE))
    raise cursor.error(f"{name} holds {values.size} numbers, which are not {count} elements of the types {types}")


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write one zone; sets of quads and triangles are its markers.

    Other sets, other cells and mid-nodes are left out.
    """
    content = reduce_order(from_mesh(mesh), TYPE_BY_KIND)
    titles = _titles(content)
    volumes = [block for block in content.blocks if dimension(block.kind) == 3]
    markers: dict[str, list[tuple[str, np.ndarray]]] = {}
    for block in content.blocks:
        if block.kind in ("triangle", "quad"):
            for name, members in block.sets.items():
                markers.setdefault(titles[name], []).append((block.kind, block.nodes[members]))
    with open(path, "wb") as file:
        file.write(b"NDIME= 3\nNELEM= %d\n" % sum(map(len, volumes)))
        for block in volumes:
            _write_cells(file, block.kind, block.nodes)
        file.write(b"NPOIN= %d\n" % len(content.points))
        for part in row_chunks(len(content.points)):
            file.write(format_rows(content.points[part]))
        file.write(b"NMARK= %d\n" % len(markers))
        for name, groups in markers.items():
            count = sum(len(nodes) for _, nodes in groups)
            file.write(f"MARKER_TAG= {name}\nMARKER_ELEMS= {count}\n".encode())
            for kind, nodes in groups:
                _write_cells(file, kind, nodes)


def limitations(mesh: Mesh) -> list[str]:
    """Describe names of markers that are altered, and mid-nodes that are lost."""
    return altered_names(_titles(reduce_order(from_mesh(mesh), TYPE_BY_KIND))) + lost_mid_nodes(mesh, TYPE_BY_KIND)


def _titles(content: Content) -> dict[str, str]:
    """Names of markers as they are written: without white space and %, which begins a comment."""

    def form(name: str, suffix: str) -> str:
        return "_".join((name.replace("%", " ") + suffix).split()) or "unnamed"

    boundary = [block for block in content.blocks if block.kind in ("triangle", "quad")]
    return make_unique((name for block in boundary for name in block.sets), form)


def _write_cells(file: object, kind: str, nodes: np.ndarray) -> None:
    file.write(format_rows(np.column_stack([np.full(len(nodes), TYPE_BY_KIND[kind]), nodes])))


def _matches(head: bytes) -> bool:
    first = _KEY.search(_COMMENT.sub(b"", head))
    if first is None or first[1].upper() not in (b"NDIME", b"NZONE", b"IZONE", b"NELEM"):
        return False
    return head.lstrip().startswith(b"%") or not head[: first.start()].strip(b" \t\r\n")


register(
    name="su2",
    title="SU2",
    suffixes=(".su2",),
    encodings=("ascii",),
    read=read,
    write=write,
    capabilities=frozenset({Capability.CELL_SETS, Capability.OTHER_CELLS}),
    limitations=limitations,
    matches=_matches,
    locate=locate,
)
