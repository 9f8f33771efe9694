"""Second-order hexes: their shape functions, and the Jacobian at nodes and Gauss points."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from hexmend import Mesh, io, smooth
from hexmend.mesh.fixing import with_pinned
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.second_order import (
    MID_NODE_POSITIONS,
    MID_NODE_WEIGHTS,
    NODE_POSITIONS,
    jacobian_range,
    lagrange,
    move_mid_nodes,
    serendipity,
)
from hexmend.quality import summarise
from hexmend.quality.validity import Validity, certify
from tests.core.curved_shell import curved_shell

every_function = pytest.mark.parametrize(("functions", "width"), [(serendipity, 20), (lagrange, 27)])
places = arrays(np.float64, (3, 3), elements=st.floats(-0.2, 1.2))


def one(width, moved=None):
    """A mesh of one hex, the unit cube; `moved` is added to its nodes."""
    points = NODE_POSITIONS[:width] + (0 if moved is None else moved)
    mids = np.full((1, 19), -1)
    mids[0, : width - 8] = np.arange(8, width)
    return Mesh(points, [range(8)], mid_nodes=mids)


@every_function
@given(at=places)
def test_functions_place_every_point_where_it_is(functions, width, at):
    values, gradients = functions(at, NODE_POSITIONS[:width])
    np.testing.assert_allclose(values.sum(axis=1), 1, atol=1e-12)
    np.testing.assert_allclose(values @ NODE_POSITIONS[:width], at, atol=1e-12)
    np.testing.assert_allclose(
        np.einsum("kwa,wx->kax", gradients, NODE_POSITIONS[:width]), np.broadcast_to(np.eye(3), (3, 3, 3)), atol=1e-12
    )


@every_function
@given(at=places)
def test_derivatives_are_those_of_differences(functions, width, at):
    step = 1e-6
    gradients = functions(at, NODE_POSITIONS[:width])[1]
    for axis in range(3):
        move = step * np.eye(3)[axis]
        change = functions(at + move, NODE_POSITIONS[:width])[0] - functions(at - move, NODE_POSITIONS[:width])[0]
        np.testing.assert_allclose(gradients[..., axis], change / (2 * step), atol=1e-7)


@pytest.mark.parametrize("width", [20, 27])
def test_a_cube_is_valid_with_a_constant_jacobian_wherever_it_lies(width):
    turn = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    mesh = one(width)
    mesh = mesh.rebuilt(points=1e-3 * mesh.points @ turn + 7)
    assert certify(mesh.points, mesh.hexes, mesh.mid_nodes)[0] == Validity.VALID
    np.testing.assert_allclose(jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes), 1e-9, rtol=1e-9)


@pytest.mark.parametrize("width", [20, 27])
@pytest.mark.parametrize(("shift", "good"), [(0.2, True), (0.26, False)])
def test_a_middle_node_beyond_a_quarter_of_its_edge_makes_the_map_fold(width, shift, good):
    """Along an edge x(u) is a parabola through 0, its middle and 1: its slope at the end is 0 for a middle at 1/4."""
    moved = np.zeros((width, 3))
    moved[8, 0] = shift
    found = summarise(one(width, moved))
    assert found.invalid == int(not good)
    assert (found.min_jacobian > 0) == good


@given(moves=arrays(np.float64, (8, 3), elements=st.floats(-1, 1)))
def test_an_element_that_is_moved_by_its_corners_moves_as_their_map_does(moves):
    mesh = one(27)
    after = move_mid_nodes(
        mesh.points, np.concatenate([UNIT_CUBE + moves, MID_NODE_POSITIONS]), mesh.hexes, mesh.mid_nodes
    )
    shares = np.prod(
        np.where(UNIT_CUBE[None] == 1, MID_NODE_POSITIONS[:, None], 1 - MID_NODE_POSITIONS[:, None]), axis=2
    )
    np.testing.assert_allclose(after[8:], shares @ (UNIT_CUBE + moves), atol=1e-12)


def test_info_and_smooth_say_it(tmp_path, run_command):
    moved = np.zeros((27, 3))
    moved[8, 0] = 0.3
    path, out = tmp_path / "bent.exo", tmp_path / "out.exo"
    io.write(path, one(27, moved))
    found = json.loads(run_command("info", path, "--json").out)
    assert (found["inverted"], found["invalid"], found["next"]) == (0, 1, f"hexmend {path}")
    assert "Not fit for solving: 1 hex of second order" in run_command("smooth", path, "-o", out, status=4).out


@pytest.mark.parametrize("column", [0, 17, 18])
def test_the_corners_of_a_pinned_mid_node_stay_and_so_does_it(column):
    mesh = curved_shell(27, through=5, around=5, along=5)
    inside = np.flatnonzero(mesh.free[mesh.hexes].all(axis=1))[0]
    node, corners = mesh.mid_nodes[inside, column], mesh.hexes[inside, MID_NODE_WEIGHTS[column] > 0]
    pinned = with_pinned(mesh, node)
    np.testing.assert_array_equal(np.flatnonzero(mesh.free & ~pinned.free), np.unique(corners))
    moved = smooth(pinned, "laplacian", max_iterations=3, keep_last=True).mesh.points
    assert (moved != mesh.points).any()
    np.testing.assert_array_equal(moved[node], mesh.points[node])
