"""STL, in decimals and binary: triangles as nine numbers each, of which meshlane reads some files only."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.surfaces.format import DAMAGED, SURFACE_FORMATS, Polygons, SurfaceFormat, parse_surface

#: Bytes before the triangles of a binary file, and what each of them has.
_HEAD = 84
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read(path: Path) -> Polygons:
    """Read an STL file; each triangle has corners of its own."""
    data = path.read_bytes()
    if len(data) >= _HEAD:
        count = int.from_bytes(data[_HEAD - 4 : _HEAD], "little")
        if len(data) == _HEAD + _TRIANGLE.itemsize * count:
            return _soup(np.frombuffer(data, _TRIANGLE, offset=_HEAD)["corners"])
    if data.lstrip()[:5].lower() != b"solid":
        have = max(len(data) - _HEAD, 0) / _TRIANGLE.itemsize
        raise FileError(
            path, f"is no STL: it begins without 'solid' and ends after {have:.1f} binary triangles", DAMAGED
        )
    return parse_surface(path, "STL", lambda: _soup(_corners(data.lower())))


def _corners(data: bytes) -> np.ndarray:
    """The corners of all facets, (3 k, 3) float64; ValueError where a facet has not three of three numbers."""
    lines = [
        line for line in map(bytes.split, re.split(rb"[\r\n]+", data)) if line and line[0] in (b"facet", b"vertex")
    ]
    kinds = [line[0] for line in lines]
    if kinds != [b"facet", b"vertex", b"vertex", b"vertex"] * (len(kinds) // 4):
        raise ValueError("a facet has not three vertices")
    return np.array([line[1:4] for line in lines if line[0] == b"vertex"], np.float64).reshape(-1, 3)


def _soup(corners: np.ndarray) -> Polygons:
    """Triangles none of which shares a corner."""
    points = corners.reshape(-1, 3).astype(np.float64)
    return Polygons(points, [np.arange(len(points)).reshape(-1, 3)])


SURFACE_FORMATS.add("stl", SurfaceFormat("stl", "STL", (".stl",), read))
