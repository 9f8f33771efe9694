"""VTK's formats for surfaces: XML (.vtp) and legacy (.vtk)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.io.formats.vtk.legacy_reader import read_polygons
from hexmend.io.formats.vtk.xml_arrays import read_values
from hexmend.io.formats.vtk.xml_document import Document
from hexmend.io.surfaces.format import Polygons, group_by_width, parse_surface


def read_legacy(path: Path) -> Polygons:
    """Read the polygons of a legacy file."""
    points, start, nodes = read_polygons(path)
    return Polygons(points, group_by_width(start, nodes))


def read(path: Path) -> Polygons:
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
