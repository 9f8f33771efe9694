"""Targets and layers on the command line: options, report and messages."""

import json

import pytest

from hexmend import gallery, io


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


@pytest.mark.parametrize("options", [["--target", "ideal"], ["--layers", "free"], ["--layers", "off"]])
def test_smooth_says_that_layers_are_lost(cylinder, tmp_path, run_command, options):
    printed = run_command("smooth", cylinder, "-o", tmp_path / "out.vtu", "--goal", "shape", *options)
    assert "Boundary layers at 'wall 1' are not kept." in printed.err
    assert "The layers at 'wall 1' lose their grading: first height 0.0001 → " in printed.out
    assert "--target given-shape keeps them." in printed.out


@pytest.mark.parametrize(("options", "complaint"), [
    (["--target", "given-shap"], "there is no target 'given-shap': expected ideal, given-shape, given-size, given"),
    (["--target", "x - 5"], "target 'x - 5' is "),
    (["--target", "ideal", "--set", "target=given"], "--target and --set target=... set the same value"),
    (["--target", "ideal", "--method", "laplacian"], "--target ideal: there are no targets in laplacian"),
    (["--set", "size_weight=2"], "--set size_weight=2: the target auto has no sizes; name one that has (--target given"),
    (["--set", "size_weight=1", "--target", "given-shape"], "the target given-shape has no sizes"),
    (["--target", "1e300"], "target '1e300' is 1e+300 at hex 0 (counted from 0): expected positive finite lengths"),
    (["--target", "0"], "target '0' is 0 at hex 0"),
    (["--layers", "keep", "--method", "getme"], "--layers keep: there are no targets, which keep layers, in getme"),
])  # fmt: skip
def test_what_is_wrong_is_said_before_the_run(cylinder, tmp_path, run_command, options, complaint):
    (line,) = run_command("smooth", cylinder, "-o", tmp_path / "out.vtu", *options, status=2).err.splitlines()
    assert complaint in line
    assert not (tmp_path / "out.vtu").exists()


def test_options_without_effect_are_named(tmp_path, run_command):
    path = tmp_path / "cube.vtu"
    io.write(path, gallery.make("cube", size=27))
    options = ["--layers", "keep", "--interfaces", "slide"]
    printed = run_command("smooth", path, "-o", tmp_path / "out.vtu", *options).err
    assert "--layers keep has no effect: no boundary layers were found." in printed
    assert "--interfaces slide has no effect: the mesh has one material." in printed
