"""The boundary slides on a surface that is given, not on itself."""

import functools
import itertools
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend import METHODS, MeshError, StoppingCriteria, io, smooth
from hexmend.boundary import SkinSurface, SlidingBoundary, surface_change
from hexmend.boundary.closest_point import triangulate
from hexmend.cli.main import main
from tests.core.boundary.solids import ball, cylinder, slid, wavy
from tests.core.grids import grid


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


SOLIDS = {
    "ball": (lambda: ball(3), lambda: ball(12)),
    "cylinder": (lambda: cylinder(16, 2), lambda: cylinder(64, 8)),
    "block": (lambda: grid(3), lambda: grid(3)),
}


@functools.cache
def fine_skin(solid):
    """The surface of a solid of small faces; making one takes longer than smoothing a mesh on it."""
    return skin_of(SOLIDS[solid][1]())


@pytest.mark.slow
@settings(max_examples=30)
@given(st.sampled_from(sorted(METHODS)), st.sampled_from(sorted(SOLIDS)), st.integers(0, 2**32 - 1))
def test_nodes_are_put_on_the_surface_and_stay_on_it(name, solid, seed):
    mesh, target = slid(SOLIDS[solid][0](), 0.2, seed), fine_skin(solid)
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
