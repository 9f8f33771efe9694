"""Experiments of section 5.2: all combinations are run, arrivals are near the optimum, claims follow the figures."""

import csv
import itertools
import json
from dataclasses import replace

import pytest

from hexmend.cli.main import main
from hexmend.gallery import GALLERY
from hexmend.quality import Summary
from hexmend.report import write_outlook, write_study
from hexmend.smoothers import METHODS
from hexmend.smoothers.visit_order import ORDERS
from hexmend.study.outlook.claims import OUTLOOK_CLAIMS, from_the_boundary, middle_ground
from hexmend.study.outlook.experiments import NEAR, Outlook, Point, TrialResult, Variant, run_outlook
from hexmend.study.table_row import Row
from hexmend.study.thesis.experiments import Experiments, load
from hexmend.study.thesis.runner import run_experiments, select_tables

THESIS = load()
TINY = Outlook(
    "5.2.5", "Large patches", "bridge-sharp", 512, 256, ("local-patch",),
    {"overlap": (0, 1), "patch": (1, 8)}, ("local-nr", "global-nr"),
)  # fmt: skip


def stop(method):
    return THESIS.stop(method, True)


@pytest.fixture(scope="module")
def tried():
    return run_outlook(TINY, stop, True)[0]


def test_the_outlooks_name_known_meshes_methods_and_parameters():
    assert {one.section for one in THESIS.outlooks} == {"3.2.2", "5.2.5", "5.2.6"}
    for one in THESIS.outlooks:
        assert one.mesh in GALLERY
        assert set(one.methods + one.additional) <= set(METHODS)
        assert one.quick < one.size
        variants = one.variants()
        assert len({smoother for smoother, _ in variants}) == len(variants)
        if "order" in one.vary:
            assert one.vary["order"] == tuple(ORDERS)


def test_every_combination_is_run_and_its_history_recorded(tried):
    assert [one.row.method for one in tried.variants] == ["local-nr", "global-nr"] + 4 * ["local-patch"]
    assert [tuple(one.values.values()) for one in tried.variants[2:]] == [(0, 1), (0, 8), (1, 1), (1, 8)]
    for one in tried.variants:
        assert one.row.outcome == "converged"
        assert [point.iteration for point in one.history] == list(range(1, one.row.iterations + 1))
        assert one.history[-1].objective == pytest.approx(one.row.after.objective)
        arrival = one.arrival(tried.optimum)
        before = one.history[: arrival.iteration - 1]
        assert arrival.objective < (1 + NEAR) * tried.optimum <= min((point.objective for point in before), default=9e9)


def test_evaluations_are_counted_for_methods_that_report_them(tried):
    for one in tried.variants:
        counts = [point.evaluations for point in one.history]
        if one.row.method == "global-nr":
            assert set(counts) == {None}
        else:
            assert all(0 < a < b for a, b in itertools.pairwise(counts))
    single, node = tried.find("local-patch", overlap=0, patch=1), tried.find("local-nr")
    assert single.history[0].evaluations == pytest.approx(node.history[0].evaluations, rel=1e-3)
    assert tried.find("local-patch", overlap=0, patch=9) is None


def test_an_outlook_that_is_interrupted_keeps_what_was_run():
    part, completed = run_outlook(TINY, stop, True, lambda run: run.smoother.name != "global-nr")
    assert not completed
    assert [one.row.outcome for one in part.variants] == ["converged", "stopped"]
    study = run_experiments(
        Experiments((), THESIS.iterations, THESIS.seconds, outlooks=(TINY, TINY)), quick=True, watch=lambda run: False
    )
    assert study.interrupted
    assert len(study.trials) == 1
    json.dumps(study.record(), allow_nan=False)


def test_the_report_has_a_line_a_run(tried, tmp_path):
    record = tried.record()
    write_outlook(tmp_path, record)
    assert json.loads((tmp_path / "section-5.2.5-bridge-sharp.json").read_text(encoding="utf-8")) == record
    with open(tmp_path / "section-5.2.5-bridge-sharp.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["near_iterations"] for row in rows] == [str(run["near_iterations"]) for run in record["runs"]]
    text = (tmp_path / "section-5.2.5-bridge-sharp.md").read_text(encoding="utf-8")
    assert "5.2.5, Large patches: bridge-sharp" in text
    assert "within 0.1 %" in text
    study = run_experiments(replace(THESIS, experiments=(), outlooks=()), quick=True)
    write_study(tmp_path, study.record() | {"outlooks": [record]})
    index = (tmp_path / "study.md").read_text(encoding="utf-8")
    assert "## Sections 3.2.2 and 5.2, tried" in index
    assert "(section-5.2.5-bridge-sharp.csv)" in index


def test_sections_are_chosen_like_tables():
    some = select_tables(THESIS, ["5.2.6", "4.2"])
    assert [one.table for one in some.experiments] == ["4.2"]
    assert [one.section for one in some.outlooks] == ["5.2.6", "5.2.6"]


@pytest.mark.slow
def test_the_command_runs_a_section(tmp_path, capsys, monkeypatch):
    small = replace(THESIS, outlooks=(TINY,))
    monkeypatch.setattr("hexmend.study.thesis.experiments.load", lambda: small)
    assert main(["study", "thesis", "--quick", "--only", "5.2.5", "-o", str(tmp_path)]) == 0
    assert "Section 5.2.5, bridge-sharp: section-5.2.5-bridge-sharp.md" in capsys.readouterr().out


def made(section, vary, *runs):
    """An outlook as if tried: runs are (method, values, sweeps and seconds until it arrived, or None)."""
    end = Summary(**dict.fromkeys(Summary.__dataclass_fields__, 0) | {"objective": 1.0, "hexes": 8})
    variants = []
    for method, values, arrival in runs:
        far, near = Point(0, 0.0, 2.0, 1.0), Point(*(arrival or (0, 0.0)), 1.0, 2.0)
        row = Row(method, {}, "converged", "", None, end)
        variants.append(Variant(values, row, (far, near) if arrival else (far,)))
    methods = tuple(dict.fromkeys(method for method, *_ in runs))
    return TrialResult(Outlook(section, "", "cube", 8, 8, methods, vary), end, tuple(variants))


@pytest.mark.parametrize(("seconds", "expected"), [(0.5, True), (1.5, False), (3, False)])
def test_patches_must_beat_both_extremes_in_seconds(seconds, expected):
    one = made(
        "5.2.5", {"overlap": (0,), "patch": (1, 8)},
        ("local-nr", {}, (20, 1.0)), ("global-nr", {}, (4, 2.0)),
        ("local-patch", {"overlap": 0, "patch": 1}, (20, 4.0)),
        ("local-patch", {"overlap": 0, "patch": 8}, (2, seconds)),
    )  # fmt: skip
    claim = middle_ground([one])
    assert claim.reproduced is expected
    assert "2 sweeps in place of 20" in claim.figures


@pytest.mark.parametrize(("inward", "expected"), [((8, 1.0), True), ((10, 1.0), False), (None, None)])
def test_inward_must_take_fewer_sweeps_than_the_natural_order(inward, expected):
    one = made(
        "5.2.6", {"order": ("natural", "inward")},
        ("local-nr", {"order": "natural"}, (10, 1.0)), ("local-nr", {"order": "inward"}, inward),
    )  # fmt: skip
    assert from_the_boundary([one]).reproduced is expected


@pytest.mark.parametrize("claim", OUTLOOK_CLAIMS)
def test_every_expectation_is_judged_without_figures(claim):
    answer = claim([])
    assert answer.reproduced is None
    assert answer.figures
