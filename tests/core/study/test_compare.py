"""Comparisons: every method starts from the given mesh, no row is lost, and tables agree with the runs."""

import csv
import json

import numpy as np
import pytest

from hexmend import METHODS, MotionRules, ParameterError, Recipe, compare, gallery, io, write_recipe
from hexmend.cli.main import main
from hexmend.quality import Summary, measure, objective, summarise
from hexmend.run import StoppingCriteria, smooth
from hexmend.study import compare as one_row
from hexmend.study.compare import BINS
from hexmend.study.method_spec import parse_methods

#: Keys of each row in comparison.json in addition to the figures of a summary.
RUN = {
    "method", "parameters", "outcome", "message", "worse", "iterations", "kept", "seconds", "setup_seconds",
    "seconds_per_iteration", "seconds_per_iteration_and_node",
}  # fmt: skip
FEW = StoppingCriteria(max_iterations=3, tolerance=0)


@pytest.fixture(scope="module")
def mesh():
    return gallery.make("bridge-sharp", size=500, scramble=0.2)


@pytest.fixture(scope="module")
def two(mesh):
    return compare(mesh, ["laplacian", "local-sd"], FEW)


@pytest.fixture
def file(mesh, tmp_path):
    path = tmp_path / "bridge.vtu"
    io.write(path, mesh)
    return path


def test_each_row_equals_a_run_of_the_method_alone(mesh, two):
    for row in two.rows:
        alone = smooth(mesh, row.method, FEW)
        assert row.after == alone.after
        np.testing.assert_array_equal(row.mesh.points, alone.mesh.points)
        assert row.iterations == alone.iterations
    assert two.initial == summarise(mesh)


def test_the_record_has_the_agreed_keys_and_its_times_agree(mesh, two):
    record = two.record()
    assert [row["method"] for row in record["rows"]] == ["laplacian", "local-sd"]
    for row in record["rows"]:
        assert set(row) == RUN | set(Summary.__dataclass_fields__) | {"objective_formula", "distribution"}
        assert row["seconds_per_iteration"] * row["iterations"] == pytest.approx(row["seconds"])
        assert row["seconds_per_iteration_and_node"] * row["free_nodes"] == pytest.approx(row["seconds_per_iteration"])
        assert len(row["distribution"]) == BINS
        assert sum(row["distribution"]) == mesh.n_hexes


def test_all_registered_methods_are_the_default(mesh):
    assert [row.method for row in compare(mesh, stop=StoppingCriteria(max_iterations=0)).rows] == list(METHODS)


@pytest.mark.parametrize("after", [1, 2])
def test_a_watch_that_returns_false_keeps_the_rows_so_far(mesh, after):
    seen = []
    answer = compare(mesh, METHODS, FEW, watch=lambda run: seen.append(run.smoother.name) or len(seen) < after)
    assert answer.interrupted
    assert [(row.method, row.outcome, row.iterations) for row in answer.rows] == [
        (next(iter(METHODS)), "stopped", after)
    ]


def test_an_interrupt_while_a_method_is_prepared_keeps_the_others(mesh, monkeypatch):
    def iterate(mesh, smoother, stop):
        if smoother.name == "local-sd":
            raise KeyboardInterrupt
        return real(mesh, smoother, stop)

    real = one_row.iterate
    monkeypatch.setattr(one_row, "iterate", iterate)
    answer = compare(mesh, ["laplacian", "local-sd", "smart-laplacian"], FEW)
    assert answer.interrupted
    assert [(row.method, row.outcome) for row in answer.rows] == [
        ("laplacian", "max-iterations"),
        ("local-sd", "stopped"),
    ]
    assert answer.rows[1].after == answer.initial


def test_an_interrupt_between_two_methods_keeps_the_rows_so_far(mesh, monkeypatch):
    def run_one(mesh, smoother, stop, watch):
        if smoother.name == "local-sd":
            raise KeyboardInterrupt
        return done, True

    done = compare(mesh, ["laplacian"], FEW).rows[0]
    monkeypatch.setattr("hexmend.study.compare.run_one", run_one)
    answer = compare(mesh, ["laplacian", "local-sd"], FEW)
    assert answer.interrupted
    assert answer.rows == (done,)


def test_a_method_that_fails_has_a_row_and_the_others_are_run(mesh, monkeypatch):
    def steps(self, mesh):
        raise np.linalg.LinAlgError("singular matrix")
        yield

    monkeypatch.setattr(METHODS["smart-laplacian"], "steps", steps)
    failing = METHODS["smart-laplacian"](guard="quality")
    answer = compare(mesh, ["laplacian", failing, "local-sd"], FEW)
    assert [row.outcome for row in answer.rows] == ["max-iterations", "failed", "max-iterations"]
    assert answer.rows[1].message == "Failed: singular matrix"
    assert answer.record()["rows"][1]["q_mean"] is None


def test_settings_reach_the_methods_that_declare_them():
    laplacian, descent, newton = parse_methods(
        ["laplacian", "local-sd", "local-nr", "local-sd"],
        {"local-nr.delta": "0.2", "delta": "0.1", "max-backtracks": "7"},
    )
    assert (laplacian.name, descent.name, newton.name) == ("laplacian", "local-sd", "local-nr")
    assert (descent.delta, newton.delta) == (0.1, 0.2)
    assert (descent.max_backtracks, newton.max_backtracks) == (7, 7)


@pytest.mark.parametrize(("names", "settings", "message"), [
    (["laplacian", "local-sd"], {"deltta": "1"}, "has a parameter 'deltta': did you mean delta"),
    (["laplacian"], {"delta": "1"}, "none of the methods laplacian has a parameter 'delta'"),
    (["laplacian"], {"local-sd.delta": "1"}, "'local-sd' is not among the methods compared: laplacian"),
    (["laplacian", "local-sd"], {"laplacian.delta": "1"}, "laplacian has no parameter 'delta'"),
    (["lapalcian"], {}, "did you mean laplacian"),
    (["local-sd"], {"p": "0.5"}, "p = 0.5 is out of range"),
])  # fmt: skip
def test_wrong_settings_are_reported(names, settings, message):
    with pytest.raises(ParameterError, match=message):
        parse_methods(names, settings)


def test_the_command_writes_tables_that_agree_and_the_meshes(file, tmp_path, capsys):
    folder = tmp_path / "deep" / "tables"
    words = ["compare", file, "-o", folder, "--methods", "laplacian,local-sd", "--write-meshes", "--set", "p=3"]
    assert main([*map(str, words), "--max-iterations", "5"]) == 0
    record = json.loads((folder / "comparison.json").read_text())
    assert record["stop"]["max_iterations"] == 5
    assert record["rows"][1]["parameters"]["p"] == 3
    with open(folder / "comparison.csv", newline="", encoding="utf-8") as table:
        rows = {row["method"]: row for row in csv.DictReader(table)}
    assert list(rows) == ["initial", "laplacian", "local-sd"]
    for row in record["rows"]:
        mesh = io.read(folder / f"bridge-{row['method']}.vtu")
        written = summarise(mesh)
        own = written.to_dict() | {
            "objective": objective(measure(mesh.points, mesh.hexes), p=3.0)
        }  # of the optimiser among them
        assert own == {key: row[key] for key in own}
        assert float(rows[row["method"]]["q_mean"]) == row["q_mean"]
        assert int(rows[row["method"]]["iterations"]) == row["iterations"]
    said = capsys.readouterr().out
    for text in (said, (folder / "comparison.md").read_text(), (folder / "comparison.tex").read_text()):
        assert f"{record['rows'][1]['q_mean']:.4f}" in text


@pytest.mark.parametrize(("words", "status", "message"), [
    (["{file}", "-o", "{folder}", "--methods", "laplacian,nothing"], 2, "there is no method 'nothing'"),
    (["{file}", "-o", "{folder}", "--methods", "laplacian", "--set", "p=3"], 2, "has a parameter 'p'"),
    (["{file}", "-o", "{folder}", "--max-iterations", "few"], 2, "max_iterations = 'few' is not a whole number"),
    (["missing.vtu", "-o", "{folder}"], 3, "missing.vtu: there is no such file"),
    (["{file}", "-o", "{file}"], 3, "bridge.vtu: is a file"),
    (["{file}", "-o", "{folder}", "--methods", "mend", "--target", "foo"], 2, "there is no target 'foo'"),
    (["{file}", "-o", "{folder}", "--methods", "{recipe}"], 2, "there is no target 'bar'"),
    (["{file}", "-o", "{folder}", "--fix", "nowhere"], 3, "'nowhere'"),
])  # fmt: skip
def test_wrong_usage_is_reported_before_the_first_run(words, status, message, file, tmp_path, complaint):
    write_recipe(tmp_path / "chain.toml", Recipe.of("laplacian", METHODS["mend"](target="bar")))
    words = [word.format(file=file, folder=tmp_path / "tables", recipe=tmp_path / "chain.toml") for word in words]
    assert message in complaint("compare", *words, status=status)
    assert not (tmp_path / "tables").exists()


def test_the_command_fails_where_every_method_fails(file, tmp_path, monkeypatch, run_command):
    def steps(self, mesh):
        raise ValueError("no")

    monkeypatch.setattr(METHODS["laplacian"], "steps", steps)
    words = ["compare", str(file), "-o", str(tmp_path / "tables"), "--max-iterations", "2", "--methods"]
    assert "every method failed" in run_command(*words, "laplacian", status=3).err
    assert (tmp_path / "tables/comparison.md").exists()
    assert main([*words, "laplacian,local-sd"]) == 0


def test_rules_of_motion_hold_for_methods_and_recipes(mesh, tmp_path):
    inside = np.flatnonzero(~mesh.topology.boundary)
    some, others = inside[::2], inside[1::2]
    io.write(tmp_path / "part.vtu", mesh.replace(node_sets={"some": some, "others": others}))
    write_recipe(tmp_path / "chain.toml", Recipe.of("laplacian", title="Chain", rules=MotionRules(fix=["others"])))
    words = ["compare", tmp_path / "part.vtu", "-o", tmp_path / "tables", "--write-meshes", "--max-iterations", 2]
    words += ["--methods", f"laplacian,{tmp_path / 'chain.toml'}", "--fix", "some"]
    assert main([*map(str, words)]) == 0
    method, chain = (io.read(tmp_path / "tables" / f"part-{name}.vtu") for name in ("laplacian", "Chain"))
    assert (method.points[some] == mesh.points[some]).all()
    assert not (method.points[others] == mesh.points[others]).all()
    assert (chain.points[inside] == mesh.points[inside]).all()
