"""Meshes of wedges, pyramids and tetrahedra for tests: lattices of ideal cells, and the gallery's of all kinds."""

import itertools

import numpy as np

from hexmend.gallery import make
from hexmend.mesh.cells import Cells
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import HEXAHEDRON, PYRAMID, SOLID_BLOCKS, WEDGE
from tests.core.grids import grid

HEXES = np.empty((0, 8), np.int32)


def single(kind) -> Mesh:
    """Make one ideal cell of a kind of `SOLID_KINDS`."""
    points = np.zeros((kind.nodes, 3))
    points[kind.corners[0, 1:]] = kind.ideal.T
    if kind is HEXAHEDRON:
        return grid(1)
    if kind is WEDGE:
        points[[4, 5]] = points[[1, 2]] + points[3]
    if kind is PYRAMID:
        points[2] = points[1] + points[3]
    block = next(name for name, of in SOLID_BLOCKS.items() if of is kind)
    return Mesh(points, HEXES, cells=(Cells(block, np.arange(kind.nodes)[None]),))


def prisms(n: int) -> Mesh:
    """Make a lattice of equilateral prisms whose edges are 1."""
    number = np.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)  # k, j, i
    k, j, i = np.indices(number.shape)
    points = np.stack([i + j / 2, j * np.sqrt(3) / 2, k], axis=-1).reshape(-1, 3)
    low, high = slice(None, -1), slice(1, None)
    floors = [[(low, low), (low, high), (high, low)], [(low, high), (high, high), (high, low)]]
    columns = [[number[(of, *place)].ravel() for of in (low, high) for place in floor] for floor in floors]
    return Mesh(points, HEXES, cells=(Cells("wedge", np.concatenate([np.stack(one, axis=1) for one in columns])),))


def honeycomb(n: int) -> Mesh:
    """Make the tetrahedral-octahedral honeycomb, octahedra cut into two pyramids; edges are the root of 2."""
    places: dict[tuple[int, ...], int] = {}
    pyramids, tetrahedra, unit = [], [], np.eye(3, dtype=int)

    def at(place) -> int:
        return places.setdefault(tuple(map(int, place)), len(places))

    for centre in itertools.product(range(n + 1), repeat=3):
        outside = [axis for axis in range(3) if centre[axis] in (0, n)]
        if sum(centre) % 2 == 0 or len(outside) > 1:
            continue
        axis = outside[0] if outside else 2
        u, v, w = (unit[(axis + k) % 3] for k in (1, 2, 0))
        base = [at(centre + step) for step in (u, v, -u, -v)]
        if not outside or centre[axis] == 0:
            pyramids.append([*base, at(centre + w)])
        if not outside or centre[axis] == n:
            pyramids.append([*base[::-1], at(centre - w)])
    for low in itertools.product(range(n), repeat=3):
        corners = [np.add(low, step) for step in itertools.product((0, 1), repeat=3) if (sum(low) + sum(step)) % 2 == 0]
        if np.linalg.det(np.array(corners[1:]) - corners[0]) < 0:
            corners[2:] = corners[:1:-1]
        tetrahedra.append([at(corner) for corner in corners])
    points = np.array(list(places), dtype=float)
    return Mesh(points, HEXES, cells=(Cells("pyramid", np.array(pyramids)), Cells("tetra", np.array(tetrahedra))))


def mixed(n: int) -> Mesh:
    """Make the gallery's mesh of all kinds, of n^3 cubes of size 1."""
    mesh = make("mixed", size=n**3 + 7 * n**2 - 6 * n)
    return mesh.with_points(n * mesh.points)
