"""Resolution of rules of motion: the nodes that the names of their sets mean in a mesh.

Flat sets, whose nodes move in their plane.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from hexmend.arrays import mask
from hexmend.errors import MeshError
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.motion_rules import MotionRules, NodeRules
from hexmend.mesh.rules.named_sets import nodes_in_set
from hexmend.mesh.rules.periodic_sets import PeriodicPair, match_periodic

#: Largest distance of nodes from their plane, in mean edge lengths of the mesh.
FLATNESS_TOLERANCE = 1e-6
#: Relative rounding error of coordinates in one plane.
_ROUNDING = 1e-12


def normal_of_set(mesh: Mesh, name: str) -> np.ndarray:
    """Find the normal of the plane in which the nodes of a set lie.

    Parameters
    ----------
    mesh : Mesh
    name : str
        Name of a set of nodes, sides or quads.

    Returns
    -------
    (3,) float64
        A unit vector; an axis to the last bit if the coordinates along it are equal but for rounding.

    Raises
    ------
    MeshError
        For a set that does not exist, and for nodes that are on one line or further from a plane than
        `FLATNESS_TOLERANCE`; the message says how far.
    """
    nodes = np.unique(nodes_in_set(mesh, name))
    x = mesh.points[nodes]
    unit = mesh.mean_edge_length or 1.0
    x = (x - x.mean(axis=0)) / unit if nodes.size else x
    axes = np.linalg.eigh(x.T @ x)[1]  # the first direction is that of least extent
    if nodes.size < 3 or np.abs(x @ axes[:, :2]).max() <= FLATNESS_TOLERANCE:
        few, line = f"expected three nodes or more, it has {nodes.size}", f"its {nodes.size} nodes are on one line"
        raise MeshError(f"the set {name!r} has no plane: {few if nodes.size < 3 else line}")
    distance = np.abs(x @ axes[:, 0])
    if distance.max() > FLATNESS_TOLERANCE:
        raise MeshError(
            f"the set {name!r} is not flat: node {nodes[distance.argmax()]} (counted from 0) is {distance.max():.3g} "
            f"mean edge lengths from the plane nearest to all its nodes; expected at most {FLATNESS_TOLERANCE:g}. Let "
            "it slide on the surface instead (--slide)."
        )
    across = np.ptp(x, axis=0).argmin()
    return np.eye(3)[across] if np.ptp(x[:, across]) <= _ROUNDING * max(1.0, np.ptp(x)) else axes[:, 0]


def with_rules(mesh: Mesh, rules: MotionRules) -> Mesh:
    """Return the mesh with other rules of motion of its nodes.

    Pins of the mesh stay as they are, and so does a linear motion that no rule has given: the rules hold for runs, and
    no file keeps them. A node that is both fixed and freed is fixed.

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
    for name in rules.free:
        _check_freed(mesh, name)
    free = _marks(mesh, rules.free)
    if free is not None:
        free &= mesh.topology.used
    mesh = mesh.without_motion_of_rules()
    mesh = mesh.with_node_rules(NodeRules(rules, _marks(mesh, rules.fix), free, _marks(mesh, rules.slide)))
    return _with_motion(mesh, rules) if rules.plane or rules.periodic else mesh


def with_more_rules(mesh: Mesh, rules: MotionRules) -> Mesh:
    """Return the mesh with rules of motion in addition to those it has; nodes outside its region stay pinned.

    Parameters
    ----------
    mesh : Mesh
        Its rules may be limited to a region: see `hexmend.mesh.fixing.fix_outside`.
    rules : MotionRules

    Returns
    -------
    Mesh

    Raises
    ------
    MeshError
        See `with_rules`.
    """
    old, answer = mesh.node_rules, with_rules(mesh, mesh.node_rules.rules.merge(rules))
    if old.free is None:
        return answer
    outside = _marks(mesh, old.rules.free)
    if outside is None:
        return answer
    outside &= ~old.free
    return answer.with_node_rules(replace(answer.node_rules, free=answer.node_rules.free & ~outside))


def _with_motion(mesh: Mesh, rules: MotionRules) -> Mesh:
    """Let nodes of flat sets move in their planes, and nodes of periodic sets as one.

    Nodes at which other faces of the boundary or of an interface end stay on these: they do not move so. In a pair of
    periodic sets they are fixed, even if the boundary slides.
    """
    planes = [(np.unique(nodes_in_set(mesh, name)), normal_of_set(mesh, name)) for name in rules.plane]
    pairs = [match_periodic(mesh, *names) for names in rules.periodic]
    ends = _nodes_of_other_faces(mesh, [nodes for nodes, _ in planes] + [end for pair in pairs for end in pair[:2]])
    motion = mesh.linear_motion or LinearMotion()
    for nodes, normal in planes:
        motion = motion.merge(LinearMotion.in_planes(nodes[~ends[nodes]], normal))
    for pair in pairs:
        moves = ~(ends[pair.nodes] | ends[pair.partners])
        motion = motion.merge(LinearMotion.tying(pair.partners[moves], pair.nodes[moves], pair.rotation))
    return _with_node_marks(mesh, motion, pairs).with_motion_of_rules(motion)


def _nodes_of_other_faces(mesh: Mesh, sets: list[np.ndarray]) -> np.ndarray:
    """Mark the nodes of faces of the boundary and of interfaces that are in none of some sets of nodes, (n,) bool."""
    faces, materials = mesh.topology.boundary_faces, mesh.interfaces
    if materials is not None:
        faces = np.concatenate([faces, materials.interface_faces])
    inside = np.zeros(len(faces), dtype=bool)
    for nodes in sets:
        inside |= mask(nodes, mesh.n_nodes)[faces].all(axis=1)
    return mask(faces[~inside], mesh.n_nodes)


def _with_node_marks(mesh: Mesh, motion: LinearMotion, pairs: list[PeriodicPair]) -> Mesh:
    """Free the interface nodes that have a linear motion, and fix the nodes of periodic sets that have none."""
    moves = mask(np.concatenate([motion.nodes, motion.tied, motion.master]), mesh.n_nodes)
    rules, materials = mesh.node_rules, mesh.interfaces
    if materials is not None:
        between = moves & materials.interface_nodes & ~mesh.immovable
        rules = replace(rules, free=between if rules.free is None else rules.free | between)
    stays = mask(np.concatenate([np.empty(0, np.int64), *(end for pair in pairs for end in pair[:2])]), mesh.n_nodes)
    stays &= ~moves
    rules = replace(rules, fixed=stays if rules.fixed is None else rules.fixed | stays)
    return mesh.with_node_rules(rules)


def _marks(mesh: Mesh, names: Iterable[str]) -> np.ndarray | None:
    """Mark the nodes of all sets of these names, (n,) bool; None without a name."""
    marks = None
    for name in names:
        marks = np.zeros(mesh.n_nodes, dtype=bool) if marks is None else marks
        marks[nodes_in_set(mesh, name)] = True
    return marks


def _check_freed(mesh: Mesh, name: str) -> None:
    """Raise for a set whose nodes a rule cannot free: nodes of the boundary are bound to the surface."""
    nodes = nodes_in_set(mesh, name)
    pinned = mesh.pinned is not None and mesh.pinned[nodes].any()
    if nodes.size and mesh.topology.boundary[nodes].all() and not pinned:
        raise MeshError(
            f"the set {name!r} lies on the boundary, whose nodes cannot be free: let them slide on it (--slide), or "
            "move in their plane (--plane)"
        )
