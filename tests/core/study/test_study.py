"""The study of the thesis: published figures as printed, equal runs run once, claims follow the figures."""

import csv
import itertools
import json
from dataclasses import replace

import pytest

from hexmend.cli.main import main
from hexmend.errors import HexmendError, ParameterError
from hexmend.gallery import GALLERY
from hexmend.quality import summarise
from hexmend.report import plots, write_experiment, write_study
from hexmend.smoothers import METHODS
from hexmend.study.claims import CLAIMS
from hexmend.study.outlook.claims import OUTLOOK_CLAIMS
from hexmend.study.table_row import Row
from hexmend.study.thesis import mesh_figures
from hexmend.study.thesis.experiments import INITIAL, load
from hexmend.study.thesis.runner import run_experiments, select_tables

THESIS = load()

#: Two tables of two meshes through the same engine, in a second.
TINY = """
[iterations]
laplacian = 50
local-sd = 100
global-nr = 30
[seconds]
full = 60
quick = 60
[[experiment]]
table = "1"
thesis_mesh = "Bridge, Laplace"
mesh = "bridge-sharp"
size = 1000
quick = 2048
hexes = 1000
free_nodes = 1
inverted = 0
start = "laplacian"
delta = 0.05
columns = ["laplacian", "local-sd", "laplace-sd"]
[experiment.published]
q_min = [0.125, nan, 0.5]
[[experiment]]
table = "2"
thesis_mesh = "Five"
mesh = "five-side"
size = 1000
quick = 60
hexes = 1000
free_nodes = 1
inverted = 0
start = "initial"
columns = ["initial", "local-sd"]
additional = ["global-nr"]
[experiment.published]
q_mean = [0.5, 0.625]
[[experiment]]
table = "4.14"
thesis_mesh = "Five"
mesh = "five-side"
size = 1000
quick = 60
hexes = 1000
free_nodes = 1
inverted = 0
start = "initial"
columns = ["initial", "laplacian", "local-sd"]
[experiment.published]
q_mean = [0.5, 0.625, 0.75]
"""


@pytest.fixture(scope="module")
def tiny(tmp_path_factory):
    path = tmp_path_factory.mktemp("study") / "tiny.toml"
    path.write_text(TINY)
    return load(path)


@pytest.fixture(scope="module")
def seen():
    return []


@pytest.fixture(scope="module")
def study(tiny, seen):
    def watch(run):
        if run.last.number == 1:
            seen.append((run.mesh.n_hexes, run.smoother.name))

    return run_experiments(tiny, quick=True, watch=watch)


def published():
    """Every published column: its experiment, its name, its figures."""
    return [(one, column, one.published[column]) for one in THESIS.experiments for column in one.columns]


def test_all_tables_of_the_thesis_are_there():
    assert list(dict.fromkeys(one.table for one in THESIS.experiments)) == [f"4.{k}" for k in range(1, 16)]
    assert len({(one.table, one.thesis_mesh) for one in THESIS.experiments}) == len(THESIS.experiments)
    for one in THESIS.experiments:
        assert one.mesh in GALLERY
        assert set(one.methods) <= set(METHODS)
        assert one.start == one.columns[0]
        assert one.start == INITIAL or one.start in METHODS
        assert {*one.columns, *one.additional} - {INITIAL} <= set(THESIS.iterations)
        assert not set(one.additional) & set(one.columns)
        assert one.quick <= one.size <= 1.01 * one.hexes
    assert set(THESIS.quick_seconds) <= set(METHODS)


def test_published_times_agree_with_themselves():
    """Time over iterations is time per iteration, and that over free nodes is the last line: no figure slipped."""
    checked = 0
    for one, column, figures in published():
        if "seconds_per_iteration" in figures:
            assert figures["seconds"] / figures["iterations"] == pytest.approx(
                figures["seconds_per_iteration"], rel=2e-3
            ), (one.table, column)
            checked += 1
        if "seconds_per_iteration_and_node" in figures:
            assert figures["seconds_per_iteration"] / one.free_nodes == pytest.approx(
                figures["seconds_per_iteration_and_node"], rel=2e-3
            ), (one.table, column)
    assert checked > 70


def test_published_qualities_are_possible():
    for one, column, figures in published():
        ordered = [figures[key] for key in ("q_min", "q_norm", "q_mean", "q_max") if key in figures]
        if figures.get("q_norm") == 0:  # some q is 0
            ordered.remove(0)
        assert ordered == sorted(ordered), (one.table, column)
        assert all(0 <= value <= 1 for value in ordered)


def test_one_mesh_has_one_initial_state_in_all_tables():
    known = {}
    for one in THESIS.experiments:
        if figures := one.published.get(INITIAL):
            first = known.setdefault(one.thesis_mesh, figures)
            for key in figures.keys() & first.keys():
                assert figures[key] == first[key], (one.table, key)


def test_tables_are_chosen_by_their_numbers():
    assert [one.table for one in select_tables(THESIS, ["4.15", "4.2"]).experiments] == ["4.2", "4.15", "4.15"]
    with pytest.raises(ParameterError, match=r"no table '5\.1'"):
        select_tables(THESIS, ["4.1", "5.1"])


def test_runs_that_tables_share_run_once(study, seen):
    five = study.results[1].mesh.n_hexes
    assert seen.count((five, "local-sd")) == 1
    assert len(seen) == len(set(seen)) == 5
    assert study.results[1].rows["local-sd"] is study.results[2].rows["local-sd"]


def test_methods_start_from_the_result_of_the_start_with_its_delta(study):
    bridge = study.results[0]
    start, descent = bridge.rows["laplacian"], bridge.rows["local-sd"]
    assert bridge.start == start.after != bridge.initial
    assert descent.parameters["delta"] == 0.05
    assert "delta" not in start.parameters
    assert study.record()["experiments"][0]["inverted"] == start.after.inverted > bridge.initial.inverted


def test_a_column_without_published_figures_has_measured_ones_only(study, tmp_path):
    five = study.results[1].record()
    assert list(five["columns"]) == [INITIAL, "local-sd", "global-nr"]
    assert "global-nr" not in five["published"]
    write_experiment(tmp_path, five)
    with open(tmp_path / "table-2-five.csv", newline="", encoding="utf-8") as file:
        rows = {row["method"]: row for row in csv.DictReader(file)}
    assert (rows["local-sd"]["thesis_q_mean"], rows["global-nr"]["thesis_q_mean"]) == ("0.625", "")
    assert float(rows["global-nr"]["q_mean"]) == study.results[1].rows["global-nr"].after.q_mean


def test_an_unknown_method_loses_only_its_own_column(study):
    row = study.results[0].rows["laplace-sd"]
    assert row.outcome == "failed"
    assert "there is no method 'laplace-sd'" in row.message
    assert study.results[0].rows["local-sd"].after.inverted == 0


def test_the_report_compares_measured_with_published_figures(study, tmp_path):
    record = study.record()
    for experiment in record["experiments"]:
        write_experiment(tmp_path, experiment)
    write_study(tmp_path, record)
    with open(tmp_path / "table-1-bridge-laplace.csv", newline="", encoding="utf-8") as file:
        rows = {row["method"]: row for row in csv.DictReader(file)}
    assert [row["thesis_q_min"] for row in rows.values()] == ["0.125", "", "0.5"]
    ours = study.results[0].rows["local-sd"].after
    assert float(rows["local-sd"]["q_min"]) == ours.q_min
    index = (tmp_path / "study.md").read_text(encoding="utf-8")
    for text in (f"{ours.q_min:.4f}", "0.1250", "The mesh is ours", "## Claims", "figure-4.4-scaling.png"):
        assert text in index
    back = json.loads((tmp_path / "study.json").read_text(encoding="utf-8"))
    assert back == record
    assert len(back["claims"]) == len(CLAIMS) + len(OUTLOOK_CLAIMS)
    for name in ("figure-4.4-scaling", "figure-4.9-distributions"):
        assert (tmp_path / f"{name}.svg").read_text(encoding="utf-8").startswith("<?xml")
        assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")


def test_without_matplotlib_the_tables_are_written_and_the_remedy_is_named(study, tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "matplotlib.figure", None)
    with pytest.raises(HexmendError, match=r"pip install '.\[report\]'"):
        write_study(tmp_path, study.record())
    assert sorted(path.name for path in tmp_path.iterdir()) == ["study.json", "study.md"]
    assert "## Figures" not in (tmp_path / "study.md").read_text(encoding="utf-8")


def test_equal_figures_make_equal_drawings(tmp_path):
    counts = {"initial": [1, 2, 3], "laplacian": [3, 2, 1]}
    first, second = (plots.distributions(tmp_path / name, counts, "t")[0] for name in "ab")
    assert first.read_bytes() == second.read_bytes()


def test_a_study_that_is_interrupted_keeps_its_columns(tiny):
    left = itertools.count()
    study = run_experiments(tiny, quick=True, watch=lambda run: run.smoother.name != "local-sd" or next(left) < 2)
    assert study.interrupted
    assert [list(one.rows) for one in study.results] == [["laplacian", "local-sd"]]
    assert study.results[0].rows["local-sd"].outcome == "stopped"
    json.dumps(study.record(), allow_nan=False)


def test_a_study_that_is_interrupted_between_two_runs_keeps_what_was_measured(tiny):
    def done(one):
        raise KeyboardInterrupt

    study = run_experiments(tiny, quick=True, done=done)
    assert study.interrupted
    assert len(study.results) == 1


@pytest.mark.slow
def test_the_command_runs_a_table(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(mesh_figures, "entry_points", lambda group: [])  # without the viewer
    assert main(["study", "thesis", "--quick", "--only", "4.11", "-o", str(tmp_path)]) == 0
    said, complained = capsys.readouterr()
    assert "Written to" in said
    assert (
        "Without figure 4.3, of meshes: run  pip install '.[app]'  in the source folder of Hexmend"
        in complained.splitlines()
    )
    for mesh in ("fiveside4", "fiveside5"):
        assert {path.suffix for path in tmp_path.glob(f"table-4.11-{mesh}.*")} == {".csv", ".md", ".tex", ".json"}


def test_an_unknown_table_is_wrong_usage(tmp_path, capsys):
    assert main(["study", "thesis", "--only", "9", "-o", str(tmp_path / "x")]) == 2
    assert "there is no table '9'" in capsys.readouterr().err
    assert not (tmp_path / "x").exists()


def test_methods_have_the_settings_and_the_convergence_criteria_of_the_study():
    thesis = load()
    assert thesis.stop("local-sd", quick=False).move == "coordinate"
    by_table = {one.table: one for one in thesis.experiments if one.start == "laplacian"}
    values = thesis.smoother(by_table["4.4"], "local-nr").values()
    assert (values["offset"], values["delta"], values["delta_unit"]) == (0.0, 0.2, "extent")
    assert thesis.smoother(by_table["4.3"], "global-nr").values()["delta_unit"] == "mesh"
    assert thesis.smoother(by_table["4.3"], "getme").values()["weights"] == "paper"


def test_quick_runs_are_repeated_and_the_least_time_counts(tiny, monkeypatch):
    seconds = iter([3.0, 1.0, 2.0])

    def run(mesh, smoother, stop, watch):
        return Row(smoother.name, {}, "converged", "", mesh, summarise(mesh), 1, next(seconds)), True

    monkeypatch.setattr("hexmend.study.thesis.runner.run_one", run)
    one = replace(tiny.experiments[0], start="initial", columns=("initial", "local-sd"), additional=())
    repeated = replace(tiny, experiments=(one,), outlooks=(), repeats={"times": 3, "below": 5.0})
    assert run_experiments(repeated).results[0].rows["local-sd"].seconds == 1.0
    seconds = iter([6.0])
    assert run_experiments(repeated).results[0].rows["local-sd"].seconds == 6.0


@pytest.mark.slow
def test_meshes_of_the_thesis_with_inverted_hexes_have_as_many():
    for one in load().experiments:
        if one.scramble:
            assert summarise(one.build(quick=False)).inverted == one.inverted


def test_every_run_can_be_given_another_limit(capsys, tmp_path):
    assert load().with_max_seconds(7.0).stop("local-sd", quick=True).max_seconds == 7
    assert load().with_max_seconds(7.0).stop("getme", quick=False).max_seconds == 7
    assert main(["study", "thesis", "-o", str(tmp_path), "--max-seconds", "soon"]) == 2
    assert "max_seconds = 'soon' is not a number" in capsys.readouterr().err
