"""Selection of hexes: by the name of a set, and by names, numbers and a box together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.arrays import mask
from hexmend.errors import MeshError
from hexmend.mesh.fields import as_numbers
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import nodes_in_set, set_names, unknown_set
from hexmend.mesh.solid_cells import centres, solid_blocks
from hexmend.mesh.validation import as_reals
from hexmend.quality.mesh_quality import measure_mesh

#: Names of sets of hexes that the quality determines.
_BY_QUALITY = ("inverted", "invalid")


def hexes_in_set(mesh: Mesh, name: str) -> np.ndarray:
    """Return the hexes of an element set, or, for the names "inverted" and "invalid", these hexes.

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
    members = _members(mesh, name)
    if members is not None:
        return members
    if name in _BY_QUALITY:
        return np.flatnonzero(getattr(measure_mesh(mesh), name))
    raise unknown_set(name, [*mesh.hex_sets, *_BY_QUALITY], "element set")


def _members(mesh: Mesh, name: str) -> np.ndarray | None:
    """Return the numbers of the solid cells of an element set, (k,) int; None if there is no such set."""
    found, first = [np.asarray(mesh.hex_sets[name])] if name in mesh.hex_sets else [], mesh.n_hexes
    for cells in solid_blocks(mesh.cells):
        if name in cells.sets:
            found.append(first + np.asarray(cells.sets[name]))
        first += len(cells.nodes)
    return np.concatenate(found) if found else None


def region(
    mesh: Mesh,
    *names: str,
    hexes: Sequence[int] | np.ndarray | None = None,
    box: Sequence[Sequence[float]] | np.ndarray | None = None,
    rings: int = 0,
) -> np.ndarray:
    """Find the hexes of a region.

    Parameters
    ----------
    mesh : Mesh
    *names : str
        Names of element sets, materials, and sets of sides, nodes or quads, "inverted" or "invalid"; the hexes of all
        of them together. A set of sides has the hexes of its faces, another set those with a node in it. All hexes by
        default.
    hexes : (k,) int or (m,) bool, optional
        Only hexes among these, by number or as marks.
    box : ((x, y, z), (x, y, z)), optional
        Only hexes whose centre, the mean of the eight nodes, is in the box between two opposite corners; in the mesh's
        unit of length.
    rings : int
        Rings of neighbours to be added at the end: each adds the hexes that share a node with those before.

    Returns
    -------
    (k,) int64
        Numbers of hexes, ascending, each once.

    Raises
    ------
    MeshError
        For a name that the mesh does not have (the message suggests the nearest), a hex that does not exist, and a box
        that is no two points.
    ParameterError
        As for `hexmend.mesh.topology.Topology.hexes_around`.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = make("cube", size=27)
    >>> region(mesh, box=[(0, 0, 0), (0.5, 0.5, 0.2)])
    array([0, 1, 3, 4])
    >>> region(mesh, hexes=[0], rings=1).size
    8
    """
    marks = np.zeros(mesh.n_elements, dtype=bool) if names else np.ones(mesh.n_elements, dtype=bool)
    for name in names:
        marks[_hexes_of(mesh, name)] = True
    if hexes is not None:
        marks &= mask(as_numbers(hexes, "hexes", mesh.n_elements), mesh.n_elements)
    if box is not None:
        low, high = _box(box)
        middles = centres(mesh.points, mesh.elements)
        marks &= ((middles >= low) & (middles <= high)).all(axis=1)
    found = np.flatnonzero(marks)
    return np.flatnonzero(mesh.topology.hexes_around(found, rings))


def _hexes_of(mesh: Mesh, name: str) -> np.ndarray:
    """Return the hexes of a name of `region`."""
    materials = mesh.materials
    if _members(mesh, name) is not None or name in _BY_QUALITY:
        return hexes_in_set(mesh, name)
    if materials is not None and name in materials.names:
        return np.flatnonzero(materials.of_hex == materials.names.index(name))
    if name in mesh.side_sets:
        return np.unique(np.asarray(mesh.side_sets[name])[:, 0])
    known = [*dict.fromkeys([*set_names(mesh), *(materials.names if materials is not None else ())]), *_BY_QUALITY]
    if name not in known:
        raise unknown_set(name, known, "set or material")
    return np.flatnonzero(mask(nodes_in_set(mesh, name), mesh.n_nodes)[mesh.elements].any(axis=1))


def _box(box: Sequence[Sequence[float]] | np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the lowest and the highest corner of a box."""
    corners = as_reals(box, "box")
    if corners.shape != (2, 3) or not np.isfinite(corners).all():
        raise MeshError(f"box = {box!r}: expected two opposite corners, such as ((0, 0, 0), (1, 1, 1))")
    return corners.min(axis=0), corners.max(axis=0)
