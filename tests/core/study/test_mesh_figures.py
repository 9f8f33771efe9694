"""Figures of meshes: drawn by the entry point, reported as missing without one."""

import json
import re

import pytest

from hexmend.errors import HexmendError
from hexmend.quality import summarise
from hexmend.report import write_study
from hexmend.study.table_row import Row
from hexmend.study.thesis import mesh_figures
from hexmend.study.thesis.experiment_result import ExperimentResult
from hexmend.study.thesis.experiments import load
from hexmend.study.thesis.mesh_figures import MESH_FIGURES, draw_figures


class Joined:
    """An entry point that gives a drawer, or lacks its libraries."""

    def __init__(self, draw):
        self._draw = draw

    def load(self):
        if self._draw is None:
            raise ImportError("no vtk")
        return self._draw


@pytest.fixture
def joining(monkeypatch):
    """Lets drawers join; None is one whose libraries are not installed."""

    def join(*draws):
        monkeypatch.setattr(mesh_figures, "entry_points", lambda group: [Joined(draw) for draw in draws])

    return join


@pytest.fixture(scope="module")
def measured():
    """The plane as made, and as getme leaves it; five-side as made; nothing of bridge-sharp."""
    plane, five = (next(one for one in load().experiments if one.mesh == name) for name in ("plane", "five-side"))
    mesh = plane.build(quick=True)
    row = Row("getme", {}, "converged", "", mesh, summarise(mesh))
    pentagon = five.build(quick=True)
    return [
        ExperimentResult(five, pentagon, summarise(pentagon), {}),
        ExperimentResult(plane, mesh, summarise(mesh), {"getme": row}),
    ]


def test_measured_experiments_are_drawn(tmp_path, measured, joining):
    drawn = []
    joining(None, lambda figure, mesh, path: drawn.append((figure.number, mesh)))
    figures, missing = draw_figures(tmp_path, measured)
    assert missing == ""
    assert [figure["number"] for figure in figures] == [number for number, _ in drawn] == ["4.3", "4.5", "4.6", "4.7"]
    assert json.loads(json.dumps(figures)) == figures
    by_number = dict(drawn)
    plane = measured[1]
    assert by_number["4.6"] is plane.mesh
    assert by_number["4.7"] is plane.rows["getme"].mesh
    assert by_number["4.3"].n_hexes == measured[0].experiment.build(quick=False).n_hexes
    assert f"{plane.initial.inverted:,} inverted" in next(one["caption"] for one in figures if one["number"] == "4.6")


@pytest.mark.slow
def test_without_the_viewer_a_line_names_the_missing_figures_and_the_remedy(tmp_path, measured, joining):
    for there in ((), (None,)):
        joining(*there)
        figures, missing = draw_figures(tmp_path, measured)
        assert figures == []
        remedy = "run  pip install '.[app]'  in the source folder of Hexmend"
        assert missing == f"Without figures 4.3, 4.5, 4.6, 4.7, of meshes: {remedy}"


def test_the_reason_is_named_where_nothing_can_be_drawn(tmp_path, measured, joining):
    def draw(figure, mesh, path):
        if figure.number == "4.7":
            raise HexmendError("pictures need OpenGL")

    joining(draw)
    figures, missing = draw_figures(tmp_path, measured)
    assert [figure["number"] for figure in figures] == ["4.3", "4.5", "4.6"]
    assert missing == "Without figure 4.7, of meshes: pictures need OpenGL"


def test_nothing_is_missing_where_nothing_was_measured(tmp_path, joining):
    joining()
    assert draw_figures(tmp_path, []) == ([], "")


def test_the_report_shows_the_figures_in_the_thesis_s_order_under_its_captions(tmp_path, measured, joining):
    joining(lambda figure, mesh, path: None)
    figures, _ = draw_figures(tmp_path, measured)
    study = {
        "quick": True, "max_seconds": 5, "max_seconds_of": {}, "interrupted": False, "claims": [], "outlooks": [],
        "experiments": [one.record() for one in measured], "figures": figures, "missing": "Without figure 9.9.",
    }  # fmt: skip
    write_study(tmp_path, study)
    text = (tmp_path / "study.md").read_text(encoding="utf-8")
    assert re.findall(r"!\[Figure ([\d.]+)\]\((\S+)\)", text) == [
        *((figure["number"], figure["file"]) for figure in figures),
        ("4.9", "figure-4.9-distributions.png"),
    ]
    for figure in figures:
        assert f"**Figure {figure['number']}**, {figure['caption']}." in text
    assert "Without figure 9.9." in text


def test_figures_have_unique_names():
    assert len({figure.number for figure in MESH_FIGURES}) == len({figure.stem for figure in MESH_FIGURES})
