"""Linear motions of small meshes, for tests."""

import numpy as np

from hexmend import LinearMotion, Mesh
from tests.core.grids import grid


def turn(degrees: float, axis: int = 0) -> np.ndarray:
    """Rotation matrix about an axis."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    matrix = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix[i, i], matrix[i, j], matrix[j, i], matrix[j, j] = c, -s, s, c
    return matrix


def face(mesh: Mesh, axis: int, place: float) -> np.ndarray:
    """Nodes at a place of an axis."""
    return np.flatnonzero(mesh.points[:, axis] == place)


def planes(mesh: Mesh, axes: tuple[int, ...] = (0, 1, 2)) -> LinearMotion:
    """Faces of a block of hexes as planes."""
    motion = LinearMotion()
    for axis in axes:
        for end in (mesh.points[:, axis].min(), mesh.points[:, axis].max()):
            motion = motion.merge(LinearMotion.in_planes(face(mesh, axis, end), np.eye(3)[axis]))
    return motion


def in_planes(n: int) -> Mesh:
    """Cube of n^3 hexes of size 1 whose faces are planes."""
    mesh = grid(n)
    return mesh.with_linear_motion(planes(mesh))


def periodic(n: int) -> Mesh:
    """Cube of n^3 hexes of size 1 whose opposite faces are translated copies; a corner stays."""
    mesh = grid(n)
    motion = LinearMotion.keeping([0])
    for axis in range(3):
        motion = motion.merge(LinearMotion.tying(face(mesh, axis, n), face(mesh, axis, 0)))
    return mesh.with_linear_motion(motion)


def square(n: int) -> tuple[Mesh, np.ndarray, np.ndarray, np.ndarray]:
    """Square of n^2 hexes, and the nodes of its front, its back and its sides."""
    mesh = grid(n, n, 1)
    sides = np.flatnonzero(np.isin(mesh.points[:, :2], (0, n)).any(axis=1))
    return mesh, face(mesh, 2, 0), face(mesh, 2, 1), sides


def layer(n: int) -> Mesh:
    """Square of n^2 hexes: its back is tied to its front, z stays; nodes of the sides stay."""
    mesh, front, back, sides = square(n)
    motion = LinearMotion.tying(back, front).merge(LinearMotion.in_planes(front, [0.0, 0, 1]))
    return mesh.with_linear_motion(motion.merge(LinearMotion.keeping(sides)))


def wedge(n: int, degrees: float = 5.0) -> Mesh:
    """Wedge about the x axis of n^2 hexes, in which radii go from n to 2 n: its back is its front, turned."""
    mesh, front, back, sides = square(n)
    points = mesh.points.copy()
    points[:, 1] += n
    points[:, 2] = 0.0
    half, rotation = turn(-degrees / 2), turn(degrees)
    points = points @ half.T
    points[back] = points[front] @ rotation.T
    motion = LinearMotion.tying(back, front, rotation)
    motion = motion.merge(LinearMotion.in_planes(front, half @ [0.0, 0, 1])).merge(LinearMotion.keeping(sides))
    return mesh.with_points(points).with_linear_motion(motion)


#: Meshes with linear motions, by name; each takes the number of hexes along an edge.
CASES = {"planes": in_planes, "periodic": periodic, "layer": layer, "wedge": wedge}


def scrambled_within(mesh: Mesh, amplitude: float, seed: int = 0) -> Mesh:
    """Displace free nodes at random by up to `amplitude` in each direction, within their constraints."""
    shift = np.random.default_rng(seed).uniform(-amplitude, amplitude, mesh.points.shape)
    return mesh.with_points(mesh.constrained(mesh.points + shift * mesh.free[:, None]))
