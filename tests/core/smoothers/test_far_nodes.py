"""A node that is absurdly far away: no method warns, gives coordinates that are not numbers, or moves what is fixed."""

import numpy as np
import pytest

from hexmend import METHODS, MeshError, StoppingCriteria, advise, read, smooth, write
from hexmend.boundary import SlidingBoundary
from hexmend.cli.main import main
from tests.core.grids import grid

#: Of a grid of 4 x 4 x 4 hexes: a node inside, one within a side, and a corner.
PLACES = {"inside": [2, 2, 2], "side": [2, 2, 0], "corner": [0, 0, 0]}


def with_far_node(place, far):
    mesh = grid(4)
    points = mesh.points.copy()
    (node,) = np.flatnonzero((points == PLACES[place]).all(axis=1))
    points[node, 0] = far
    return mesh.with_points(points), node


@pytest.mark.parametrize("turn", range(3))
@pytest.mark.parametrize("name", METHODS)
def test_every_method_ends_with_finite_coordinates(name, turn):
    """Each method meets each place, each distance and each kind of boundary, but not all of their combinations."""
    number = list(METHODS).index(name) + turn
    place, far = list(PLACES)[turn], [1e15, 1e30, -1e70][number % 3]
    boundary = ["fixed", "slide"][number % 2]
    mesh, _ = with_far_node(place, far)
    exponent = {"p": 32.0} if turn == 0 and "p" in METHODS[name]().values() else {}
    method = METHODS[name](boundary=boundary, **exponent)
    result = smooth(mesh, method, StoppingCriteria(max_iterations=6))
    assert all(row["objective"] is None or np.isfinite(row["objective"]) for row in result.history)
    assert np.isfinite(result.mesh.points).all()
    assert result.after.inverted <= result.before.inverted
    if boundary == "fixed":
        np.testing.assert_array_equal(result.mesh.points[mesh.fixed], mesh.points[mesh.fixed])
    assert advise(result).reason


def test_mend_brings_an_inner_node_back_and_leaves_a_fixed_one_where_it_is():
    mesh, _ = with_far_node("inside", 1e30)
    assert smooth(mesh, "mend").after.q_min == pytest.approx(1)
    mesh, node = with_far_node("side", 1e30)
    result = smooth(mesh, "mend")
    assert result.mesh.points[node].tolist() == [1e30, 2, 0]
    assert result.after.inverted <= result.before.inverted


@pytest.mark.parametrize(("name", "boundary"), [("global-nr", "slide"), ("mend", "fixed")])
def test_the_command_line_says_nothing_on_standard_error(tmp_path, capsys, name, boundary):
    path, out = tmp_path / "far.vtk", tmp_path / "out.vtk"
    write(path, with_far_node("inside", 1e30)[0])
    assert main(["info", str(path)]) == 0
    assert main(["smooth", str(path), "-o", str(out), "--method", name, "--boundary", boundary]) in (0, 4)
    said = capsys.readouterr()
    assert "Warning" not in said.err
    assert "closest" not in said.err
    assert np.isfinite(read(out).points).all()


@pytest.mark.parametrize("wrong", [np.nan, np.inf, 1e200, -1e200])
def test_a_node_that_cannot_slide_is_named(wrong):
    sliding = SlidingBoundary(grid(2))
    x = sliding.mesh.points[sliding.nodes].copy()
    x[3, 1] = wrong
    said = rf"node {sliding.nodes[3]} cannot slide: no place of the surface is closest to \[.*{wrong}.*pin it\."
    with pytest.raises(MeshError, match=said.replace("+", r"\+")):
        sliding.project(x)


# A mesh all of whose nodes are in one place: no method has anything to go by, and none fails.


@pytest.mark.parametrize("place", [0.0, 3.0])
@pytest.mark.parametrize("name", METHODS)
def test_every_method_ends_on_a_mesh_without_extent(name, place):
    mesh = grid(2)
    mesh = mesh.with_points(np.full_like(mesh.points, place))
    assert mesh.mean_edge_length == 0
    result = smooth(mesh, name, StoppingCriteria(max_iterations=3))
    assert result.after.inverted == 8
    assert np.isfinite(result.mesh.points).all()
    np.testing.assert_array_equal(result.mesh.points[mesh.fixed], mesh.points[mesh.fixed])
