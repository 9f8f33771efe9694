"""The experiments of the thesis: published figures as printed, and the report."""

from dataclasses import replace
from itertools import pairwise

import pytest

from benchmarks.thesis import study
from benchmarks.thesis.claims import CLAIMS
from benchmarks.thesis.experiments import INITIAL, load
from benchmarks.thesis.outlook.claims import OUTLOOK_CLAIMS
from benchmarks.thesis.report import table_rows
from hexmend.gallery import GALLERY
from hexmend.report.comparison import LINES
from hexmend.smoothers import METHODS

THESIS = load()
COLUMNS = [(one, column, one.published[column]) for one in THESIS.experiments for column in one.columns]


def test_all_tables_of_the_thesis_are_there():
    assert list(dict.fromkeys(one.table for one in THESIS.experiments)) == [f"4.{k}" for k in range(1, 16)]
    for one in THESIS.experiments:
        assert one.mesh in GALLERY
        assert set(one.methods) <= set(METHODS)
        assert one.start == one.columns[0]
        assert {*one.columns, *one.additional} - {INITIAL} <= set(THESIS.iterations)


def test_published_times_agree_with_themselves():
    """Time over iterations is time per iteration, and that over free nodes is the last line."""
    for one, column, figures in COLUMNS:
        each = figures.get("seconds_per_iteration")
        if each is not None:
            assert figures["seconds"] / figures["iterations"] == pytest.approx(each, rel=2e-3), (one.table, column)
        node = figures.get("seconds_per_iteration_and_node")
        if node is not None:
            assert each / one.free_nodes == pytest.approx(node, rel=2e-3), (one.table, column)


def test_published_qualities_are_possible():
    for one, column, figures in COLUMNS:
        ordered = [figures[key] for key in ("q_min", "q_norm", "q_mean", "q_max") if figures.get(key)]
        assert all(a <= b for a, b in pairwise([0, *ordered, 1])), (one.table, column)


@pytest.mark.parametrize("claim", [*CLAIMS, *OUTLOOK_CLAIMS], ids=lambda claim: claim.__name__)
def test_every_claim_is_judged_without_figures(claim):
    assert claim([]).reproduced is None
    assert claim([]).figures


def test_a_published_figure_stands_below_ours():
    columns = {"initial": {"q_min": 0.25}, "local-sd": {"q_min": 0.5}}
    rows = table_rows(columns, {"local-sd": {"q_min": 0.75}})
    at = next(k for k, row in enumerate(rows) if row[0] == "q min")
    assert rows[at : at + 2] == [["q min", "0.2500", "0.5000"], ["– thesis", "–", "0.7500"]]
    assert [row[0] for row in rows if row[0] != "– thesis"] == [figure.label for figure in LINES]


@pytest.mark.slow
def test_a_quick_study_writes_its_tables_figures_and_claims(tmp_path, monkeypatch, capsys):
    small = [replace(one, quick=min(one.quick, 2000)) for one in THESIS.experiments if one.table in ("4.5", "4.14")]
    outlooks = tuple(replace(one, quick=200) for one in THESIS.outlooks[:1])
    monkeypatch.setattr(study, "load", lambda: replace(THESIS, experiments=tuple(small), outlooks=outlooks))
    study.run(str(tmp_path), quick=True, max_seconds=1)
    names = {path.name for path in tmp_path.iterdir()}
    assert {"study.md", "study.json", "figure-4.4-scaling.png", "figure-4.9-distributions.png"} <= names
    assert {name[:10] for name in names if name.endswith(".png")} == {f"figure-4.{k}" for k in range(3, 10)}
    assert any(name.startswith("table-4.5") for name in names)
    assert any(name.startswith("section-") for name in names)
    text = (tmp_path / "study.md").read_text("utf-8")
    assert text.count("eproduced.**") + text.count("Not judged.**") == len(CLAIMS) + len(OUTLOOK_CLAIMS)
    assert "Written to" in capsys.readouterr().out
