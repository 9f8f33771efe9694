"""Two-dimensional meshes: one layer of hexes between boundaries of the types empty or wedge, as OpenFOAM has them.

The two sides of the layer move as one: between `empty` sides by a translation, between `wedge` sides by a rotation.
Every node stays in the plane of its side.
"""

from __future__ import annotations

import numpy as np

from hexmend.arrays import mask
from hexmend.errors import MeshError
from hexmend.mesh.hexahedron import EDGES, FACES
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.periodic_sets import smallest_rotation
from hexmend.mesh.solid_cells import face_nodes

#: Types of side sets between which a mesh is one layer thick.
EMPTY, WEDGE = "empty", "wedge"
#: Largest sine of the angle between two lines that count as parallel.
_PARALLEL = 1e-6
#: Relative rounding error of the coordinates of nodes opposite each other.
_ROUNDING = 1e-9


def with_two_dimensional_motion(mesh: Mesh) -> Mesh:
    """Return the mesh with the motion that its empty and wedge sides allow; with a note where that is not possible."""
    try:
        motion = two_dimensional_motion(mesh)
    except MeshError as error:
        note = f"The two sides of the mesh do not move as one: {error}. All nodes on them stay."
        return mesh if note in mesh.notes else mesh.replace(notes=(*mesh.notes, note))
    return mesh if motion is None else mesh.with_linear_motion((mesh.linear_motion or LinearMotion()).merge(motion))


def two_dimensional_motion(mesh: Mesh) -> LinearMotion | None:
    """Find the motion that side sets of the types empty and wedge allow.

    Nodes of other faces of the boundary, such as walls and inlets, are not in it: they stay.

    Parameters
    ----------
    mesh : Mesh
        With `side_set_types`.

    Returns
    -------
    LinearMotion or None
        Nodes move in the planes of their sides, and each pair of opposite nodes as one. None if there are no such
        sides.

    Raises
    ------
    MeshError
        Where no hex has two opposite faces on such sides, and for sides that are no copies of each other; the message
        names a hex or node.
    """
    side = _side_of_faces(mesh, (EMPTY, WEDGE))
    if (side < 0).all():
        return None
    side = _with_opposite(mesh, side)
    names, moves = list(mesh.side_sets), ~_nodes_of_other_faces(mesh, side)
    types = np.array([mesh.side_set_types.get(name, "") for name in names])
    motion = LinearMotion()
    pairs = [_pairs(mesh, side, axis) for axis in range(3)]
    nodes, sides = (np.concatenate([pair[k] for pair in pairs]) for k in (0, 1))
    is_wedge = (types[sides] == WEDGE).all(axis=1)
    one, other = np.unique(np.sort(nodes[~is_wedge], axis=1), axis=0).T
    for normal, rows in _directions(mesh, one, other):
        motion = motion.merge(_translated(one[rows], other[rows], normal, moves))
    sides = sides[is_wedge]
    order = np.argsort(sides, axis=1, kind="stable")  # the first side set of a pair comes first
    sides, nodes = np.take_along_axis(sides, order, axis=1), np.take_along_axis(nodes[is_wedge], order, axis=1)
    for first, second in np.unique(sides, axis=0):
        rows = (sides == [first, second]).all(axis=1)
        own = np.unique(nodes[rows], axis=0)
        motion = motion.merge(_rotated(mesh, own[moves[own].all(axis=1)], names[first], names[second]))
    return motion


def flat_sides(mesh: Mesh) -> np.ndarray:
    """Mark the nodes of side sets of the types empty and wedge, (n,) bool."""
    side = _side_of_faces(mesh, (EMPTY, WEDGE)) if mesh.side_set_types else np.zeros((0, 6), np.int64) - 1
    hexes, rows = np.nonzero(side >= 0)
    return mask(mesh.hexes[hexes[:, None], FACES[rows]].ravel(), mesh.n_nodes)


def _side_of_faces(mesh: Mesh, types: tuple[str, ...]) -> np.ndarray:
    """Index of the side set of some types to which each face of a cell belongs, -1 for none; (m, 6) int64."""
    side = np.full((mesh.n_elements, 6), -1)
    for k, (name, rows) in enumerate(mesh.side_sets.items()):
        if mesh.side_set_types.get(name) in types and len(rows):
            side[rows[:, 0], rows[:, 1]] = k
    return side


def _with_opposite(mesh: Mesh, side: np.ndarray) -> np.ndarray:
    """Leave out faces on flat sides whose opposite ones are on none, such as those on an axis: their nodes stay."""
    alone = (side[:, ::2] < 0) != (side[:, 1::2] < 0)
    answer = np.where(np.repeat(alone, 2, axis=1), -1, side)
    if (answer < 0).all():
        at = int(alone.any(axis=1).argmax())
        name = list(mesh.side_sets)[side[at].max()]
        kind = mesh.side_set_types[name]
        raise MeshError(f"hex {at} has a face on {name!r}, of the type {kind}, and none opposite: expected one layer")
    return answer


def _nodes_of_other_faces(mesh: Mesh, side: np.ndarray) -> np.ndarray:
    """Mark the nodes of faces of the boundary that are not on flat sides, (n,) bool."""
    cells, rows = np.nonzero((mesh.topology.face_neighbours < 0) & (side < 0))
    return mask(face_nodes(mesh.elements, cells, rows).ravel(), mesh.n_nodes)


def _pairs(mesh: Mesh, side: np.ndarray, axis: int) -> tuple[np.ndarray, np.ndarray]:
    """Ends of the edges of hexes along an axis between two flat sides, and the side sets; (k, 2) int64 each."""
    hexes = np.flatnonzero(side[:, 2 * axis] >= 0)
    edges = EDGES[4 * axis : 4 * axis + 4]
    sides = side[hexes, 2 * axis : 2 * axis + 2]
    return mesh.hexes[hexes][:, edges].reshape(-1, 2).astype(np.int64), np.repeat(sides, 4, axis=0)


def _directions(mesh: Mesh, one: np.ndarray, other: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Directions, (3,), from nodes to opposite ones, and the rows of each, (k,) bool; they are at right angles."""
    lines = mesh.points[other] - mesh.points[one]
    length = np.linalg.norm(lines, axis=1)
    if (length == 0).any():
        at = int((length == 0).argmax())
        raise MeshError(f"the opposite nodes {one[at]} and {other[at]} are in one place: expected a layer of hexes")
    units = lines / length[:, None]
    found, left = [], np.ones(len(units), dtype=bool)
    while left.any():
        normal = units[left.argmax()]
        rows = left & (np.abs(units @ normal) > 0.5)
        deviation = np.linalg.norm(np.cross(units[rows], normal), axis=1)
        if deviation.max() > _PARALLEL:
            at, first = np.flatnonzero(rows)[deviation.argmax()], left.argmax()
            angle = np.degrees(np.arcsin(min(deviation.max(), 1)))
            raise MeshError(
                f"the nodes {one[at]} and {other[at]} are not opposite each other: the line between them is inclined "
                f"by {angle:.3g} degrees to that of the nodes {one[first]} and {other[first]}"
            )
        axis = np.abs(normal).argmax()
        along = np.delete(lines[rows], axis, axis=1)
        exact = np.abs(along).max() <= _ROUNDING * length[rows].min()
        found.append((np.eye(3)[axis] if exact else normal, rows))
        left &= ~rows
    return found


def _translated(one: np.ndarray, other: np.ndarray, normal: np.ndarray, moves: np.ndarray) -> LinearMotion:
    """Motion of opposite nodes in two parallel planes."""
    chosen = moves[one] & moves[other]
    one, other = one[chosen], other[chosen]
    planes = LinearMotion.in_planes(np.unique(np.concatenate([one, other])), normal)
    return planes.merge(LinearMotion.tying(other, one))


def _rotated(mesh: Mesh, pairs: np.ndarray, first: str, second: str) -> LinearMotion:
    """Motion of opposite nodes in the two planes of a wedge; nodes on the axis stay."""
    if first == second:
        raise MeshError(f"both sides of the wedge are in {first!r}: expected two side sets")
    normal, image = (_normal(mesh, name) for name in (first, second))
    rotation = smallest_rotation(-normal, image)
    one, other = pairs[pairs[:, 0] != pairs[:, 1]].T
    gap = mesh.points[other] - mesh.points[one] @ rotation.T
    gap -= gap.mean(axis=0) if len(gap) else 0.0  # the axis need not go through the origin
    deviation = np.linalg.norm(gap, axis=1) / (mesh.mean_edge_length or 1.0)
    if deviation.max(initial=0) > 1e3 * _PARALLEL:
        at = int(deviation.argmax())
        raise MeshError(
            f"node {other[at]} of {second!r} is {deviation[at]:.3g} mean edge lengths from the image of node {one[at]} "
            f"of {first!r} under the rotation of the wedge"
        )
    return LinearMotion.in_planes(one, normal).merge(LinearMotion.tying(other, one, rotation))


def _normal(mesh: Mesh, name: str) -> np.ndarray:
    """Unit normal of the plane of a side set, out of the mesh, (3,)."""
    rows = mesh.side_sets[name]
    x = mesh.points[mesh.hexes[rows[:, :1], FACES[rows[:, 1]]]]
    area = np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1]).sum(axis=0)
    size = np.linalg.norm(area)
    if size == 0:
        raise MeshError(f"the side {name!r} has no area: expected a plane")
    middle = x.reshape(-1, 3) - x.reshape(-1, 3).mean(axis=0)
    distance = np.abs(middle @ (area / size)).max() / (mesh.mean_edge_length or 1.0)
    if distance > 1e3 * _PARALLEL:
        raise MeshError(f"the side {name!r} is not flat: a node is {distance:.3g} mean edge lengths from its plane")
    return area / size
