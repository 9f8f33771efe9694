"""Formats of surfaces: STL, Wavefront's OBJ, Stanford's PLY, and VTK's XML (.vtp) and legacy (.vtk).

OBJ and PLY are parsed by meshlane, which does not read all variants of STL. trimesh is not used: it splits quads,
misreads an OBJ face whose corners are written in several forms, such as `1/1/1 2/1/1 3//1 4/1`, reads a PLY file that
is cut short as a smaller surface, and takes 0.5 s to import. VTK's reader of PLY crashes on such a file.
"""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.decimals import parse_numbers
from hexmend.io.base.remedies import DAMAGED, check_suffix
from hexmend.io.formats.vtk.legacy_reader import read_polygons
from hexmend.io.formats.vtk.xml_arrays import read_values
from hexmend.io.formats.vtk.xml_document import Document


@dataclass(frozen=True, eq=False)
class Polygons:
    """Content of a surface file.

    Parameters
    ----------
    points : (n, 3) float64
    faces : list of (k, width) int64
        Nodes of the faces, from 0, grouped by width.
    """

    points: np.ndarray
    faces: list[np.ndarray]


def parse_surface(path: Path, title: str, parse: Callable[[], Polygons]) -> Polygons:
    """Call a parser whose exceptions of any type become a `FileError`.

    Parameters
    ----------
    path : Path
        Named in errors.
    title : str
        Name of the format, for errors.
    parse : callable
        parse() returns Polygons.
    """
    try:
        return parse()
    except (FileError, MemoryError, OSError):
        raise
    except Exception as error:
        detail = " ".join(str(error).split()) or type(error).__name__
        raise FileError(path, f"cannot be read as {title} ({detail[:120]})", DAMAGED) from None


def polygons_from_meshlane(mesh: object) -> Polygons:
    """Take the points and faces of a mesh from meshlane; other cells are left out."""
    kinds = ("triangle", "quad", "polygon")
    faces = [np.asarray(block.data, dtype=np.int64) for block in mesh.cells if block.type in kinds]
    return Polygons(np.asarray(mesh.points, dtype=np.float64).reshape(-1, 3), faces)


def group_by_width(start: np.ndarray, nodes: np.ndarray) -> list[np.ndarray]:
    """Group faces by their number of nodes.

    Parameters
    ----------
    start : (k + 1,) int
        Face i has the nodes nodes[start[i]:start[i + 1]].
    nodes : (start[-1],) int

    Returns
    -------
    list of (j, width) int array
    """
    widths = np.diff(start)
    return [nodes[start[:-1][widths == width, None] + np.arange(width)] for width in np.unique(widths)]


def read_obj(path: Path) -> Polygons:
    """Read an OBJ file: its vertices and faces."""
    from meshlane import obj

    text = path.read_text(encoding="utf-8", errors="replace").replace("\\\n", " ")
    return parse_surface(path, "OBJ", lambda: polygons_from_meshlane(obj.read(io.StringIO(_normalised(text)))))


def _normalised(text: str) -> str:
    """Keep vertices and faces only, and make negative (relative) vertex numbers of faces positive."""
    lines, count = [], 0
    for line in text.splitlines():
        word, *rest = line.partition("#")[0].split() or [""]
        if word == "v":
            count += 1
            lines.append(" ".join(["v", *rest[:3]]))
        elif word == "f":
            nodes = " ".join(rest)
            lines.append("f " + re.sub(r"(?<!\S)-(\d+)\S*", lambda found, n=count: str(n + 1 - int(found[1])), nodes))
    return "\n".join(lines)


_PLY_END = b"end_header"


def read_ply(path: Path) -> Polygons:
    """Read a PLY file: its vertices and faces."""
    from meshlane import ply

    data = path.read_bytes()
    head, end, rest = data.partition(_PLY_END)
    if not head.startswith(b"ply") or not end:
        raise FileError(path, "has no header from 'ply' to 'end_header'", check_suffix("a PLY file"))
    if not re.search(rb"\n\s*element vertex 0*[1-9]", head):
        problem = "holds no surface: expected vertices and faces, its header declares no vertex"
        raise FileError(path, problem, "Choose a file with a surface.")
    # The list of vertices has two names in use; meshlane knows one of them.
    head = head.replace(b"\r\n", b"\n").replace(b" vertex_index\n", b" vertex_indices\n")
    rest = b"\n" + rest.lstrip(b"\r")[1:]
    return parse_surface(path, "PLY", lambda: polygons_from_meshlane(ply.read(io.BytesIO(head + end + rest))))


def read_legacy(path: Path) -> Polygons:
    """Read the polygons of a legacy file."""
    points, start, nodes = read_polygons(path)
    return Polygons(points, group_by_width(start, nodes))


def read_vtp(path: Path) -> Polygons:
    """Read a VTP file: the polygons of its pieces."""
    with Document(path, "PolyData") as document:
        return parse_surface(path, "VTP", lambda: _polygons(document))


def _polygons(document: Document) -> Polygons:
    points, faces, before = [np.empty((0, 3))], [], 0
    for piece in document.root.first("PolyData").all("Piece"):
        found = piece.first("Points").arrays()
        if found and document.count(piece, "NumberOfPoints"):
            x = read_values(document, found[0])
            points.append(x.reshape(document.count(piece, "NumberOfPoints"), 3).astype(np.float64, copy=False))
        if document.count(piece, "NumberOfStrips"):
            raise document.error("holds triangle strips: expected polygons", "Convert them to triangles.")
        if document.count(piece, "NumberOfPolys"):
            arrays = piece.first("Polys").arrays_by_name()
            nodes, ends = (read_values(document, arrays[name]).astype(np.int64) for name in ("connectivity", "offsets"))
            faces += group_by_width(np.concatenate([[0], ends]), nodes + before)
        before += len(points[-1])
    return Polygons(np.concatenate(points), faces)


#: Bytes before the triangles of a binary file.
_STL_HEADER = 84
#: Beginning of a facet, or a vertex with its three numbers, at the begin of a line.
_STL_LINE = re.compile(
    rb"^[ \t\v\f]*(?:facet(?!\S)|vertex(?:[ \t\v\f]+(\S+[ \t\v\f]+\S+[ \t\v\f]+\S+))?)", re.MULTILINE
)
#: A triangle of a binary file.
TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read_stl(path: Path) -> Polygons:
    """Read an STL file; triangles do not share corners."""
    data = path.read_bytes()
    if len(data) >= _STL_HEADER:
        count = int.from_bytes(data[_STL_HEADER - 4 : _STL_HEADER], "little")
        if len(data) == _STL_HEADER + TRIANGLE.itemsize * count:
            return _triangles(np.frombuffer(data, TRIANGLE, offset=_STL_HEADER)["corners"])
    if data.lstrip()[:5].lower() != b"solid":
        have = max(len(data) - _STL_HEADER, 0) / TRIANGLE.itemsize
        problem = f"is not an STL file: it begins without 'solid' and ends after {have:.1f} binary triangles"
        raise FileError(path, problem, DAMAGED)
    return parse_surface(path, "STL", lambda: _triangles(_corners(data.lower().replace(b"\r", b"\n"))))


def _corners(data: bytes) -> np.ndarray:
    """Parse the corners of all facets, (3 k, 3) float64; raises ValueError where a facet has not three of them."""
    lines = _STL_LINE.findall(data)
    if [bool(numbers) for numbers in lines] != [False, True, True, True] * (len(lines) // 4):
        raise ValueError("a facet has not three vertices")
    values = parse_numbers(b" ".join(lines), np.float64)
    if values is None or values.size != len(lines) // 4 * 9:
        raise ValueError("a vertex has not three numbers")
    return values.reshape(-1, 3)


def _triangles(corners: np.ndarray) -> Polygons:
    """Make separate triangles of corners, (3 k, 3) or (k, 3, 3)."""
    points = corners.reshape(-1, 3).astype(np.float64)
    return Polygons(points, [np.arange(len(points)).reshape(-1, 3)])
