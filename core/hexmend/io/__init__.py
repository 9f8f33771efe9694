"""Meshes and recipes from and to files: one format a file, each announcing itself in FORMATS.

>>> sorted(FORMATS)[:4]
['abaqus', 'cgns', 'exodus', 'gmsh']
"""

from __future__ import annotations

from hexmend.io import (  # noqa: F401  (they register themselves)
    abaqus,
    cgns,
    exodus,
    gmsh,
    med,
    medit,
    medit_binary,
    nastran,
    ovm,
    pvtu,
    session,
    su2,
    vtk_legacy,
    vtkhdf,
    vtu,
)
from hexmend.io.files import left_out, read, readable_suffixes, writable_suffixes, write, writer_for
from hexmend.io.format import FORMATS, Format

TYPE_CHECKING = False
if TYPE_CHECKING:
    from hexmend.io.recipes import read_recipe, write_recipe
    from hexmend.io.surfaces import read_surface

__all__ = [
    "FORMATS",
    "Format",
    "left_out",
    "read",
    "read_recipe",
    "read_surface",
    "readable_suffixes",
    "writable_suffixes",
    "write",
    "write_recipe",
    "writer_for",
]


def __getattr__(name: str) -> object:
    if name in ("read_recipe", "write_recipe"):  # which know every method: who only reads a mesh does not wait for them
        from hexmend.io import recipes

        return getattr(recipes, name)
    if name == "read_surface":
        from hexmend.io.surfaces import read_surface

        return read_surface
    raise AttributeError(f"module 'hexmend.io' has no attribute {name!r}")
