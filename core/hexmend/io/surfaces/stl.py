"""STL, in decimals and binary; meshlane does not read all of its variants."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.decimals import parse_numbers
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.surfaces.format import Polygons, parse_surface

#: Bytes before the triangles of a binary file.
_HEADER = 84
#: Beginning of a facet, or a vertex with its three numbers, at the begin of a line.
_LINE = re.compile(rb"^[ \t\v\f]*(?:facet(?!\S)|vertex(?:[ \t\v\f]+(\S+[ \t\v\f]+\S+[ \t\v\f]+\S+))?)", re.MULTILINE)
#: A triangle of a binary file.
TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read(path: Path) -> Polygons:
    """Read an STL file; triangles do not share corners."""
    data = path.read_bytes()
    if len(data) >= _HEADER:
        count = int.from_bytes(data[_HEADER - 4 : _HEADER], "little")
        if len(data) == _HEADER + TRIANGLE.itemsize * count:
            return _polygons(np.frombuffer(data, TRIANGLE, offset=_HEADER)["corners"])
    if data.lstrip()[:5].lower() != b"solid":
        have = max(len(data) - _HEADER, 0) / TRIANGLE.itemsize
        problem = f"is not an STL file: it begins without 'solid' and ends after {have:.1f} binary triangles"
        raise FileError(path, problem, DAMAGED)
    return parse_surface(path, "STL", lambda: _polygons(_corners(data.lower().replace(b"\r", b"\n"))))


def _corners(data: bytes) -> np.ndarray:
    """Parse the corners of all facets, (3 k, 3) float64; raises ValueError where a facet has not three of them."""
    lines = _LINE.findall(data)
    if [bool(numbers) for numbers in lines] != [False, True, True, True] * (len(lines) // 4):
        raise ValueError("a facet has not three vertices")
    values = parse_numbers(b" ".join(lines), np.float64)
    if values is None or values.size != len(lines) // 4 * 9:
        raise ValueError("a vertex has not three numbers")
    return values.reshape(-1, 3)


def _polygons(corners: np.ndarray) -> Polygons:
    """Make separate triangles of corners, (3 k, 3) or (k, 3, 3)."""
    points = corners.reshape(-1, 3).astype(np.float64)
    return Polygons(points, [np.arange(len(points)).reshape(-1, 3)])
