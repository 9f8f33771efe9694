"""VTK's legacy format for surfaces (.vtk)."""

from __future__ import annotations

from pathlib import Path

from hexmend.io.formats.vtk.legacy_reader import read_polygons
from hexmend.io.surfaces.format import SURFACES, Polygons, SurfaceFormat, of_one_width


def read(path: Path) -> Polygons:
    """Read the polygons of a legacy file."""
    points, start, nodes = read_polygons(path)
    return Polygons(points, of_one_width(start, nodes))


SURFACES.add("vtk", SurfaceFormat("vtk", "VTK legacy", (".vtk",), read))
