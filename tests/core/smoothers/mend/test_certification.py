"""Mend makes hexes valid that are invalid between positive corners."""

import numpy as np
import pytest

import hexmend as hx
from hexmend.quality import measure
from tests.core.grids import grid, invalid_inside


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
    "at the optimum of shape": resisting,
}


@pytest.mark.parametrize("name", MESHES)
@pytest.mark.parametrize("goal", ["shape", "balanced"])
def test_a_run_ends_without_invalid_hexes_and_fixed_nodes_stay(name, goal):
    mesh = MESHES[name]()
    result = hx.smooth(mesh, goal=goal)
    assert result.after.invalid == 0
    np.testing.assert_array_equal(result.mesh.points[mesh.fixed], mesh.points[mesh.fixed])


@pytest.mark.parametrize("seed", [1, 6])
def test_no_more_hexes_are_invalid_afterwards_where_some_are_inverted(seed):
    result = hx.smooth(distorted(0.5, seed), goal="shape")
    assert result.before.inverted > 0
    assert result.after.invalid <= result.before.invalid
