"""What no method that lets the boundary slide does: turn a quad of it over, or leave the room around the surface."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import METHODS, StoppingCriteria, smooth
from hexmend.boundary import SlidingBoundary, surface_change
from tests.core.boundary.solids import ball, cylinder, slid, wavy
from tests.core.grids import grid

METHOD = st.sampled_from(sorted(METHODS))
SOLIDS = {
    "block": lambda: grid(3, 2, 4),
    "cylinder": lambda: cylinder(16, 3),
    "ball": lambda: ball(3),
    "wavy": lambda: wavy(grid(4), 0.3),
}
SOLID = st.sampled_from(sorted(SOLIDS))
SEED = st.integers(0, 2**32 - 1)


def sides(points, sliding):
    """By how much each of the boundary's quads faces outward, as the sine between its diagonals seen from there, (k,)."""
    x = points[sliding.boundary.faces]
    one, other = x[:, 2] - x[:, 0], x[:, 3] - x[:, 1]
    size = np.linalg.norm(one, axis=1) * np.linalg.norm(other, axis=1)
    return np.einsum("kj,kj->k", np.cross(one, other), sliding.outward) / np.maximum(size, np.finfo(float).tiny)


@pytest.mark.slow
@given(name=METHOD, solid=SOLID, amplitude=st.sampled_from([0.2, 0.6, 1.0]), seed=SEED)
def test_no_step_turns_a_quad_over(name, solid, amplitude, seed):
    mesh = slid(SOLIDS[solid](), amplitude, seed)
    sliding = SlidingBoundary(mesh)
    before = sides(mesh.points, sliding)
    method = METHODS[name](boundary="slide", surface_tolerance="unlimited")
    for step in itertools.islice(method.steps(mesh), 8):
        after = sides(step.points, sliding)
        if not step.infeasible:
            assert not ((before > 1e-6) & (after < -1e-6)).any()
            before = after


@pytest.mark.parametrize("name", ["laplacian", "getme", "local-nr", "mend"])
def test_a_node_beyond_its_neighbour_finds_its_way_back(name):
    cube = grid(4)
    points = cube.points.copy()
    node = int(np.flatnonzero((cube.points == [2, 2, 0]).all(axis=1))[0])
    points[node, 0] += 1.4  # two quads lie over each other, none is turned as a whole
    mesh = cube.with_points(points)
    result = smooth(
        mesh, METHODS[name](boundary="slide", surface_tolerance="unlimited"), StoppingCriteria(max_iterations=200)
    )
    assert (sides(result.mesh.points, SlidingBoundary(cube)) > 0.5).all()
    assert np.linalg.norm(result.mesh.points[node] - cube.points[node]) < 0.5
    np.testing.assert_array_equal(result.mesh.points[:, 2][cube.points[:, 2] == 0], 0)


def test_a_quad_that_is_turned_may_stay_so_and_be_turned_back():
    mesh = grid(4)
    sliding, folded = SlidingBoundary(mesh), mesh.points.copy()
    node = int(np.flatnonzero((folded == [2, 2, 0]).all(axis=1))[0])
    folded[node, :2] += 1.4  # beyond the opposite corner of a quad
    assert sliding.flipped_quads(mesh.points, folded).size == 1
    assert not sliding.flipped_quads(folded, folded).size
    assert not sliding.flipped_quads(folded, mesh.points).size
    np.testing.assert_array_equal(sliding.reject_moves(mesh.points, folded), mesh.points)


@pytest.mark.slow
@given(
    name=METHOD, solid=SOLID, amplitude=st.sampled_from([0.0, 0.3, 0.8]), tolerance=st.sampled_from([0.02, 0.1, 0.3]),
    seed=SEED,
)  # fmt: skip
def test_the_boundary_stays_in_its_room_both_ways(name, solid, amplitude, tolerance, seed):
    mesh = slid(SOLIDS[solid](), amplitude, seed)
    method = METHODS[name](boundary="slide", surface_tolerance=tolerance)
    result = smooth(mesh, method, StoppingCriteria(max_iterations=10, keep_last=True))
    assert surface_change(mesh, result.mesh).max <= tolerance * (1 + 1e-4)


@pytest.mark.slow
@given(name=METHOD, solid=SOLID, amplitude=st.sampled_from([0.0, 0.3, 0.8]), seed=SEED)
def test_with_a_tolerance_of_0_the_boundary_stays_on_its_surface(name, solid, amplitude, seed):
    mesh = slid(SOLIDS[solid](), amplitude, seed)
    method = METHODS[name](boundary="slide", surface_tolerance=0)
    result = smooth(mesh, method, StoppingCriteria(max_iterations=10, keep_last=True))
    assert result.surface.max < 1e-7
    assert abs(result.surface.volume_change) < 1e-7
