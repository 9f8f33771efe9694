"""STL, in decimals and binary; meshlane does not read all of its variants."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.decimals import parse_numbers
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.surfaces.format import Polygons, SurfaceFormat, parse_surface, register

#: Bytes before the triangles of a binary file.
_HEADER = 84
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
    return parse_surface(path, "STL", lambda: _polygons(_corners(data.lower())))


def _corners(data: bytes) -> np.ndarray:
    """Parse the corners of all facets, (3 k, 3) float64; raises ValueError where a facet has not three of them."""
    lines = [line.strip() for line in data.replace(b"\r", b"\n").split(b"\n")]
    lines = [line for line in lines if line.startswith((b"vertex", b"facet"))]
    in_order = len(lines) % 4 == 0 and all(
        line.startswith(b"vertex" if row else (b"facet ", b"facet\t")) for row in range(4) for line in lines[row::4]
    )
    del lines[::4]
    if in_order and {*map(len, map(bytes.split, lines))} <= {4}:
        numbers = parse_numbers(b" ".join([line[6:] for line in lines]), np.float64)
        if numbers is not None and numbers.size == 3 * len(lines):
            return numbers.reshape(-1, 3)
    return _corners_by_words(data)


def _corners_by_words(data: bytes) -> np.ndarray:
    """Parse the corners of all facets as `_corners` does, whatever else their lines hold, in three times the time."""
    words = map(bytes.split, re.split(rb"[\r\n]+", data))
    lines = [line for line in words if line and line[0] in (b"facet", b"vertex")]
    kinds = [line[0] for line in lines]
    if kinds != [b"facet", b"vertex", b"vertex", b"vertex"] * (len(kinds) // 4):
        raise ValueError("a facet has not three vertices")
    return np.array([line[1:4] for line in lines if line[0] == b"vertex"], np.float64).reshape(-1, 3)


def _polygons(corners: np.ndarray) -> Polygons:
    """Make separate triangles of corners, (3 k, 3) or (k, 3, 3)."""
    points = corners.reshape(-1, 3).astype(np.float64)
    return Polygons(points, [np.arange(len(points)).reshape(-1, 3)])


register(SurfaceFormat(name="stl", title="STL", suffixes=(".stl",), read=read))
