"""Options of `smooth` for interfaces and sets, and what `smooth` and `info` print of materials."""

import json

import numpy as np
import pytest

from hexmend import gallery, io, read, read_recipe, smooth, write
from hexmend.cli.main import main
from hexmend.quality.corner_heights import least_heights
from tests.core.grids import grid, scrambled

CUBE = grid(4)
LOW = CUBE.points[CUBE.hexes].mean(axis=1)[:, 0] < 2
SETS = {"low": np.flatnonzero(LOW), "high": np.flatnonzero(~LOW)}
FLOOR = {"floor": np.flatnonzero(CUBE.points[:, 2] == 0), "roof": np.flatnonzero(CUBE.points[:, 2] == 4)}


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "two.vtu"
    mesh = CUBE.replace(hex_sets=SETS, node_sets=FLOOR)
    moved = mesh.points + 0.3 * (mesh.materials.interface_nodes & ~mesh.topology.boundary)[:, None] * [0.3, 1, 0.5]
    io.write(path, scrambled(mesh.with_points(moved), 0.2))
    return path


def smoothed(path, *words):
    out = path.with_name("out.vtu")
    assert main(["smooth", str(path), "-o", str(out), *words]) == 0
    return io.read(out)


def test_interfaces_are_kept_and_the_report_has_the_volumes(path, tmp_path, capsys):
    report = tmp_path / "report.json"
    after, mesh = smoothed(path, "--json", str(report)), io.read(path)
    on = mesh.materials.interface_nodes
    np.testing.assert_array_equal(after.points[on], mesh.points[on])
    assert "2 materials: 9 nodes on their interfaces were kept." in capsys.readouterr().out
    volumes = json.loads(report.read_text())["materials"]
    assert list(volumes) == ["low", "high"]
    for volume in volumes.values():
        assert volume["volume_after"] == pytest.approx(volume["volume_before"], rel=1e-12)


@pytest.mark.parametrize(
    ("words", "on_itself"),
    [(["--interfaces", "free"], False), (["--interfaces", "slide"], True), (["--free", "low"], False)],
)
def test_options_let_interfaces_move(path, words, on_itself, capsys):
    after, mesh = smoothed(path, *words), io.read(path)
    on = mesh.materials.interface_nodes & ~mesh.topology.boundary
    assert np.linalg.norm(after.points - mesh.points, axis=1)[on].max() > 0.1
    assert (np.abs(after.points[on, 0] - 2).max() > 0.01) == on_itself  # without interface it ends at the lattice
    assert "9 of 9 nodes on their interfaces moved; no material's volume" in capsys.readouterr().out
    assert after.pinned is None


def test_info_names_the_materials_and_their_interface(path, capsys):
    main(["info", str(path)])
    assert "2 materials; 9 nodes on their interfaces are kept" in capsys.readouterr().out
    main(["info", str(path), "--json"])
    found = json.loads(capsys.readouterr().out)
    assert {name: entry["hexes"] for name, entry in found["materials"].items()} == {"low": 32, "high": 32}
    assert found["interface_nodes"] == 25


def test_options_replace_the_interfaces_of_a_recipe(path, tmp_path):
    choice = "free"
    recipe, given = tmp_path / "recipe.toml", tmp_path / "given.toml"
    recipe.write_text('format = 1\n[motion]\ninterfaces = "slide"\n[[stage]]\nmethod = "mend"\n')
    after = smoothed(path, "--recipe", str(recipe), "--interfaces", choice, "--save-recipe", str(given))
    np.testing.assert_array_equal(after.points, smoothed(path, "--interfaces", choice).points)
    assert read_recipe(given).rules.interfaces == choice
    again = smooth(io.read(path), read_recipe(recipe), interfaces=choice)
    np.testing.assert_array_equal(again.mesh.points, after.points)


def test_an_unknown_set_is_an_error_that_lists_the_sets(path, run_command):
    printed = run_command("smooth", path, "-o", path.with_name("out.vtu"), "--slide", "nowhere", status=3).err
    assert "there is no set 'nowhere': there are 'floor', 'roof', 'low', 'high'" in printed
    assert not path.with_name("out.vtu").exists()


# Targets and layers on the command line: options, report and messages.


@pytest.fixture
def cylinder(tmp_path):
    path = tmp_path / "cylinder.vtu"
    io.write(path, gallery.make("layered", size=2000))
    return str(path)


def test_info_lists_layers(cylinder, run_command):
    assert "Layers at 'wall 1': 20 on " in run_command("info", cylinder).out
    (wall,) = json.loads(run_command("info", cylinder, "--json").out)["layers"]
    assert wall["wall"] == "wall 1"
    assert wall["first_height_mean"] == pytest.approx(1e-4)
    assert wall["growth"] == pytest.approx(1.2)
    assert wall["angle_max"] == pytest.approx(0, abs=1e-3)


def test_smooth_keeps_layers_and_says_so(cylinder, tmp_path, run_command):
    report = tmp_path / "report.json"
    printed = run_command("smooth", cylinder, "-o", tmp_path / "out.vtu", "--json", report)
    assert "Boundary layers at 'wall 1' are kept." in printed.err
    assert "Layers at 'wall 1' (20 layers on " in printed.out
    (row,) = [line.split() for line in printed.out.splitlines() if "q of target min" in line]
    assert float(row[-1]) == pytest.approx(json.loads(report.read_text())["q_of_target"][1], abs=1e-4)
    values = json.loads(report.read_text())
    assert values["target"] == "given-shape"
    assert values["layers"][0]["after"]["first_height_mean"] == pytest.approx(1e-4, rel=0.01)
    assert values["layers"][0]["lost"] is False


@pytest.mark.parametrize("options", [["--target", "ideal"], ["--layers", "free"]])
def test_smooth_says_that_layers_are_lost(cylinder, tmp_path, run_command, options):
    printed = run_command("smooth", cylinder, "-o", tmp_path / "out.vtu", "--goal", "shape", *options)
    assert "Boundary layers at 'wall 1' are not kept." in printed.err
    assert "The layers at 'wall 1' lose their grading: first height 0.0001 → " in printed.out
    assert "--target given-shape keeps them." in printed.out


@pytest.mark.parametrize(("options", "said"), [
    (["--target", "given-shap"], "there is no target 'given-shap': expected ideal, given-shape, given-size, given"),
    (["--target", "x - 5"], "target 'x - 5' is "),
    (["--target", "ideal", "--set", "target=given"], "--target and --set target=... set the same value"),
    (["--target", "ideal", "--method", "laplacian"], "--target ideal: there is no such choice in laplacian"),
    (["--set", "size_weight=2"], "--set size_weight=2: the target auto has no sizes; name one that has (--target given"),
    (["--set", "size_weight=1", "--target", "given-shape"], "the target given-shape has no sizes"),
    (["--target", "1e300"], "target '1e300' is 1e+300 at hex 0 (counted from 0): expected positive finite lengths"),
    (["--target", "0"], "target '0' is 0 at hex 0"),
])  # fmt: skip
def test_what_is_wrong_is_said_before_the_run(cylinder, tmp_path, complaint, options, said):
    assert said in complaint("smooth", cylinder, "-o", tmp_path / "out.vtu", *options)
    assert not (tmp_path / "out.vtu").exists()


def test_options_without_effect_are_named(tmp_path, run_command):
    path = tmp_path / "cube.vtu"
    io.write(path, gallery.make("cube", size=27))
    options = ["--layers", "keep", "--interfaces", "slide"]
    printed = run_command("smooth", path, "-o", tmp_path / "out.vtu", *options).err
    assert "--layers keep has no effect: no boundary layers were found." in printed
    assert "--interfaces slide has no effect: the mesh has one material." in printed


# `--goal`: the short form of `--set goal=`, for methods that have goals.


@pytest.fixture
def mesh(tmp_path):
    path = tmp_path / "cube.vtk"
    write(path, gallery.make("cube", size=64, scramble=0.3))
    return path


def step_of(path):
    mesh = read(path)
    return least_heights(mesh.points, mesh.hexes).min()


def test_the_goal_is_that_of_the_setting(mesh, tmp_path, run_command):
    short, long = tmp_path / "short.vtk", tmp_path / "long.vtk"
    assert "The minimum time step of the corners" in run_command("smooth", mesh, "-o", short, "--goal", "time-step").out
    assert main(["smooth", str(mesh), "-o", str(long), "--set", "goal=time-step"]) == 0
    assert step_of(short) == step_of(long) > step_of(mesh)
