"""Resolution of rules of motion: the nodes that the names of their sets mean in a mesh."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.errors import MeshError
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.flat_sets import plane_of_set
from hexmend.mesh.rules.motion_rules import MotionRules, NodeRules
from hexmend.mesh.rules.named_sets import nodes_in_set
from hexmend.mesh.rules.periodic_sets import periodic_motion


def with_rules(mesh: Mesh, rules: MotionRules) -> Mesh:
    """Return the mesh with rules of motion of its nodes, in place of those it has.

    Pins of the mesh stay as they are: the rules hold for runs, and no file keeps them. A node that is both fixed and
    freed is fixed.

    Parameters
    ----------
    mesh : Mesh
    rules : MotionRules

    Returns
    -------
    Mesh

    Raises
    ------
    MeshError
        For a set that does not exist, one whose nodes are not in a plane, one that is to be freed but lies on the
        boundary, and two that are to be periodic but do not match.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> mesh = make("cube", size=27).replace(node_sets={"middle": np.array([21, 22])})
    >>> int(with_rules(mesh, MotionRules(fix="middle")).free.sum()), int(mesh.free.sum())
    (6, 8)
    """
    motion = None
    for name in rules.plane:
        plane = plane_of_set(mesh, name)
        motion = plane if motion is None else motion.merge(plane)
    for pair in rules.periodic:
        ties = periodic_motion(mesh, *pair)
        motion = ties if motion is None else motion.merge(ties)
    free = _marks(mesh, rules.free)
    if free is not None:
        for name in rules.free:
            _check_freed(mesh, name)
        free &= mesh.topology.used
    resolved = NodeRules(
        rules, fixed=_marks(mesh, rules.fix), free=_immutable(free), slides=_marks(mesh, rules.slide)
    )
    mesh = mesh.with_node_rules(resolved)
    return mesh if motion is None else mesh.with_linear_motion(motion)


def _marks(mesh: Mesh, names: Iterable[str]) -> np.ndarray | None:
    """Mark the nodes of all sets of these names, (n,) bool; None without a name."""
    marks = None
    for name in names:
        marks = np.zeros(mesh.n_nodes, dtype=bool) if marks is None else marks
        marks[nodes_in_set(mesh, name)] = True
    return marks


def _immutable(marks: np.ndarray | None) -> np.ndarray | None:
    return None if marks is None else as_immutable(marks)


def _check_freed(mesh: Mesh, name: str) -> None:
    """Raise for a set of which freeing sets no node free: those of the boundary are held by the surface."""
    nodes = nodes_in_set(mesh, name)
    pinned = mesh.pinned is not None and mesh.pinned[nodes].any()
    if nodes.size and mesh.topology.boundary[nodes].all() and not pinned:
        raise MeshError(
            f"the set {name!r} lies on the boundary, whose nodes cannot be free: let them slide on it (--slide), or "
            "move in their plane (--plane)"
        )
