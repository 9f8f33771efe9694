"""Surfaces from files: one format a file, each announcing itself in SURFACE_FORMATS.

>>> sorted(SURFACE_FORMATS)
['obj', 'ply', 'stl', 'vtk', 'vtp']
"""

from hexmend.aliases import exports
from hexmend.io.surfaces import obj, ply, stl, vtk_legacy, vtp  # noqa: F401  (they register themselves)
from hexmend.io.surfaces.format import SURFACE_FORMATS, SurfaceFormat
from hexmend.io.surfaces.read import read_surface

__all__ = ["SURFACE_FORMATS", "SurfaceFormat", "read_surface"]

__getattr__ = exports(__name__)
