"""Conversion of meshes to and from the objects of other Python libraries: PyVista and meshio.

The libraries are imported when a function is called, and the rest of Hexmend does not need them.
"""

from hexmend.interop.meshio_mesh import from_meshio, to_meshio
from hexmend.interop.pyvista_grid import from_pyvista, to_pyvista

__all__ = ["from_meshio", "from_pyvista", "to_meshio", "to_pyvista"]
