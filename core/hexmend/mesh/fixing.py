"""Pinning of nodes: by number, by named sets, or outside a region."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hexmend.mesh.fields import as_set
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import nodes_in_set
from hexmend.mesh.validation import as_array


def with_pinned(mesh: Mesh, nodes: int | Sequence[int] | np.ndarray, on: bool = True) -> Mesh:
    """Return the mesh with some nodes pinned or unpinned.

    Parameters
    ----------
    mesh : Mesh
    nodes : int or (k,) int
        Numbers of nodes; the pins of other nodes stay.
    on : bool
        Pin the nodes; false unpins them.

    Returns
    -------
    Mesh

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
    pinned[as_set(np.atleast_1d(as_array(nodes, "nodes")), "nodes", mesh.n_nodes)] = on
    return mesh.replace(pinned=pinned)


def with_sets_fixed(mesh: Mesh, *names: str) -> Mesh:
    """Return the mesh with the nodes of named sets pinned as well.

    Parameters
    ----------
    mesh : Mesh
    names : str
        Names of node sets, or of hex or side sets, of which all nodes are pinned.

    Returns
    -------
    Mesh

    Raises
    ------
    MeshError
        For a set that does not exist.

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
    """Return the mesh with all nodes pinned but those of some hexes and of rings of hexes around them.

    Parameters
    ----------
    mesh : Mesh
    hexes : (k,) int
    rings : int
        Number of rings; each adds the hexes that share a node with those before.

    Returns
    -------
    Mesh

    Raises
    ------
    MeshError
        For a hex that does not exist.
    """
    region = np.zeros(mesh.n_nodes, dtype=bool)
    region[mesh.hexes[mesh.topology.hexes_around(hexes, rings)]] = True
    rules = mesh.node_rules
    if rules.free is not None:  # a rule frees no node outside the region
        mesh = mesh.with_node_rules(replace(rules, free=rules.free & region))
    return mesh.replace(pinned=~region if mesh.pinned is None else mesh.pinned | ~region)
