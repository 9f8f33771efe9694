"""Methods that let the nodes of the boundary slide: over the registry, on solids whose surface is known."""

import itertools
import json

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.stats import special_ortho_group

from hexmend import METHODS, Recipe, Stage, StoppingCriteria, io, iterate, measure, smooth
from hexmend.boundary import NodeClass, SlidingBoundary, surface_change
from hexmend.report.records import record
from tests.core.boundary.solids import ball, cylinder, slid, wavy
from tests.core.grids import grid
from tests.core.threads import by_threads

SLIDING = sorted(name for name, cls in METHODS.items() if hasattr(cls, "boundary"))
SOLIDS = {
    "block": lambda: grid(3, 2, 4),
    "cylinder": lambda: cylinder(16, 3),
    "ball": lambda: ball(3),
    "wavy": lambda: wavy(grid(4), 0.15),
}


def on_its_surface(sliding, points):
    """How far sliding nodes are from their own curves and patches, in mean edge lengths."""
    x = points[sliding.nodes]
    return np.linalg.norm(sliding.project(x) - x, axis=1).max() / sliding.mesh.mean_edge_length


def turned(mesh, seed=0):
    turn = special_ortho_group.rvs(3, random_state=np.random.default_rng(seed))
    return mesh.with_points(mesh.points @ turn.T + 0.3)


@given(
    name=st.sampled_from(SLIDING),
    solid=st.sampled_from(sorted(SOLIDS)),
    amplitude=st.sampled_from([0.1, 0.3, 0.6]),
    seed=st.integers(0, 2**32 - 1),
)
@example(name="global-nr", solid="block", amplitude=0.6, seed=0)  # a node of a straight edge went past its corner
def test_corners_are_kept_and_all_others_stay_on_their_curves_and_patches(name, solid, amplitude, seed):
    mesh = slid(SOLIDS[solid](), amplitude, seed)
    pinned = np.zeros(mesh.n_nodes, dtype=bool)
    pinned[np.random.default_rng(seed).integers(0, mesh.n_nodes, 3)] = True
    mesh = mesh.replace(pinned=pinned)
    sliding = SlidingBoundary(mesh)
    for step in itertools.islice(METHODS[name](boundary="slide").steps(mesh), 6):
        kept = sliding.mesh.fixed
        np.testing.assert_array_equal(step.points[kept], mesh.points[kept])
        assert on_its_surface(sliding, step.points) < 1e-9


@pytest.mark.parametrize(
    "name", ["local-nr", "local-mnr", "local-patch", "global-nr", "global-mnr", "mend", "laplacian"]
)
def test_a_scrambled_cube_goes_back_to_the_grid(name):
    cube = grid(4)
    mesh = slid(cube, 0.3, seed=3)
    assert np.abs(mesh.points - cube.points)[cube.fixed].max() > 0.2
    result = smooth(mesh, METHODS[name](boundary="slide"), StoppingCriteria(tolerance=1e-9, max_iterations=500))
    np.testing.assert_allclose(result.mesh.points, cube.points, atol=1e-6)


@pytest.mark.parametrize("name", SLIDING)
def test_a_flat_solid_keeps_its_surface_and_volume(name):
    mesh = turned(slid(grid(3, 4, 3), 0.3))
    result = smooth(mesh, METHODS[name](boundary="slide"), StoppingCriteria(max_iterations=30))
    assert result.surface.moved > 20
    assert result.surface.max < 1e-12
    assert abs(result.surface.volume_change) < 1e-12
    assert result.surface.features_kept == result.surface.features
    assert result.after.q_mean > result.before.q_mean


@pytest.mark.parametrize("name", SLIDING)
def test_the_number_of_threads_does_not_matter(name):
    mesh, method = slid(cylinder(32, 3), 0.3), METHODS[name](boundary="slide")
    np.testing.assert_array_equal(*by_threads(lambda: next(itertools.islice(method.steps(mesh), 3, None)).points))


@given(st.sampled_from(["smart-laplacian", "getme", "getme-sequential"]), st.integers(0, 2**32 - 1))
def test_guarded_methods_invert_no_hex_that_was_sound(name, seed):
    mesh = slid(ball(3), 0.4, seed)
    was = measure(mesh.points, mesh.hexes).inverted
    for step in itertools.islice(METHODS[name](boundary="slide").steps(mesh), 5):
        now = measure(step.points, mesh.hexes).inverted
        assert not (now & ~was).any()
        was = now


@given(st.sampled_from(["local-sd", "local-nr", "local-mnr", "local-patch", "global-nr"]), st.integers(0, 2**32 - 1))
def test_optimisers_lower_the_objective_and_never_leave_the_feasible_region(name, seed):
    mesh = slid(cylinder(16, 3), 0.1, seed)
    if measure(mesh.points, mesh.hexes).n_inverted:
        return
    steps = METHODS[name](boundary="slide").steps(mesh)
    values = [np.square(measure(step.points, mesh.hexes).eta).sum() for step in itertools.islice(steps, 6)]
    assert np.isfinite(values).all()
    assert (np.diff(values) <= 1e-12 * values[0]).all()


def test_laplacian_takes_the_mean_over_the_neighbours_on_the_nodes_own_curve_or_patch():
    mesh = slid(grid(3), 0.3, seed=5)
    sliding = SlidingBoundary(mesh)
    moved = next(itertools.islice(METHODS["laplacian"](boundary="slide", update="simultaneous").steps(mesh), 1, None))
    kind, part = sliding.boundary.node_class, sliding.boundary.component
    edges = {tuple(sorted(edge)) for edge in mesh.topology.edges[mesh.topology.edge_on_boundary].tolist()}
    curves = {tuple(sorted(edge)) for edge in sliding.boundary.segments.tolist()}
    for node in sliding.nodes:
        along = curves if kind[node] == NodeClass.CURVE else edges
        ring = [other for other in mesh.topology.rings[node] if tuple(sorted((int(node), int(other)))) in along]
        assert all(part[other] == part[node] or kind[other] < kind[node] for other in ring)
        np.testing.assert_allclose(moved.points[node], mesh.points[ring].mean(axis=0), atol=1e-12)  # its sides are flat


def test_all_stages_of_a_run_slide_on_the_surface_that_it_began_with():
    mesh = slid(ball(4), 0.3)
    stages = [
        Stage(METHODS[name](boundary="slide"), StoppingCriteria(max_iterations=5))
        for name in ("getme", "local-sd", "mend")
    ]
    sliding = SlidingBoundary(mesh)
    assert on_its_surface(sliding, smooth(mesh, Recipe.of(*stages)).mesh.points) < 1e-9
    run = iterate(mesh, stages[0].smoother)
    next(run)
    run.switch_method(stages[1].smoother, StoppingCriteria(max_iterations=4))
    for iteration in run:
        assert on_its_surface(sliding, iteration.points) < 1e-9
    again = smooth(
        run.result().mesh, stages[1].smoother, StoppingCriteria(max_iterations=2)
    )  # a run of its own: the surface of now
    assert on_its_surface(SlidingBoundary(run.result().mesh), again.mesh.points) < 1e-9


def test_the_surface_is_recorded():
    mesh = slid(cylinder(16, 3), 0.2)
    result = smooth(mesh, METHODS["local-nr"](boundary="slide"), StoppingCriteria(max_iterations=10))
    change = surface_change(mesh, result.mesh)
    assert result.surface == change
    surface = record(result)["surface"]
    assert list(surface) == ["max", "mean", "max_percent_of_diagonal", "volume_change", "moved", "left"]
    assert surface == change.to_dict() | {"left": result.departures.to_dict()}
    assert not result.departures.nodes.size
    assert "surface" not in record(smooth(mesh, "local-nr", StoppingCriteria(max_iterations=2)))


def test_the_command_line_lets_it_slide_and_says_what_became_of_the_surface(tmp_path, run_command):
    path, out, report = tmp_path / "mesh.vtu", tmp_path / "out.vtu", tmp_path / "report.json"
    mesh = slid(cylinder(16, 3), 0.2)
    io.write(path, mesh)
    words = ["smooth", str(path), "-o", str(out), "--method", "local-nr", "--max-iterations", "5"]
    words += ["--json", str(report)]
    assert "The boundary slid: " in run_command(*words, "--boundary", "slide").out
    said = json.loads(report.read_text())
    assert said["parameters"]["boundary"] == "slide"
    assert said["surface"]["moved"] > 0
    assert "slid" not in run_command(*words, "--boundary", "fixed").out
    assert "surface" not in json.loads(report.read_text())
    assert "--set boundary" in run_command(*words, "--boundary", "slide", "--set", "boundary=fixed", status=2).err
