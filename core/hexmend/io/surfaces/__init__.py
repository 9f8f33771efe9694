"""Surfaces from files: one format a file, each announcing itself in SURFACES.

>>> sorted(SURFACES)
['obj', 'ply', 'stl', 'vtk', 'vtp']
"""

from hexmend.io.surfaces import obj, ply, stl, vtk_legacy, vtp  # noqa: F401  (they register themselves)
from hexmend.io.surfaces.format import SURFACES, SurfaceFormat
from hexmend.io.surfaces.read import read_surface

__all__ = ["SURFACES", "SurfaceFormat", "read_surface"]
