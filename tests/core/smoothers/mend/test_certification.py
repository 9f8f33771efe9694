"""The last stage of mend: hexes that are invalid between positive corners become valid."""

import numpy as np
import pytest

import hexmend as hx
from hexmend.energy import MeshEnergy
from hexmend.quality import measure
from hexmend.smoothers.mend import stages
from hexmend.smoothers.mend.certification import certify_hexes
from hexmend.smoothers.mend.inversion import inverted_corners
from tests.core.grids import grid, invalid_inside


def certified(mesh):
    """Return the points that the stage ends at, and its steps."""
    energy = MeshEnergy(mesh)
    inverted = inverted_corners(mesh.points, mesh.hexes, measure(mesh.points, mesh.hexes))
    stage, steps = certify_hexes(energy.with_objective(energy.norm, inverted), mesh.points), []
    while True:
        try:
            steps.append(next(stage))
        except StopIteration as end:
            return end.value, steps


def distorted(amplitude, seed):
    """Make a grid of 27 hexes with nodes moved at random, those of the boundary too."""
    mesh = grid(3)
    return mesh.with_points(mesh.points + np.random.default_rng(seed).uniform(-amplitude, amplitude, mesh.points.shape))


def pinned(mesh):
    """Pin two of the free nodes of the invalid hex."""
    nodes = mesh.hexes[measure(mesh.points, mesh.hexes).invalid].ravel()
    marks = np.zeros(mesh.n_nodes, dtype=bool)
    marks[nodes[mesh.free[nodes]][:2]] = True
    return mesh.replace(pinned=marks)


def resisting():
    """Make a grid of 12 hexes, one of which is invalid between positive corners where the energy is least."""
    mesh, random = grid(2, 2, 3), np.random.default_rng(6323)
    return mesh.with_points(mesh.points + random.uniform(-0.4, 0.4, mesh.points.shape))


MESHES = {
    "interior": invalid_inside,
    "boundary": lambda: distorted(0.45, 4936),
    "pinned nodes": lambda: pinned(invalid_inside()),
}
every_mesh = pytest.mark.parametrize("mesh", [make() for make in MESHES.values()], ids=MESHES)


@every_mesh
def test_a_hex_that_is_invalid_between_positive_corners_becomes_valid_and_the_least_stays(mesh):
    before = measure(mesh.points, mesh.hexes)
    assert (before.n_inverted, before.n_invalid) == (0, 1)
    points, steps = certified(mesh)
    after = measure(points, mesh.hexes)
    assert after.n_invalid == 0
    assert after.scaled_jacobian.min() >= 0.5 * before.scaled_jacobian.min()
    assert after.q.min() >= 0.5 * before.q.min()
    assert all(step.intermediate for step in steps)


@every_mesh
def test_fixed_nodes_do_not_move(mesh):
    points, _ = certified(mesh)
    np.testing.assert_array_equal(points[mesh.fixed], mesh.points[mesh.fixed])
    assert (points[mesh.free] != mesh.points[mesh.free]).any()


@pytest.mark.parametrize("seed", [1, 6])
def test_no_more_hexes_are_invalid_afterwards_where_some_are_inverted(seed):
    mesh = distorted(0.5, seed)
    before = measure(mesh.points, mesh.hexes)
    assert before.n_inverted > 0
    points, steps = certified(mesh)
    assert measure(points, mesh.hexes).n_invalid <= before.n_invalid
    np.testing.assert_array_equal(steps[-1].points if steps else mesh.points, points)  # the run keeps the last


def test_the_stage_makes_a_hex_valid_that_the_optimum_of_shape_leaves_invalid(monkeypatch):
    def nothing(energy, points):
        return points
        yield

    mesh = resisting()
    assert hx.smooth(mesh, goal="shape").after.invalid == 0
    monkeypatch.setattr(stages, "certify_hexes", nothing)
    optimum = hx.smooth(mesh, goal="shape").after
    assert (optimum.inverted, optimum.invalid) == (0, 1)


@every_mesh
@pytest.mark.parametrize("goal", ["shape", "balanced"])
def test_a_run_of_mend_ends_without_invalid_hexes(mesh, goal):
    assert hx.smooth(mesh, goal=goal).after.invalid == 0
