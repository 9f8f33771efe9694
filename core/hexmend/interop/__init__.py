"""Meshes to and from the objects of other Python libraries: PyVista's grids and meshio's meshes.

The libraries are imported when a function is called, and none of them is needed by the rest of Hexmend.
"""

from __future__ import annotations

from hexmend.interop.meshio_mesh import from_meshio, to_meshio
from hexmend.interop.pyvista_grid import from_pyvista, to_pyvista

__all__ = ["from_meshio", "from_pyvista", "to_meshio", "to_pyvista"]
