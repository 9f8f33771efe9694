"""A node that is absurdly far away: no method warns, gives coordinates that are not numbers, or moves what is fixed.

The line search of a node that slides.

Optimisers with a target of the elements: layers stay, scrambled ones return, and the target decides what is kept.
"""

import itertools

import numpy as np
import pytest

from hexmend import METHODS, MeshError, StoppingCriteria, Target, advise, iterate, read, smooth, write
from hexmend.boundary import SlidingBoundary
from hexmend.cli.main import main
from hexmend.mesh.hexahedron import EDGES
from hexmend.quality import measure, measure_against_target, target_quality
from tests.core.boundary.solids import ball, slid
from tests.core.grids import grid, placed

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


@pytest.mark.parametrize("name", ["local-sd", "local-nr", "local-mnr"])
def test_a_step_that_is_cut_once_is_tried_again(name):
    """The first step is a hundred times too long; cut once, to a hundredth, it is what it should be."""
    mesh = slid(ball(3), 0.2, 2)
    nodes = SlidingBoundary(mesh).nodes
    usual = {"boundary": "slide"}
    right, long = (
        METHODS[name](**usual, **how).steps(mesh)
        for how in (
            {"initial_step": 0.2, "max_backtracks": 1},
            {"initial_step": 20.0, "backtrack_factor": 0.01, "max_backtracks": 1},
        )
    )
    moved = []
    for steps in (right, long):
        *_, step = itertools.islice(steps, 2)
        moved.append(np.linalg.norm(step.points - mesh.points, axis=1)[nodes] > 1e-9)
    assert moved[0].mean() > 0.6
    assert moved[1].mean() > 0.6


OPTIMISERS = sorted(name for name, method in METHODS.items() if method.optimises)
#: Each optimiser with and without the weight of the size in turn.
WEIGHTED = [(name, 0.5 * (number % 2)) for number, name in enumerate(OPTIMISERS)]


def edge_lengths(mesh):
    """Means of the four parallel edges of each hex, (m, 3)."""
    ends = mesh.points[mesh.hexes[:, EDGES]]
    return np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=2).reshape(-1, 3, 4).mean(axis=2)


def as_given(mesh, weight=0.0):
    return mesh.with_element_target(Target(edge_lengths(mesh), weight))


def stretched(n=4, height=0.1):
    lattice = grid(n)
    return lattice.with_points(lattice.points * [1, 1, height])


def shaken(mesh, amplitude, seed=0):
    """Nodes displaced by a share of the lengths of a stretched lattice; the target stays."""
    shift = np.random.default_rng(seed).uniform(-1, 1, mesh.points.shape) * np.ptp(mesh.points, axis=0) * amplitude
    return mesh.with_points(mesh.points + shift * mesh.free[:, None])


def layered(layers=10, first=1e-3, growth=1.3, bump=0.02):
    """Layers over a bump, whose heights grow from its surface; returns the mesh and the height of each node's layer."""
    lattice = grid(8, 4, layers)
    level = lattice.points[:, 2].astype(int)
    heights = np.concatenate([[0], np.cumsum(first * growth ** np.arange(layers))])
    x, y = lattice.points[:, 0] / 8, lattice.points[:, 1] / 8
    z = heights[level] + bump * np.sin(np.pi * x) ** 2 * (1 - heights[level] / heights[-1])
    gaps = np.diff(heights)[np.minimum(level, layers - 1)]
    return lattice.with_points(np.column_stack([x, y, z])), gaps


@pytest.mark.parametrize(("name", "weight"), WEIGHTED)
def test_a_mesh_like_its_target_stays(name, weight):
    mesh = as_given(stretched(), weight)
    result = smooth(mesh, METHODS[name](), StoppingCriteria(max_iterations=5))
    np.testing.assert_allclose(result.mesh.points, mesh.points, atol=1e-9)


@pytest.mark.parametrize(("name", "weight"), WEIGHTED)
def test_a_scrambled_lattice_returns_to_its_lengths(name, weight):
    lattice = as_given(stretched(3), weight)
    result = smooth(shaken(lattice, 0.08), METHODS[name](), StoppingCriteria(max_iterations=400))
    assert result.after.inverted == 0
    assert target_quality(result.mesh).min() > 0.999
    np.testing.assert_allclose(result.mesh.points, lattice.points, atol=5e-3)


@pytest.mark.parametrize("boundary", ["fixed", "slide"])
def test_mend_untangles_layers_and_keeps_their_heights(boundary):
    made, gaps = layered()
    shift = np.random.default_rng(1).uniform(-1, 1, made.points.shape) * np.column_stack(
        [0 * gaps + 0.05, 0 * gaps, gaps]
    )
    mesh = as_given(made).with_points(made.points + shift * made.free[:, None])
    before = measure(mesh.points, mesh.hexes)
    result = smooth(mesh, METHODS["mend"](boundary=boundary), StoppingCriteria(max_iterations=100))
    after = measure(result.mesh.points, mesh.hexes)
    assert before.n_inverted > 0 == after.n_inverted
    assert after.scaled_jacobian.min() > 0.95 * measure(made.points, made.hexes).scaled_jacobian.min()
    ratios = edge_lengths(result.mesh)[:, 2] / edge_lengths(made)[:, 2]
    assert np.abs(ratios - 1).max() < 0.1


def test_mend_untangles_thin_layers_whose_size_counts():
    """Nodes are displaced by ten thousand times the height of the layers, along them: sigma is as much too large."""
    lattice = grid(4, 4, 6)
    thin = lattice.with_points(lattice.points * [1, 1, 1e-4])
    shift = np.random.default_rng(3).uniform(-1, 1, thin.points.shape) * [0.3, 0.3, 5e-5]
    mesh = as_given(thin, 0.5).with_points(thin.points + shift * thin.free[:, None])
    result = smooth(mesh, METHODS["mend"]())
    assert result.before.inverted > 0 == result.after.inverted
    np.testing.assert_allclose(result.mesh.points, thin.points, rtol=1e-3, atol=5e-6)


def test_the_ideal_target_loses_the_layers():
    made, _ = layered()
    result = smooth(made, METHODS["mend"](goal="shape", target="ideal"))
    assert edge_lengths(result.mesh)[:32, 2].min() > 2 * edge_lengths(made)[:32, 2].max()


def test_the_size_brings_back_sizes_that_the_shape_does_not():
    """Cubes of two sizes in a row of fixed length: the shape alone is content with any scale."""
    lattice = grid(4, 2, 2)
    planes = np.array([0, 0.5, 1, 2.5, 4.0])  # lengths along x: 0.5, 0.5, 1.5, 1.5
    made = placed(lattice, np.s_[:, 0], planes[lattice.points[:, 0].astype(int)])
    lengths = np.repeat(edge_lengths(made)[:, :1], 3, axis=1)  # cubes of these sizes
    moved = made.with_points(np.where(made.free[:, None], made.points + [0.3, 0, 0], made.points))
    errors = []
    for weight in (0.0, 5.0):
        result = smooth(moved.with_element_target(Target(lengths, weight)), METHODS["mend"]())
        volume = edge_lengths(result.mesh).prod(axis=1) / lengths.prod(axis=1)
        errors.append(np.abs(np.log(volume)).mean())
    assert errors[1] < errors[0]


def test_the_kept_iterate_is_the_best_against_the_target():
    """From unit cubes to a target of flat hexes the ideal q falls all the way."""
    lattice = grid(4)
    lengths = np.ones((64, 3))
    lengths[:16, 2] = 0.5
    mesh = lattice.with_element_target(Target(lengths))
    result = smooth(mesh, METHODS["global-nr"]())
    assert result.kept > 0
    assert result.after.q_mean < result.before.q_mean
    assert target_quality(result.mesh).mean() > target_quality(mesh).mean()
    objectives = [row["objective"] for row in result.history]
    assert objectives == sorted(objectives, reverse=True)


def test_the_recorded_objective_is_that_against_the_target():
    mesh = shaken(as_given(stretched(3)), 0.05)
    first = next(iter(iterate(mesh, METHODS["mend"](goal="shape"), StoppingCriteria(max_iterations=3))))
    against = measure_against_target(mesh, first.points, first.quality)
    assert first.objective == pytest.approx(np.square(against.eta).sum())
    assert first.quality.q == pytest.approx(measure(first.points, mesh.hexes).q)


def test_methods_without_an_energy_say_that_they_ignore_the_target():
    mesh = as_given(stretched(3))
    result = smooth(mesh, METHODS["laplacian"](), StoppingCriteria(max_iterations=2))
    assert "Laplacian takes no account of the target" in result.message
    assert "target" not in smooth(stretched(3), METHODS["laplacian"](), StoppingCriteria(max_iterations=2)).message
