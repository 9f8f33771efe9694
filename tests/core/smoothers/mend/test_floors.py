"""Floors that rise: the highest least of a node by brute force, nothing ends lower, and shape above floors.

The goal time-step: the smallest explicit step rises, no hex inverts, and where it starts does not matter.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize

from hexmend.arrays import mask
from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.gallery.gallery_mesh import scramble_nodes
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.quality import measure
from hexmend.quality.corner_heights import least_heights
from hexmend.run import StoppingCriteria, smooth
from hexmend.smoothers.mend.floors import FLOORS, Floors
from hexmend.smoothers.mend.mend import Mend
from tests.core.boundary.solids import wavy
from tests.core.grids import grid, scrambled

SEEDS = pytest.mark.parametrize("seed", range(4))


def floors_of(mesh):
    """Floors at the nodes of a mesh."""
    return Floors(MeshEnergy(mesh, ObjectiveNorm(1.0)), mesh.points)


def risen(floors, *args, **options):
    """Steps of the rise."""
    return list(floors.rise(*args, **options))


def highest(mesh, node, seed):
    """The highest least scaled Jacobian of the corners with a node, by searches without derivatives."""
    corners = mesh.hexes[:, CORNER_TETRAHEDRA].reshape(-1, 4)
    corners = corners[(corners == node).any(axis=1)]

    def fall(at):
        points = mesh.points.copy()
        points[node] = at
        edges = points[corners[:, 1:]] - points[corners[:, :1]]
        return -(np.linalg.det(edges) / np.linalg.norm(edges, axis=2).prod(axis=1)).min()

    best = mesh.points[node]
    for start in [best, *np.random.default_rng(seed).uniform(0.7, 1.3, (6, 3))]:
        for _ in range(2):  # again from where it ended, as a simplex may have collapsed
            start = minimize(fall, start, method="Nelder-Mead", options={"xatol": 1e-6, "fatol": 1e-8}).x
        best = min(best, start, key=fall)
    return -fall(best)


@SEEDS
def test_one_node_rises_to_the_highest_least(seed):
    mesh = wavy(grid(2), 0.2, seed)
    assert np.flatnonzero(mesh.free) == [13]
    floors = floors_of(mesh)
    start = floors.values.jacobian
    risen(floors)
    assert floors.values.jacobian > start + 0.01
    assert floors.values.jacobian == pytest.approx(highest(mesh, 13, seed), rel=0.01)


@SEEDS
@pytest.mark.parametrize("quality_floor", [-np.inf, 0.9, 0.97])
def test_it_never_ends_lower_than_it_began(seed, quality_floor):
    floors = floors_of(scrambled(wavy(grid(3), 0.12, seed), 0.15, seed))
    start = floors.values
    steps = risen(floors, quality_floor)
    end = floors.values
    assert end.jacobian >= start.jacobian
    assert end.quality >= min(quality_floor, start.quality)
    np.testing.assert_array_equal(steps[-1].points, floors.points)


@SEEDS
def test_shape_above_floors_keeps_both_and_lowers_the_energy(seed):
    mesh = scrambled(wavy(grid(4), 0.1, seed), 0.2, seed)
    floors = floors_of(mesh)
    risen(floors)
    top, energy = floors.values, floors.energy
    low = 0.9 * top.jacobian, 0.9 * top.quality
    list(floors.relax(*low, everywhere=True))
    end = floors.values
    assert end.jacobian > low[0]
    assert end.quality > low[1]
    assert energy.value(end.x) < energy.value(top.x)


@SEEDS
def test_it_ends_where_enough_is_reached(seed):
    mesh = scrambled(wavy(grid(4), 0.1, seed), 0.15, seed)
    whole, early = floors_of(mesh), floors_of(mesh)
    steps = risen(whole)
    enough = (early.values.jacobian + whole.values.jacobian) / 2
    few = risen(early, enough=enough)
    assert early.values.jacobian >= enough
    assert len(few) < len(steps)


@pytest.mark.parametrize("shift", [[0.0, 0.0, 0.0], [0.3, 0.1, -0.2], [0.3, 0.3, 0.3]])
def test_corners_that_hold_the_floor_are_found_whether_one_or_all_are_equal(shift):
    lattice = grid(2)
    points = lattice.points.copy()
    points[lattice.free] += shift
    floors = floors_of(lattice.with_points(points))
    active, quality = floors.active_set(), measure(points, lattice.hexes)
    assert len(active.hexes) == (1 if any(shift) else 32)
    assert quality.scaled_jacobian[active.hexes] == pytest.approx(floors.values.jacobian, rel=1e-12)


def test_nodes_far_from_the_lowest_hexes_stay():
    lattice = grid(14)
    far = np.abs(lattice.points - 7).max(axis=1)
    points = wavy(lattice, 0.01).points.copy()
    points[far == 0] += [0.4, 0.3, 0.2]
    floors = floors_of(lattice.with_points(points))
    start = floors.values.jacobian
    risen(floors, enough=0.8)
    assert 0 < start < 0.4 < 0.8 <= floors.values.jacobian
    list(floors.relax(0.7, 0.5))
    has_moved = np.abs(floors.points - points).max(axis=1) > 1e-12
    assert has_moved[far == 0].all()
    around = floors.touched
    assert around.mean() < 0.1
    for _ in range(FLOORS.rings):
        around = mask(lattice.hexes[around], lattice.n_nodes)[lattice.hexes].any(axis=1)
    assert not has_moved[~mask(lattice.hexes[around], lattice.n_nodes)].any()
    now, near = measure(floors.points, lattice.hexes), (far[lattice.hexes] <= FLOORS.rings).all(axis=1)
    np.testing.assert_allclose(floors.values.jacobians[near], now.scaled_jacobian[near], rtol=1e-12)
    np.testing.assert_allclose(floors.values.qualities[near], now.q[near], rtol=1e-12)


def graded(n, amplitude=0.0, seed=0):
    """A block whose hexes grow along x by a factor of 1.6 each, scrambled."""
    mesh = grid(n)
    points = mesh.points.copy()
    points[:, 0] = 1.6 ** points[:, 0]
    return scramble_nodes(mesh.with_points(points), amplitude, seed)


def step_of(mesh):
    return least_heights(mesh.points, mesh.hexes).min()


@pytest.mark.parametrize("amplitude", [0.15, 0.6])
def test_the_smallest_step_rises_above_that_of_the_optimum_of_shape(amplitude):
    mesh = graded(6, amplitude, 1)
    shape, raised = (smooth(mesh, Mend(goal=goal)) for goal in ("shape", "time-step"))
    assert raised.after.inverted == 0
    assert step_of(raised.mesh) > 1.1 * step_of(shape.mesh) > step_of(mesh)
    assert "The minimum time step of the corners that can be moved is " in raised.message
    assert step_of(raised.mesh) > 0.59


def test_a_block_that_is_at_its_optimum_stays():
    mesh = graded(4)
    result = smooth(mesh, Mend(goal="time-step"))
    assert step_of(result.mesh) >= step_of(mesh)


@given(
    st.floats(0, 0.8),
    st.sampled_from([1, 4, 12, 60]),
    st.sampled_from(["fixed", "slide"]),
    st.integers(0, 2**32 - 1),
)
def test_it_does_no_harm_wherever_it_is_stopped(amplitude, iterations, boundary, seed):
    mesh = graded(3, amplitude, seed)
    method = Mend(goal="time-step", boundary=boundary)
    result = smooth(mesh, method, StoppingCriteria(max_iterations=iterations))
    assert result.after.inverted <= result.before.inverted
    if result.after.inverted == result.before.inverted:
        assert step_of(result.mesh) >= step_of(mesh)
    if boundary == "fixed":
        np.testing.assert_array_equal(result.mesh.points[mesh.fixed], mesh.points[mesh.fixed])


def test_the_size_of_the_mesh_does_not_matter():
    mesh = graded(4, 0.3, 5)
    large = mesh.with_points(1e6 * mesh.points)
    one, other = (step_of(smooth(some, Mend(goal="time-step")).mesh) for some in (mesh, large))
    assert other == pytest.approx(1e6 * one, rel=0.01)
