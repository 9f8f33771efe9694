"""The comparison of the objective's two offsets."""

import pytest

from hexmend.gallery import make
from hexmend.io import write
from hexmend.study.bench.offsets import OFFSETS
from hexmend.study.thesis.experiments import Experiment, Experiments


@pytest.fixture
def small(monkeypatch):
    """One mesh of the thesis, and that small."""
    experiment = Experiment(
        "4.5", "FiveSide4", "five-side", 500, 500, 0, 0, 0, "initial", ("initial", "global-nr"),
        {"initial": {}, "global-nr": {"q_mean": 0.8445, "q_norm": 0.8315}},
    )  # fmt: skip
    monkeypatch.setattr("hexmend.study.bench.offsets.load", lambda: Experiments((experiment, experiment), {}, {}))


def test_each_mesh_is_one_row_with_the_figures_of_the_thesis(small, monkeypatch, tmp_path):
    write(tmp_path / "block.vtu", make("cube", size=27, scramble=0.3))
    (tmp_path / "README.md").write_text("of the meshes")
    (tmp_path / "faces.obj").write_text("v 0 0 0\n")
    monkeypatch.setenv("HEXMEND_MESHES", str(tmp_path))
    figures = OFFSETS.measure()
    assert [row["mesh"] for row in figures["runs"]] == ["FiveSide4", "block.vtu"]
    (one, zero), thesis = figures["runs"][0]["after"], figures["runs"][0]["thesis"]
    assert one["q_mean"] < zero["q_mean"]
    assert thesis["q_norm"] == 0.8315
    lines = OFFSETS.lines(figures)
    assert f"{one['q_mean']:.4f} · **{zero['q_mean']:.4f}** (0.8445)" in lines[2]
    assert "Of 2 meshes" in lines[-1]


def test_without_a_folder_the_thesiss_meshes_are_compared(small, monkeypatch):
    monkeypatch.delenv("HEXMEND_MESHES", raising=False)
    assert [row["mesh"] for row in OFFSETS.measure()["runs"]] == ["FiveSide4"]
