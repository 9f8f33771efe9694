"""The command line: contracts, exit statuses, one clear line for what is wrong."""

import json
import shlex
from pathlib import Path

import pytest

from hexmend import METHODS, Recipe, Stage, StoppingCriteria, gallery, io, read_recipe, smooth, summarise, write_recipe
from hexmend.cli.main import commands, main
from hexmend.quality import METRICS, metric_statistics
from tests.core.grids import scrambled
from tests.core.solid_lattices import mixed

SUMMARY = [
    "hexes", "nodes", "free_nodes", "inverted", "locked_inverted", "invalid", "min_jacobian", "q_min", "q_mean",
    "q_max", "q_std", "q_norm", "scaled_jacobian_min", "objective", "cells",
]  # fmt: skip


def test_info_prints_json_with_the_agreed_keys(mesh, run_command):
    figures = json.loads(run_command("info", mesh, "--json").out)
    assert list(figures) == [*SUMMARY, "fit", "judgement", "next"]
    assert {key: figures[key] for key in SUMMARY} == summarise(io.read(mesh)).to_dict()


def test_info_adds_every_metric_on_demand(mesh, run_command):
    figures = json.loads(run_command("info", mesh, "--metrics", "--json").out)
    assert list(figures) == [*SUMMARY, "metrics", "fit", "judgement", "next"]
    assert figures["metrics"] == {name: spread.to_dict() for name, spread in metric_statistics(io.read(mesh)).items()}
    assert figures["metrics"]["q"]["min"] == figures["q_min"]
    table = run_command("info", mesh, "--metrics").out
    assert all(f" {name} " in table for name in METRICS)


def test_smooth_writes_mesh_report_and_history(mesh, tmp_path, capsys):
    out, report, history = tmp_path / "out.vtu", tmp_path / "report.json", tmp_path / "history.csv"
    words = ["smooth", mesh, "-o", out, "--method", "local-sd", "--set", "p=3", "--json", report, "--history", history]
    assert main([str(word) for word in words]) == 0
    answer = json.loads(report.read_text())
    assert list(answer["before"]) == SUMMARY
    assert answer["parameters"]["p"] == 3
    assert answer["after"] == summarise(io.read(out)).to_dict()
    assert len(history.read_text().splitlines()) == 2 + answer["iterations"]
    assert answer["message"] in capsys.readouterr().out


def test_smooth_says_by_status_4_that_hexes_are_still_inverted(tmp_path):
    tangled, out = tmp_path / "tangled.vtu", tmp_path / "out.vtu"
    io.write(tangled, gallery.make("cube", size=125, scramble=2.0))
    assert main(["smooth", str(tangled), "-o", str(out), "--method", "laplacian", "--max-iterations", "0"]) == 4
    assert out.exists()


def test_methods_as_json_follow_the_declarations(run_command):
    methods = json.loads(run_command("methods", "--json").out)
    assert {"laplacian", "smart-laplacian", "local-sd"} <= {one["name"] for one in methods}
    for one in methods:
        assert set(one) == {"name", "title", "help", "source", "parameters"}
        for parameter in one["parameters"]:
            assert set(parameter) == {"name", "default", "low", "high", "choices", "unit", "help"}


def test_gallery_makes_a_mesh(tmp_path, capsys):
    out = tmp_path / "five.mesh"
    assert main(["gallery", "five-side", "--size", "7350", "-o", str(out)]) == 0
    assert io.read(out).n_hexes == 7350


WRONG_USAGE = [
    (
        ["smooth", "{mesh}", "-o", "{out}", "--method", "lokal-sd"],
        "there is no method 'lokal-sd': did you mean local-sd?",
    ),
    (["smooth", "{mesh}", "-o", "{out}", "--method", "local-sd", "--set", "q=1"], "local-sd has no parameter 'q'"),
    (["smooth", "{mesh}", "-o", "{out}", "--set", "p"], "expected key=value"),
    (["smooth", "{mesh}", "-o", "{out}", "--max-iterations", "-3"], "max_iterations = -3 is out of range"),
    (["gallery", "five-sides", "-o", "{out}"], "did you mean five-side?"),
    (["gallery", "five-side"], "expected -o MESH"),
    (["smooth", "{mesh}", "-o", "{out}", "--goal", "time-step", "--set", "goal=shape"], "set the same value"),
    (
        ["smooth", "{mesh}", "-o", "{out}", "--goal", "shape", "--method", "laplacian"],
        "--goal shape: there is no such choice in laplacian",
    ),
    (["smooth", "{mesh}", "-o", "{out}", "--goal", "shape", "--recipe", "absent.toml"], "--recipe names its methods"),
]


@pytest.mark.parametrize(("words", "message"), WRONG_USAGE)
def test_wrong_usage_is_status_2_and_one_line(words, message, mesh, tmp_path, complaint):
    words = [word.format(mesh=mesh, out=tmp_path / "out.vtu") for word in words]
    assert message in complaint(*words)
    assert not (tmp_path / "out.vtu").exists()


@pytest.mark.parametrize("command", [["info"], ["smooth", "-o", "out.vtu"]])
def test_what_cannot_be_read_is_status_3_and_one_line(command, tmp_path, complaint):
    assert "missing.vtk" in complaint(command[0], tmp_path / "missing.vtk", *command[1:], status=3)


def test_help_lists_every_command(run_command):
    text = run_command("--help").out
    for name in commands():
        assert name in text
    assert main(["--version"]) == 0


# Mistakes in the words of a command: one line, which names the word, the nearest name, and where to read on.


MISTAKES = [
    (["smooth", "a.vtu", "-o", "b.vtu", "--boundry", "slide"], "no option --boundry: did you mean --boundary?"),
    (["smooth", "a.vtu", "--outptu=b.vtu"], "there is no option --outptu: did you mean --output?"),
    (["smooth", "a.vtu", "-o", "b.vtu", "--boundary", "slid"], "--boundary slid is unknown: did you mean slide?"),
    (["smooth", "a.vtu", "-o", "b.vtu", "--xyzzy"], "there is no option --xyzzy."),
    (["smooth", "a.vtu"], "the following arguments are required: -o/--output."),
    (["smooth", "a.vtu", "b.vtu", "-o", "c.vtu"], "'b.vtu' is one word too many."),
    (["smooth", "a.vtu", "-o", "b.vtu", "--BOUNDARY", "slide"], "no option --BOUNDARY: did you mean --boundary?"),
    (["smooth", "a.vtu", "-o", "b.vtu", "--only"], "argument --only: expected one argument."),
]


@pytest.mark.parametrize(("words", "problem"), MISTAKES)
def test_a_mistake_is_one_line_with_the_nearest_name(words, problem, complaint):
    line = complaint(*words)
    assert problem in line
    assert line.startswith("hexmend smooth: ")
    assert line.endswith("hexmend smooth --help lists the options.")


def test_a_command_that_is_misspelt_is_named_right(complaint):
    assert "'smoth' is neither a command nor a file: did you mean hexmend smooth?" in complaint("smoth", "a")
    assert "did you mean" not in complaint("xyzzy")


def test_arguments_that_may_be_left_out_are_not_missing(complaint):
    assert "MESH (" not in complaint("study")


# Recipes on the command line, and those that come with Hexmend.


SHIPPED = sorted((Path(__file__).resolve().parents[3] / "resources" / "recipes").glob("*.toml"))


@pytest.fixture
def recipe(tmp_path):
    stages = [Stage(METHODS[name](), StoppingCriteria(max_iterations=3, tolerance=0)) for name in ("getme", "local-sd")]
    write_recipe(tmp_path / "two.toml", Recipe("Two", tuple(stages)))
    return tmp_path / "two.toml"


def smoothed(mesh, *words):
    report = mesh.with_name("report.json")
    status = main([str(word) for word in ("smooth", mesh, "-o", mesh.with_name("out.vtu"), "--json", report, *words)])
    return status, json.loads(report.read_text()) if report.exists() else None


def test_a_recipe_is_run(mesh, recipe, capsys):
    status, report = smoothed(mesh, "--recipe", recipe)
    assert status == 0
    assert (report["method"], report["iterations"]) == ("recipe", 6)
    assert [(stage["method"], stage["iterations"]) for stage in report["stages"]] == [("getme", 3), ("local-sd", 3)]
    assert report["after"] == summarise(io.read(mesh.with_name("out.vtu"))).to_dict()
    assert f"{mesh}: Two" in capsys.readouterr().out


def test_a_limit_on_the_command_line_is_every_stages(mesh, recipe):
    _, report = smoothed(mesh, "--recipe", recipe, "--max-iterations", 2)
    assert [(stage["iterations"], stage["stop"]["tolerance"]) for stage in report["stages"]] == [(2, 0), (2, 0)]


def test_what_is_run_is_saved_and_does_the_same_again(mesh, tmp_path):
    saved = tmp_path / "saved.toml"
    words = ["--method", "local-sd", "--set", "p=3", "--max-iterations", 4, "--save-recipe", saved]
    _, first = smoothed(mesh, *words)
    assert read_recipe(saved) == Recipe.of(Stage(METHODS["local-sd"](p=3), StoppingCriteria(max_iterations=4)))
    _, second = smoothed(mesh, "--recipe", saved)
    assert second["after"] == first["after"]
    _, third = smoothed(mesh, "--recipe", saved, "--max-iterations", 2, "--save-recipe", saved)
    assert third["iterations"] == read_recipe(saved).stages[0].stop.max_iterations == 2


@pytest.mark.parametrize(("words", "status", "said"), [
    (["--recipe", "{recipe}", "--method", "mend"], 2, "leave out --method, --set, --boundary"),
    (["--recipe", "{recipe}", "--set", "p=3"], 2, "leave out --method, --set, --boundary"),
    (["--recipe", "missing.toml"], 3, "missing.toml: there is no such file"),
    (["--recipe", "{mesh}"], 3, "mesh.vtu: is not text"),
    (["--save-recipe", "{folder}/no/such.toml"], 3, "such.toml: cannot be written"),
])  # fmt: skip
def test_what_is_wrong_is_one_line_before_the_work(words, status, said, mesh, recipe, tmp_path, complaint):
    words = [word.format(mesh=mesh, recipe=recipe, folder=tmp_path) for word in words]
    assert said in complaint("smooth", mesh, "-o", tmp_path / "out.vtu", *words, status=status)
    assert not (tmp_path / "out.vtu").exists()


def test_what_to_try_next_is_printed_where_hexes_are_still_inverted(tmp_path, capsys):
    io.write(tmp_path / "bridge.vtu", gallery.make("bridge-sharp", size=864, scramble=0.4))
    status, _ = smoothed(tmp_path / "bridge.vtu", "--method", "laplacian", "--keep-last")
    assert status == 4
    said = capsys.readouterr().out
    assert "12 of 864 hexes are inverted. 125 were at the start." in said
    assert "Try next: Run Mend: it untangles all hexes that the fixed nodes allow" in said
    line = next(line for line in said.splitlines() if line.startswith("      hexmend "))
    words = [str(tmp_path / "mended.vtu") if word == "OUT" else word for word in shlex.split(line)]
    assert main(words[1:]) == 0  # the command that stands below it does it


def test_recipes_are_compared_with_methods(mesh, recipe, tmp_path, capsys):
    words = ["compare", mesh, "-o", tmp_path / "tables", "--methods", f"laplacian,{recipe}", "--write-meshes"]
    assert main([*map(str, words), "--max-iterations", "5"]) == 0
    rows = json.loads((tmp_path / "tables/comparison.json").read_text())["rows"]
    assert [(row["method"], row["iterations"]) for row in rows] == [("laplacian", 5), ("Two", 10)]
    assert [stage["method"] for stage in rows[1]["stages"]] == ["getme", "local-sd"]
    assert "stages" not in rows[0]
    assert io.read(tmp_path / "tables/mesh-Two.vtu").n_hexes == 125
    assert "Two" in capsys.readouterr().out


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
@pytest.mark.parametrize(("name", "scramble"), [("bridge-sharp", 0.4), ("five-side", 0.0)])
def test_the_recipes_that_come_with_hexmend_are_worth_running(path, name, scramble):
    mesh = gallery.make(name, size=500, scramble=scramble)
    recipe = read_recipe(path)
    result = smooth(mesh, recipe)
    assert result.after.inverted == 0
    assert result.after.q_min > result.before.q_min
    assert [stage.method for stage in result.stages] == [stage.smoother.name for stage in recipe.stages]
    mended = smooth(mesh, "mend", goal="shape").after
    if path.stem == "mend-then-lift":
        assert result.after.q_min > mended.q_min
    else:
        assert result.after.objective == pytest.approx(mended.objective, rel=1e-3)


def test_a_misspelt_name_of_a_recipe_has_a_hint(mesh, capsys):
    assert smoothed(mesh, "--recipe", "gentel")[0] != 0
    error = capsys.readouterr().err
    assert "Did you mean gentle?" in error
    assert all(path.stem in error for path in SHIPPED)


def test_cells_of_all_kinds_are_counted_and_called_cells(tmp_path, run_command):
    path, out = tmp_path / "mixed.vtu", tmp_path / "out.vtu"
    io.write(path, scrambled(mixed(3), 0.1))
    text = run_command("info", path).out
    assert all(f"  {kind} " in text for kind in ("hexahedron", "wedge", "pyramid", "tetrahedron"))
    assert "no cell is invalid" in text
    assert "no cell is invalid" in run_command("smooth", path, "-o", out, "--method", "local-sd").out
    cells = json.loads(run_command("info", out, "--json").out)["cells"]
    assert {kind: one["count"] for kind, one in cells.items()} == {
        "hexahedron": 12, "wedge": 18, "pyramid": 30, "tetrahedron": 12,
    }  # fmt: skip
