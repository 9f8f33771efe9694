"""Reading of surface files; each module of a format registers it in SURFACE_FORMATS.

>>> sorted(SURFACE_FORMATS)
['obj', 'ply', 'stl', 'vtk', 'vtp']
"""

from hexmend.io.surfaces import obj, ply, stl, vtk_legacy, vtp  # noqa: F401  (registers the formats)
from hexmend.io.surfaces.format import SURFACE_FORMATS, SurfaceFormat
from hexmend.io.surfaces.read import read_surface

__all__ = ["SURFACE_FORMATS", "SurfaceFormat", "read_surface"]
