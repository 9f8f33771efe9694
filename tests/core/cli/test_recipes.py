"""Recipes on the command line, and those that come with Hexmend."""

import json
import shlex
from pathlib import Path

import pytest

from hexmend import METHODS, Recipe, Stage, StoppingCriteria, gallery, io, read_recipe, smooth, summarise, write_recipe
from hexmend.cli.main import main

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
