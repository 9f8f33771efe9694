"""Tags: named groups of hexes, stored as the hex sets of a mesh."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.mesh.fields import as_set
from hexmend.mesh.mesh import Mesh


def with_tag(mesh: Mesh, name: str, hexes: Sequence[int] | np.ndarray, on: bool = True) -> Mesh:
    """Return the mesh with hexes added to a tag or removed from it.

    Parameters
    ----------
    mesh : Mesh
    name : str
        Name of the tag; a new one is created, an empty one removed.
    hexes : (k,) int
    on : bool
        Add the hexes; false removes them.

    Returns
    -------
    Mesh

    Raises
    ------
    MeshError
        For a hex that does not exist.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = with_tag(make("cube", size=27), "corner", [0, 3])
    >>> mesh.hex_sets["corner"].tolist(), sorted(with_tag(mesh, "corner", [0, 3], on=False).hex_sets)
    ([0, 3], [])
    """
    sets = dict(mesh.hex_sets)
    before = sets.get(name, np.empty(0, dtype=np.int64))
    hexes = as_set(hexes, f"hex set {name!r}", mesh.n_hexes)
    sets[name] = np.union1d(before, hexes) if on else np.setdiff1d(before, hexes)
    if not len(sets[name]):
        del sets[name]
    return mesh.replace(hex_sets=sets)


def without_tag(mesh: Mesh, name: str) -> Mesh:
    """Return the mesh without a tag."""
    return mesh.replace(hex_sets={key: hexes for key, hexes in mesh.hex_sets.items() if key != name})


def with_tag_renamed(mesh: Mesh, name: str, other: str) -> Mesh:
    """Return the mesh with a tag renamed."""
    return mesh.replace(hex_sets={other if key == name else key: hexes for key, hexes in mesh.hex_sets.items()})
