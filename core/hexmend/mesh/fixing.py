"""Fixing of nodes: by number, by named sets, or outside a region."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hexmend.mesh.fields import as_numbers
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import nodes_in_set, set_names


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
    pinned[as_numbers(nodes, "nodes", mesh.n_nodes)] = on
    return mesh.replace(pinned=pinned)


def fix(mesh: Mesh, *nodes: str | int | Sequence[int] | np.ndarray) -> Mesh:
    """Return the mesh with nodes fixed: they stay where they are even if the boundary slides.

    Parameters
    ----------
    mesh : Mesh
        It is not changed.
    *nodes : str, int, (k,) int or (n,) bool
        Names of sets of nodes, hexes or sides, of which all nodes are fixed; numbers of nodes; marks of nodes.

    Returns
    -------
    Mesh
        Formats that have marks of fixed nodes keep them.

    Raises
    ------
    MeshError
        For a set that does not exist (the message suggests the nearest) and a node that does not exist.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = make("cube", size=27).replace(node_sets={"middle": np.array([21, 22])})
    >>> fixed = fix(mesh, "middle")
    >>> int(mesh.free.sum()), int(fixed.free.sum()), fixed.fixed_sets
    (8, 6, ('middle',))
    """
    for one in nodes:
        mesh = with_pinned(mesh, _numbers(mesh, one), True)
    return mesh


def unfix(mesh: Mesh, *nodes: str | int | Sequence[int] | np.ndarray) -> Mesh:
    """Return the mesh with nodes released that `fix`, or the mesh's file, has fixed.

    Nodes of the boundary stay fixed unless the boundary slides.

    Parameters
    ----------
    mesh, *nodes
        As for `fix`; without any name or number all nodes are released.

    Returns
    -------
    Mesh

    Raises
    ------
    MeshError
        See `fix`.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> int(unfix(fix(make("cube", size=27), [21, 22]), 21).free.sum())
    7
    """
    if not nodes:
        return mesh.replace(pinned=None)
    for one in nodes:
        mesh = with_pinned(mesh, _numbers(mesh, one), False)
    return mesh


def fixed_sets(mesh: Mesh) -> tuple[str, ...]:
    """List the sets of a mesh whose nodes all stay where they are, by `fix`, by rules or by the file.

    Sets of the boundary are among them only if their nodes stay even where the boundary slides.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    tuple of str
        In the order of `hexmend.mesh.rules.named_sets.set_names`; sets without a node are left out.
    """
    nodes = {name: nodes_in_set(mesh, name) for name in set_names(mesh)}
    return tuple(name for name, members in nodes.items() if len(members) and mesh.immovable[members].all())


def _numbers(mesh: Mesh, nodes: str | int | Sequence[str] | Sequence[int] | np.ndarray) -> np.ndarray:
    """Return the numbers of nodes that are given by names of sets, by numbers or by marks."""
    names = [nodes] if isinstance(nodes, str) else nodes
    if isinstance(names, list | tuple) and names and all(isinstance(name, str) for name in names):
        return np.unique(np.concatenate([nodes_in_set(mesh, name) for name in names]))
    return as_numbers(nodes, "nodes", mesh.n_nodes)


def fix_outside(mesh: Mesh, hexes: Sequence[int] | np.ndarray, rings: int = 0) -> Mesh:
    """Return the mesh with all nodes fixed but those of some hexes and of rings of hexes around them.

    Nodes of higher order are not fixed: they follow their corners.

    Parameters
    ----------
    mesh : Mesh
    hexes : (k,) int or (m,) bool
        By number or as marks, such as `mesh.region("inverted")`.
    rings : int
        Number of rings; each adds the hexes that share a node with those before.

    Returns
    -------
    Mesh

    Raises
    ------
    MeshError
        For a hex that does not exist.
    ParameterError
        For rings that are no whole number from 0.
    """
    region = np.zeros(mesh.n_nodes, dtype=bool)
    inside = as_numbers(hexes, "hexes", mesh.n_elements)
    region[mesh.elements[mesh.topology.hexes_around(inside, rings)]] = True
    if mesh.mid_nodes is not None:
        region[mesh.mid_nodes[mesh.mid_nodes >= 0]] = True
    region[mesh.middles[:, 0]] = True
    rules = mesh.node_rules
    if rules.free is not None:  # a rule frees no node outside the region
        mesh = mesh.with_node_rules(replace(rules, free=rules.free & region))
    return mesh.replace(pinned=~region if mesh.pinned is None else mesh.pinned | ~region)
