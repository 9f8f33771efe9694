"""Which nodes are to stay, told one by one, by the names of sets, or by a region that alone is to move."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.errors import MeshError
from hexmend.mesh.fields import as_set
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh


def with_pinned(mesh: Mesh, nodes: int | Sequence[int] | np.ndarray, on: bool = True) -> Mesh:
    """The mesh with some nodes pinned, or let go where `on` is false; the others' pins stay.

    Parameters
    ----------
    mesh : Mesh
    nodes : int or (k,) int
    on : bool

    Raises
    ------
    MeshError
        For a node that does not exist.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = make("cube", size=27)
    >>> int(mesh.free.sum()), int(with_pinned(mesh, [21, 22]).free.sum())
    (8, 6)
    """
    pinned = np.zeros(mesh.n_nodes, dtype=bool) if mesh.pinned is None else mesh.pinned.copy()
    pinned[as_set(np.atleast_1d(nodes), "nodes", mesh.n_nodes)] = on
    return mesh.replace(pinned=pinned)


def with_sets_fixed(mesh: Mesh, *names: str) -> Mesh:
    """The mesh whose nodes in some sets are pinned, besides those that are.

    Parameters
    ----------
    mesh : Mesh
    names : str
        Of node sets, or of sets of hexes or sides, all nodes of which are meant.

    Raises
    ------
    MeshError
        For a set that there is not.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = make("cube", size=27).replace(node_sets={"middle": np.array([21, 22])})
    >>> int(with_sets_fixed(mesh, "middle").free.sum()), int(mesh.free.sum())
    (6, 8)
    """
    for name in names:
        mesh = with_pinned(mesh, nodes_in_set(mesh, name))
    return mesh


def with_region_free(mesh: Mesh, hexes: np.ndarray, rings: int = 0) -> Mesh:
    """The mesh of which only the nodes of some hexes, and of so many rings around them, may move.

    Parameters
    ----------
    mesh : Mesh
    hexes : (k,) int
    rings : int
        How often those that share a node with the ones before are taken in.

    Raises
    ------
    MeshError
        For a hex that does not exist.
    """
    region = np.zeros(mesh.n_nodes, dtype=bool)
    region[mesh.hexes[mesh.topology.hexes_around(hexes, rings)]] = True
    return mesh.replace(pinned=~region if mesh.pinned is None else mesh.pinned | ~region)


def nodes_in_set(mesh: Mesh, name: str) -> np.ndarray:
    """The nodes of a set of nodes, hexes or sides, (k,) int; raises `MeshError` for a set that there is not."""
    if name in mesh.node_sets:
        return np.asarray(mesh.node_sets[name])
    if name in mesh.hex_sets:
        return np.unique(mesh.hexes[mesh.hex_sets[name]])
    if name in mesh.side_sets:
        rows = np.asarray(mesh.side_sets[name])
        return np.unique(mesh.hexes[rows[:, :1], FACES[rows[:, 1]]])
    known = {**mesh.node_sets, **mesh.hex_sets, **mesh.side_sets}
    raise MeshError(f"there is no set {name!r}: there are {_listed(known)}")


def _listed(names: object) -> str:
    return ", ".join(map(repr, names)) or "none"
