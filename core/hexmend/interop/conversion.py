"""Steps that all conversions share: import of the library, and conversion of its object to a mesh.

Side sets as data of hexes, for grids that have no sets of faces.

The data of a side set "inlet" are named "sides:inlet": bit k of a hex's number (1, 2, 4, 8, 16, 32) marks its face k of
`hexmend.mesh.hexahedron.FACES`, which is also face k of VTK's hexahedron. Such data stay valid if cells are left out
or reordered.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import ModuleType

import numpy as np

from hexmend.errors import FileError, InstallationError, MeshError
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import with_consistent_orientation

PREFIX = "sides:"

_BITS = 1 << np.arange(len(FACES))


def with_side_marks(mesh: Mesh) -> Mesh:
    """Copy a mesh and convert its side sets to data of its hexes."""
    marks = {}
    for name, rows in mesh.side_sets.items():
        marks[PREFIX + name] = mark = np.zeros(mesh.n_hexes, np.uint8)
        np.bitwise_or.at(mark, rows[:, 0], _BITS[rows[:, 1]].astype(np.uint8))
    return mesh.replace(hex_data={**mesh.hex_data, **marks}, side_sets={})


def with_side_sets(mesh: Mesh) -> Mesh:
    """Copy a mesh and convert data from `with_side_marks` back to side sets.

    The faces of a set are in the order of the hexes. Data with the prefix that are no such marks stay data.
    """
    marks = {name: np.asarray(values) for name, values in mesh.hex_data.items() if name.startswith(PREFIX)}
    marks = {name: values for name, values in marks.items() if _are_marks(values)}
    if not marks:
        return mesh
    sides = {name.removeprefix(PREFIX): np.argwhere(v.astype(np.int64)[:, None] & _BITS) for name, v in marks.items()}

    def others(data: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        return {name: values for name, values in data.items() if name not in marks}

    cells = tuple(replace(block, data=others(block.data)) for block in mesh.cells)
    return mesh.replace(hex_data=others(mesh.hex_data), side_sets={**mesh.side_sets, **sides}, cells=cells)


def _are_marks(values: np.ndarray) -> bool:
    return values.ndim == 1 and values.dtype.kind in "iuf" and bool(np.isin(values, np.arange(2 * _BITS[-1])).all())


def import_library(library: str) -> ModuleType:
    """Import a library; raise `InstallationError` where it is not installed."""
    try:
        return import_module(library)
    except ModuleNotFoundError as error:
        if error.name != library:
            raise
        raise InstallationError(f"{library} is not installed: pip install {library}") from None


def convert_to_mesh(title: str, read: Callable[[Path], Mesh], as_is: bool) -> Mesh:
    """Convert an object of another library to a mesh with side sets, and renumber left-handed hexes unless `as_is`.

    Parameters
    ----------
    title : str
        Name of the object in messages, such as "PyVista grid".
    read : callable
        read(title) returns the mesh; it takes the title in place of a file's path, as readers of files do.
    as_is : bool
        Keep hexes that are numbered left-handed.

    Returns
    -------
    Mesh

    Raises
    ------
    MeshError
        Where the object holds no mesh of hexahedra.
    """
    try:
        mesh = with_side_sets(read(Path(title)))
    except FileError as error:
        raise MeshError(str(error)) from None
    return mesh if as_is else with_consistent_orientation(mesh)
