"""VTK's legacy format for surfaces (.vtk)."""

from __future__ import annotations

from pathlib import Path

from hexmend.io.formats.vtk.legacy_reader import read_polygons
from hexmend.io.surfaces.format import Polygons, SurfaceFormat, group_by_width, register


def read(path: Path) -> Polygons:
    """Read the polygons of a legacy file."""
    points, start, nodes = read_polygons(path)
    return Polygons(points, group_by_width(start, nodes))


register(SurfaceFormat(name="vtk", title="VTK legacy", suffixes=(".vtk",), read=read))
