"""Recognition of uniform refinements, and interpolation from the coarse mesh."""

import numpy as np
import pytest

from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology.refinement import find_refinement
from tests.core.grids import grid
from tests.core.refined_meshes import refined, renumbered

COARSE = {
    "one hex": lambda: grid(1),
    "odd counts": lambda: grid(3, 1, 5),
    "five-side": lambda: make("five-side", size=40),
    "bridge-sharp": lambda: make("bridge-sharp", size=200),
    "two components": lambda: two(grid(2), grid(1)),
    "ring": lambda: ring(3),
}


def two(one, other):
    return Mesh(
        np.concatenate([one.points, other.points + 100.0]), np.concatenate([one.hexes, other.hexes + one.n_nodes])
    )


def ring(n):
    """n hexes around an axis: no node has an odd number of hexes."""
    whole = grid(n, 1, 1)
    angle, radius = whole.points[:, 0] * 2 * np.pi / n, 2 + whole.points[:, 1]
    points = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), whole.points[:, 2]])
    last, first = (np.flatnonzero(whole.points[:, 0] == end) for end in (n, 0))
    number = np.arange(whole.n_nodes)
    number[last] = first
    used, hexes = np.unique(number[whole.hexes], return_inverse=True)
    return Mesh(points[used], hexes.reshape(-1, 8).astype(np.int32))


def as_sets(hexes):
    return {frozenset(nodes) for nodes in hexes.tolist()}


@pytest.mark.parametrize("name", [name for name in COARSE if name != "ring"])
def test_the_coarse_mesh_is_found_however_the_fine_one_is_numbered(name):
    coarse = COARSE[name]()
    fine, number = renumbered(refined(coarse), 1)
    found = find_refinement(fine.topology)
    assert set(found.vertices.tolist()) == set(number[np.unique(coarse.hexes)].tolist())
    assert as_sets(found.vertices[found.hexes]) == as_sets(number[coarse.hexes])
    again = Mesh(fine.points[found.vertices], found.hexes)
    assert again.quality().inverted == coarse.quality().inverted


@pytest.mark.parametrize("name", COARSE)
def test_interpolation_reproduces_the_trilinear_map(name):
    fine, _ = renumbered(refined(COARSE[name]()), 1)
    found, values = find_refinement(fine.topology), np.full(fine.points.shape, np.nan)
    values[found.vertices] = fine.points[found.vertices]
    found.interpolate(values, np.zeros(fine.n_nodes, dtype=bool))
    if name != "ring":  # of which the other half may be taken
        np.testing.assert_allclose(values, fine.points, atol=1e-12)
    assert np.isfinite(values).all()


def test_nodes_inside_follow_those_that_are_kept():
    fine, _ = renumbered(refined(grid(1)), 2)
    found, boundary = find_refinement(fine.topology), fine.topology.boundary
    x, y, z = fine.points.T
    # The transfinite map of a hex reproduces what is linear along one of its axes at least.
    given = np.column_stack([x + y**2 * z**2, y + x**2 * z**2, z + x**2 * y**2])
    values = np.where(boundary[:, None], given, 0.0)
    found.interpolate(values, boundary)
    np.testing.assert_allclose(values, given, atol=1e-14)


def removed(mesh, hex):
    hexes = np.delete(mesh.hexes, hex, axis=0)
    used, hexes = np.unique(hexes, return_inverse=True)
    return Mesh(mesh.points[used], hexes.reshape(-1, 8).astype(np.int32))


@pytest.mark.parametrize(
    "mesh",
    [
        grid(1),
        grid(3),
        grid(2, 2, 3),
        grid(4, 4, 5),
        removed(grid(4), [0]),
        removed(grid(4), np.arange(8)),
        removed(grid(4), [21, 22, 25, 26, 37, 38, 41, 42]),
        two(grid(2), grid(3)),
        make("five-side", size=40),
    ],
    ids=lambda mesh: f"{mesh.n_hexes} hexes",
)
def test_other_meshes_are_no_refinements(mesh):
    assert find_refinement(mesh.topology) is None


def test_a_hex_that_is_connected_otherwise_is_noticed():
    mesh = grid(4)
    hexes = mesh.hexes.copy()
    hexes[21, 6] = hexes[0, 0]
    assert find_refinement(Mesh(mesh.points, hexes).topology) is None
