"""Uniform refinements of meshes, numbered at random."""

import itertools

import numpy as np

from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.mesh import Mesh

_CORNERS = UNIT_CUBE.astype(int)


def refined(mesh: Mesh, chosen: np.ndarray | None = None) -> Mesh:
    """Divide each hex, or those chosen (m,) bool, into 2 x 2 x 2, by its trilinear map; the mesh's nodes come first."""
    numbers: dict[tuple[int, ...], int] = {}
    for node in range(mesh.n_nodes):
        numbers[(node,)] = node
    points, hexes = list(mesh.points), [] if chosen is None else mesh.hexes[~chosen].tolist()
    for nodes in mesh.hexes[... if chosen is None else chosen].tolist():
        lattice = {}
        for at in itertools.product((0, 1, 2), repeat=3):
            near = [nodes[c] for c in range(8) if all(p in (1, 2 * q) for p, q in zip(at, _CORNERS[c], strict=True))]
            key = tuple(sorted(near))
            if key not in numbers:
                numbers[key] = len(points)
                points.append(mesh.points[near].mean(axis=0))
            lattice[at] = numbers[key]
        hexes += [[lattice[tuple(low + c)] for c in _CORNERS] for low in _CORNERS]
    return Mesh(np.array(points), np.array(hexes, np.int32))


def rotations() -> list[list[int]]:
    """The 24 numberings of the corners of a hex that are rotations of it."""
    found = []
    for axes in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            turn = np.eye(3, dtype=int)[list(axes)] * signs
            if round(np.linalg.det(turn)) == 1:
                turned = ((2 * _CORNERS - 1) @ turn + 1) // 2
                found.append([int(np.flatnonzero((corner == _CORNERS).all(axis=1))[0]) for corner in turned])
    return found


def renumbered(mesh: Mesh, seed: int) -> tuple[Mesh, np.ndarray]:
    """Number nodes, hexes and the corners of hexes at random; also returns the new number of each node."""
    rng, turns = np.random.default_rng(seed), np.array(rotations())
    number = rng.permutation(mesh.n_nodes)
    points = np.empty_like(mesh.points)
    points[number] = mesh.points
    hexes = number[mesh.hexes][rng.permutation(mesh.n_hexes)]
    hexes = np.take_along_axis(hexes, turns[rng.integers(24, size=len(hexes))], axis=1)
    return Mesh(points, hexes.astype(np.int32)), number
