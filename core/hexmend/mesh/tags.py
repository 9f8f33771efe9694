"""Named sets of a mesh, and tags: sets of hexes that grow and shrink."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

import numpy as np

from hexmend.errors import ParameterError
from hexmend.mesh.fields import as_numbers, as_set
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import set_names, unknown_set


def add_set(
    mesh: Mesh,
    name: str,
    *,
    hexes: Sequence[int] | np.ndarray | None = None,
    nodes: Sequence[int] | np.ndarray | None = None,
    sides: Sequence[Sequence[int]] | np.ndarray | None = None,
) -> Mesh:
    """Return the mesh with another named set, or with other members of the one of that name and kind.

    Parameters
    ----------
    mesh : Mesh
        It is not changed.
    name : str
    hexes : (k,) int or (m,) bool, optional
        Numbers or marks of hexes, such as `mesh.worst(10)`.
    nodes : (k,) int or (n,) bool, optional
        Numbers or marks of nodes.
    sides : (k, 2) int, optional
        The hex and the row of `hexmend.mesh.hexahedron.FACES` of each face.

    Returns
    -------
    Mesh

    Raises
    ------
    MeshError
        For members that do not exist.
    ParameterError
        Unless hexes, nodes or sides are given, one of them.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = add_set(make("cube", size=27), "corner", hexes=[0, 3])
    >>> mesh.region("corner")
    array([0, 3])
    """
    given = {"hex_sets": hexes, "node_sets": nodes, "side_sets": sides}
    kinds = [kind for kind, members in given.items() if members is not None]
    if len(kinds) != 1:
        raise ParameterError(f"set {name!r}: expected its members by one of hexes=, nodes= and sides=")
    kind, members = kinds[0], given[kinds[0]]
    if kind != "side_sets":
        count = mesh.n_hexes if kind == "hex_sets" else mesh.n_nodes
        members = as_numbers(members, f"{kind[:-1].replace('_', ' ')} {name!r}", count)
    return mesh.replace(**{kind: {**getattr(mesh, kind), name: members}})


def remove_set(mesh: Mesh, name: str) -> Mesh:
    """Return the mesh without its sets of hexes, nodes, sides and other cells of a name.

    Raises
    ------
    MeshError
        For a set that does not exist; the message suggests the nearest.
    """
    if name not in (names := set_names(mesh)):
        raise unknown_set(name, names)
    changes: dict[str, Any] = {
        kind: {key: members for key, members in getattr(mesh, kind).items() if key != name}
        for kind in ("hex_sets", "node_sets", "side_sets")
        if name in getattr(mesh, kind)
    }
    if any(name in cells.sets for cells in mesh.cells):
        changes["cells"] = tuple(
            dataclasses.replace(cells, sets={key: one for key, one in cells.sets.items() if key != name})
            for cells in mesh.cells
        )
    return mesh.replace(**changes)


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
