"""Selection of hexes by the name of a set."""

from __future__ import annotations

import numpy as np

from hexmend.errors import MeshError
from hexmend.mesh.mesh import Mesh
from hexmend.quality.measure import measure


def hexes_in_set(mesh: Mesh, name: str) -> np.ndarray:
    """Return the hexes of an element set, or, for the name "inverted", the inverted hexes.

    Parameters
    ----------
    mesh : Mesh
    name : str

    Returns
    -------
    (k,) int
        Numbers of hexes.

    Raises
    ------
    MeshError
        If the mesh has no such set.
    """
    if name in mesh.hex_sets:
        return np.asarray(mesh.hex_sets[name])
    if name == "inverted":
        return np.flatnonzero(measure(mesh.points, mesh.hexes).inverted)
    known = ", ".join(map(repr, mesh.hex_sets)) or "none"
    raise MeshError(f"there is no element set {name!r}: there are {known} and 'inverted'")
