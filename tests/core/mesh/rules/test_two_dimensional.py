"""Meshes of one layer: nodes stay in their planes, and the two sides are copies of each other."""

import numpy as np
import pytest

import hexmend as hx
from hexmend import Mesh, MeshError
from hexmend.mesh.rules.two_dimensional import two_dimensional_motion, with_two_dimensional_motion
from tests.core.grids import displaced, grid
from tests.core.linear_motions import scrambled_within


def layer(nx=6, ny=5, axis=2, kind="empty") -> Mesh:
    """One layer of hexes in any plane, with walls around."""
    counts = [nx, ny]
    counts.insert(axis, 1)
    mesh = grid(*counts)
    rows = np.array([(h, 2 * axis + side) for h in range(mesh.n_hexes) for side in (0, 1)])
    hexes, faces = np.nonzero(mesh.topology.face_neighbours < 0)
    others = np.column_stack([hexes, faces])[(faces // 2) != axis]
    return mesh.replace(side_sets={"front": rows, "walls": others}, side_set_types={"front": kind, "walls": "wall"})


def wedge(angle=5.0) -> Mesh:
    """A sector of a pipe wall: a layer between two planes through the x axis."""
    mesh = layer(6, 5, 2, "wedge")
    x, r, side = mesh.points.T
    turn = np.radians(angle) * (side - 0.5)
    points = np.column_stack([x, (r + 2) * np.cos(turn), (r + 2) * np.sin(turn)])
    rows = mesh.side_sets["front"]
    sides = {"back": rows[::2], "front": rows[1::2], "walls": mesh.side_sets["walls"]}
    types = {"back": "wedge", "front": "wedge", "walls": "wall"}
    return Mesh(points, mesh.hexes, side_sets=sides, side_set_types=types)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_inner_nodes_of_both_sides_move_in_their_plane_and_as_one(axis):
    mesh = with_two_dimensional_motion(layer(axis=axis))
    inner = (5 - 1 + 1) * (5 - 1) * 2
    assert mesh.free.sum() == inner
    moved = scrambled_within(mesh, 0.3, 3)
    across = [k for k in range(3) if k != axis]
    np.testing.assert_array_equal(moved.points[:, axis], mesh.points[:, axis])
    low, high = (moved.points[mesh.points[:, axis] == side][:, across] for side in (0, 1))
    np.testing.assert_array_equal(low, high)
    assert (moved.points != mesh.points).any(axis=1).sum() == inner


@pytest.mark.parametrize(("method", "boundary"), [("laplacian", "fixed"), ("mend", "slide")])
def test_methods_keep_the_two_sides_congruent_to_the_last_bit(method, boundary):
    mesh = scrambled_within(with_two_dimensional_motion(layer()), 0.6, 3)
    result = hx.smooth(mesh, method, boundary=boundary, max_iterations=20)
    low, high = (result.mesh.points[mesh.points[:, 2] == side] for side in (0, 1))
    np.testing.assert_array_equal(low[:, :2], high[:, :2])
    np.testing.assert_array_equal(result.mesh.points[:, 2], mesh.points[:, 2])
    assert result.after.q_mean > result.before.q_mean
    walls = (mesh.points[:, :2] == 0).any(axis=1) | (mesh.points[:, 0] == 6) | (mesh.points[:, 1] == 5)
    np.testing.assert_array_equal(result.mesh.points[walls], mesh.points[walls])


def test_the_sides_of_a_wedge_are_rotated_copies():
    mesh = with_two_dimensional_motion(wedge())
    start = scrambled_within(mesh, 0.3, 3)
    result = hx.smooth(start, max_iterations=20)
    assert result.after.q_mean > result.before.q_mean
    for points in (start.points, result.mesh.points):
        x, radius, turn = points[:, 0], np.hypot(points[:, 1], points[:, 2]), np.arctan2(points[:, 2], points[:, 1])
        side = layer().points[:, 2] == 0
        np.testing.assert_allclose(x[side], x[~side], atol=1e-13)
        np.testing.assert_allclose(radius[side], radius[~side], atol=1e-13)
        np.testing.assert_allclose(turn[side], -np.radians(2.5), atol=1e-13)
        np.testing.assert_allclose(turn[~side], np.radians(2.5), atol=1e-13)


def test_two_layers_are_refused_and_stay():
    mesh = grid(2).replace(side_sets={"low": np.array([(h, 4) for h in range(4)])}, side_set_types={"low": "empty"})
    with pytest.raises(MeshError, match="hex 0 has a face on 'low', of the type empty, and none opposite"):
        two_dimensional_motion(mesh)
    stays = with_two_dimensional_motion(mesh)
    assert "hex 0 has a face on 'low'" in stays.notes[-1]
    assert stays.linear_motion is None
    assert with_two_dimensional_motion(stays).notes == stays.notes


def test_sides_that_are_no_copies_are_refused():
    mesh = layer()
    points = mesh.points.copy()
    points[50] += [0.01, 0, 0]
    with pytest.raises(MeshError, match=r"not opposite each other: the line between them is inclined by 0\.57"):
        two_dimensional_motion(mesh.with_points(points))
    mesh = wedge()
    with pytest.raises(MeshError, match="from the image of node"):
        two_dimensional_motion(displaced(mesh, 50, [0.1, 0, 0]))
    with pytest.raises(MeshError, match="both sides of the wedge are in 'front'"):
        two_dimensional_motion(layer(kind="wedge"))
