"""Methods that let the nodes of the boundary slide: over the registry, on solids whose surface is known."""

import functools
import itertools
import json

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.stats import special_ortho_group

from hexmend import METHODS, MeshError, Recipe, Stage, StoppingCriteria, io, iterate, measure, smooth
from hexmend.boundary import NodeClass, SkinSurface, SlidingBoundary, surface_change
from hexmend.boundary.closest_point import triangulate
from hexmend.cli.main import main
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


# The boundary slides on a surface that is given, not on itself.


def skin_of(mesh, name="part.stl"):
    """The boundary of a mesh as triangles."""
    points, triangles, _ = triangulate(mesh.points, mesh.topology.boundary_faces)
    used, numbers = np.unique(triangles, return_inverse=True)
    return SkinSurface(points[used], numbers.reshape(-1, 3).astype(np.int32), name)


def write_stl(path, skin):
    """As text, each triangle with corners of its own."""
    lines = ["solid part"]
    for corners in skin.points[skin.faces].tolist():
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += [f"vertex {x!r} {y!r} {z!r}" for x, y, z in corners]
        lines += ["endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid part"]))


SURFACE_SOLIDS = {
    "ball": (lambda: ball(3), lambda: ball(12)),
    "cylinder": (lambda: cylinder(16, 2), lambda: cylinder(64, 8)),
    "block": (lambda: grid(3), lambda: grid(3)),
}


@functools.cache
def fine_skin(solid):
    """The surface of a solid of small faces; making one takes longer than smoothing a mesh on it."""
    return skin_of(SURFACE_SOLIDS[solid][1]())


@pytest.mark.slow
@settings(max_examples=30)
@given(st.sampled_from(sorted(METHODS)), st.sampled_from(sorted(SURFACE_SOLIDS)), st.integers(0, 2**32 - 1))
def test_nodes_are_put_on_the_surface_and_stay_on_it(name, solid, seed):
    mesh, target = slid(SURFACE_SOLIDS[solid][0](), 0.2, seed), fine_skin(solid)
    kept, on = SlidingBoundary(mesh).mesh.fixed, mesh.sliding_on(target)
    slides = SlidingBoundary(on).nodes
    for number, step in enumerate(itertools.islice(METHODS[name](boundary="slide").steps(on), 4)):
        if number:
            assert target.distances(step.points[slides]).max() < 1e-9 * mesh.mean_edge_length
        np.testing.assert_array_equal(step.points[kept], mesh.points[kept])


def test_the_distance_told_is_that_from_the_surface():
    mesh, target = ball(3), skin_of(ball(12), "ball.stl")
    result = smooth(mesh.sliding_on(target), METHODS["laplacian"](boundary="slide"), StoppingCriteria(max_iterations=3))
    assert result.surface.reference == "ball.stl"
    assert "from ball.stl" in result.surface.sentence
    nodes = result.surface.max_distance  # a coarse boundary cuts off the ball's bends
    assert 0.01 < nodes < 0.5
    assert result.surface == surface_change(mesh.sliding_on(target), result.mesh)
    assert surface_change(mesh, result.mesh.sliding_on(skin_of(mesh))).max_distance != nodes


@pytest.mark.parametrize("change", [lambda x: 1000 * x, lambda x: x + 50, lambda x: x / 25.4])
def test_a_surface_of_another_unit_or_place_is_refused(change):
    mesh, skin = ball(4), skin_of(ball(6))
    with pytest.raises(MeshError, match=r"part\.stl: .* mean edge lengths or more from it.*unit or position"):
        mesh.sliding_on(SkinSurface(change(skin.points), skin.faces, skin.name))


def test_the_command_line_takes_it(tmp_path, capsys):
    path, stl, report = tmp_path / "ball.vtu", tmp_path / "fine.stl", tmp_path / "report.json"
    io.write(path, slid(ball(3), 0.3))
    write_stl(stl, skin_of(ball(12)))
    words = ["smooth", str(path), "-o", str(tmp_path / "out.vtu"), "--max-iterations", "5", "--json", str(report)]
    assert main([*words, "--method", "local-nr", "--surface", str(stl), "--surface-tolerance", "0.2"]) in (0, 4)
    assert "from fine.stl" in capsys.readouterr().out
    said = json.loads(report.read_text())
    assert said["parameters"]["boundary"] == "slide"
    assert said["parameters"]["surface_tolerance"] == 0.2
    assert main([*words, "--method", "local-nr", "--boundary", "slide", "--surface-tolerance", "unlimited"]) in (0, 4)
    assert json.loads(report.read_text())["parameters"]["surface_tolerance"] == "unlimited"
    assert main([*words, "--method", "local-nr", "--boundary", "slide", "--surface-tolerance", "0"]) in (0, 4)
    assert json.loads(report.read_text())["surface"]["max"] < 1e-7
    recipe = tmp_path / "recipe.toml"
    recipe.write_text('format = 1\n[[stage]]\nmethod = "laplacian"\nparameters = { boundary = "slide" }\n')
    assert main([*words, "--recipe", str(recipe), "--surface", str(stl)]) in (0, 4)
    assert "from fine.stl" in capsys.readouterr().out


def test_what_the_command_line_says_of_a_surface_that_is_none(tmp_path, run_command):
    path, stl = tmp_path / "ball.vtu", tmp_path / "far.stl"
    io.write(path, ball(3))
    skin = skin_of(ball(3))
    write_stl(stl, SkinSurface(1000 * skin.points, skin.faces))
    words = ["smooth", str(path), "-o", str(tmp_path / "out.vtu")]
    for more, status, said in (
        (["--surface", str(stl)], 3, "far.stl: one in ten nodes"),
        (["--surface", str(tmp_path / "none.stl")], 3, "none.stl: there is no such file"),
        (["--surface", str(stl), "--boundary", "fixed"], 2, "--surface is for a sliding boundary"),
        (["--surface-tolerance", "0.1", "--set", "surface_tolerance=0.2"], 2, "set the same value"),
        (["--surface-tolerance", "-1"], 2, "surface_tolerance"),
    ):
        captured = run_command(*words, *more, status=status)
        assert said in captured.err
        assert captured.err.count("\n") == 1
    assert not (tmp_path / "out.vtu").exists()


def test_methods_are_compared_on_it(tmp_path, run_command):
    path, stl, folder = tmp_path / "ball.vtu", tmp_path / "fine.stl", tmp_path / "tables"
    mesh, skin = slid(ball(3), 0.3), skin_of(ball(12))
    io.write(path, mesh)
    write_stl(stl, skin)
    words = ["compare", str(path), "-o", str(folder), "--methods", "laplacian,local-nr", "--max-iterations", "3"]
    printed = run_command(*words, "--surface", stl, "--boundary", "fixed", status=2).err
    assert "--surface is for a sliding boundary" in printed
    assert not folder.exists()
    assert main([*words, "--surface", str(stl), "--surface-tolerance", "0", "--write-meshes"]) == 0
    rows = json.loads((folder / "comparison.json").read_text())["rows"]
    assert {row["parameters"]["boundary"] for row in rows} == {"slide"}
    for row in rows:
        moved = io.read(folder / f"ball-{row['method']}.vtu")
        on = SlidingBoundary(mesh.sliding_on(skin)).nodes
        assert np.abs(skin.distances(moved.points[on])).max() < 1e-6 < skin.distances(mesh.points[on]).max()


# What no method that lets the boundary slide does: turn a quad of it over, or leave the room around the surface.


METHOD = st.sampled_from(sorted(METHODS))
SLIDING_SOLIDS = {
    "block": lambda: grid(3, 2, 4),
    "cylinder": lambda: cylinder(16, 3),
    "ball": lambda: ball(3),
    "wavy": lambda: wavy(grid(4), 0.3),
}
SLIDING_SOLID = st.sampled_from(sorted(SLIDING_SOLIDS))
SEED = st.integers(0, 2**32 - 1)


def sides(points, sliding):
    """By how much each of the boundary's quads faces outward, as the sine between its diagonals seen from there, (k,)."""
    x = points[sliding.boundary.faces]
    one, other = x[:, 2] - x[:, 0], x[:, 3] - x[:, 1]
    size = np.linalg.norm(one, axis=1) * np.linalg.norm(other, axis=1)
    return np.einsum("kj,kj->k", np.cross(one, other), sliding.outward) / np.maximum(size, np.finfo(float).tiny)


@pytest.mark.slow
@given(name=METHOD, solid=SLIDING_SOLID, amplitude=st.sampled_from([0.2, 0.6, 1.0]), seed=SEED)
def test_no_step_turns_a_quad_over(name, solid, amplitude, seed):
    mesh = slid(SLIDING_SOLIDS[solid](), amplitude, seed)
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
    name=METHOD, solid=SLIDING_SOLID, amplitude=st.sampled_from([0.0, 0.3, 0.8]), tolerance=st.sampled_from([0.02, 0.1, 0.3]),
    seed=SEED,
)  # fmt: skip
@example(name="global-nr", solid="ball", amplitude=0.8, tolerance=0.3, seed=0)  # the face that was closest moves away
def test_the_boundary_stays_in_its_room_both_ways(name, solid, amplitude, tolerance, seed):
    mesh = slid(SLIDING_SOLIDS[solid](), amplitude, seed)
    method = METHODS[name](boundary="slide", surface_tolerance=tolerance)
    result = smooth(mesh, method, StoppingCriteria(max_iterations=10, keep_last=True))
    assert surface_change(mesh, result.mesh).max <= tolerance * (1 + 1e-4)


@pytest.mark.slow
@given(name=METHOD, solid=SLIDING_SOLID, amplitude=st.sampled_from([0.0, 0.3, 0.8]), seed=SEED)
def test_with_a_tolerance_of_0_the_boundary_stays_on_its_surface(name, solid, amplitude, seed):
    mesh = slid(SLIDING_SOLIDS[solid](), amplitude, seed)
    method = METHODS[name](boundary="slide", surface_tolerance=0)
    result = smooth(mesh, method, StoppingCriteria(max_iterations=10, keep_last=True))
    assert result.surface.max < 1e-7
    assert abs(result.surface.volume_change) < 1e-7
