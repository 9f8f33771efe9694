"""Octree meshes: hanging nodes stay at the mean of the nodes between which they hang, in every method."""

import numpy as np
import pytest

import hexmend as hx
from hexmend import METHODS, LinearMotion, Mesh, ParameterError
from hexmend.ranks.rank_run import check_mesh
from tests.core.grids import grid
from tests.core.linear_motions import scrambled_within
from tests.core.refined_meshes import refined

SIZE = 4


def octree(levels: int = 1) -> Mesh:
    """Make a grid of cubes that are refined in the middle and at an edge, and again in the very middle."""
    mesh = grid(SIZE)
    for level in range(levels):
        away = mesh.points[mesh.hexes].mean(axis=1) - SIZE / 2
        middle = (np.abs(away) < 1.01 / 2**level).all(axis=1)
        mesh = refined(mesh, middle | (level == 0) & (away[:, 0] > 1) & (away[:, 1] < 0))
    return mesh


def gaps(mesh: Mesh) -> float:
    """Largest distance of a hanging node from the mean of its masters."""
    rows = mesh.topology.hanging
    return np.abs(mesh.points[rows[:, 0]] - mesh.points[rows[:, 1:]].mean(axis=1)).max()


@pytest.mark.parametrize("levels", [1, 2])
def test_only_the_outside_of_a_refined_mesh_is_boundary(levels):
    mesh = octree(levels)
    outside = np.isin(mesh.points, (0, SIZE)).any(axis=1)
    np.testing.assert_array_equal(mesh.topology.boundary, outside)
    np.testing.assert_array_equal(mesh.fixed, outside)
    assert gaps(mesh) == 0
    rows = mesh.topology.hanging
    between = mesh.topology.edges[:, None, :] == rows[:, :1]  # a node that hangs is never a corner of its masters' cell
    assert len(rows) > 50
    assert between.any(axis=(0, 2)).all()
    assert not grid(3).topology.hanging.size


@pytest.mark.parametrize("method", METHODS)
def test_every_method_keeps_hanging_nodes_in_the_middle_and_improves(method):
    mesh = scrambled_within(octree(), 0.3, 1)
    assert gaps(mesh) < 1e-15
    assert mesh.quality().inverted
    result = hx.smooth(mesh, method)
    assert gaps(result.mesh) < 1e-14
    assert not result.after.invalid
    assert result.after.q_min > 0.95
    np.testing.assert_array_equal(result.mesh.points[mesh.fixed], mesh.points[mesh.fixed])


@pytest.mark.parametrize("method", ["mend", "global-nr", "local-mnr"])
def test_several_levels_end_at_the_perfect_octree(method):
    perfect = octree(2)
    result = hx.smooth(scrambled_within(perfect, 0.2, 2), method, hx.StoppingCriteria(tolerance=1e-10))
    assert np.abs(result.mesh.points - perfect.points).max() < 1e-4


@pytest.mark.parametrize("method", [name for name in METHODS if "boundary" in METHODS[name]().values()])
def test_hanging_nodes_of_a_sliding_boundary_follow_its_nodes(method):
    perfect = octree()
    inside = ~np.isin(perfect.points, (0, SIZE))
    moved = perfect.points + inside * np.random.default_rng(1).uniform(-0.2, 0.2, inside.shape)
    moving = perfect.with_linear_motion(LinearMotion.in_planes(np.arange(perfect.n_nodes), [0, 0, 1.0]))
    mesh = perfect.with_points(moving.with_fixed(np.zeros(len(moved), bool)).constrained(moved))
    result = hx.smooth(mesh, method, boundary="slide")
    assert gaps(result.mesh) < 1e-14
    assert not result.after.invalid
    assert result.after.q_mean > result.before.q_mean + 0.09
    on_sides = mesh.topology.boundary
    assert (result.mesh.points != mesh.points)[on_sides].any()


def test_what_holds_a_hanging_node_holds_those_between_which_it_hangs():
    mesh = scrambled_within(octree(), 0.2)
    row = next(row for row in mesh.topology.hanging if mesh.free[row].all())
    pinned = mesh.replace(pinned=np.arange(mesh.n_nodes) == row[0])
    assert pinned.fixed[row].all()
    free = mesh.with_fixed(np.ones(mesh.n_nodes, bool)).with_free(np.arange(mesh.n_nodes) == row[1])
    assert free.free[row[:2]].all()
    np.testing.assert_array_equal(hx.smooth(pinned).mesh.points[row], mesh.points[row])


def test_hanging_nodes_outlive_other_motions_and_go_with_the_cells():
    mesh = octree()
    rows = mesh.topology.hanging
    motion = LinearMotion.in_planes(np.flatnonzero(mesh.points[:, 0] == 0), [1.0, 0, 0])
    for other in (mesh.with_linear_motion(motion), mesh.with_linear_motion(None), mesh.with_rules(plane=())):
        np.testing.assert_array_equal(np.unique(other.linear_motion.hanging), rows[:, 0])
    coarse = mesh.with_linear_motion(motion).rebuilt(hexes=mesh.hexes[:8])
    assert not coarse.linear_motion.hanging.size
    with pytest.raises(ParameterError, match="linear motion do not run on several MPI ranks"):
        check_mesh(mesh)
