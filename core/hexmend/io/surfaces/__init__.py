"""Reading of surface files.

>>> ", ".join(SURFACE_FORMATS)
'.stl, .obj, .ply, .vtp, .vtk'
"""

from hexmend.io.surfaces.read import SURFACE_FORMATS, read_surface

__all__ = ["SURFACE_FORMATS", "read_surface"]
