"""Sections of the benchmark measure small inputs, and their tables have a cell for each head."""

import pytest

from benchmarks.__main__ import parser
from benchmarks.mend import surface_quality
from benchmarks.scale.scale import SCALE
from benchmarks.sections import SECTIONS
from hexmend import io
from hexmend.gallery import make


def cells(lines):
    """Return the numbers of cells in the rows of a table."""
    return {line.count("|") for line in lines if line.startswith("|")}


@pytest.fixture
def meshes(tmp_path, monkeypatch):
    """Folder with one small mesh, under a name that sections look for."""
    io.write(tmp_path / "bone.vtk", make("cube", size=27, scramble=0.3))
    monkeypatch.setenv("HEXMEND_MESHES", str(tmp_path))


def test_the_help_lists_every_section_in_a_line():
    words = [line.split()[0] for line in parser().format_help().splitlines() if line.startswith("  ")]
    assert words[-len(SECTIONS) :] == list(SECTIONS)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["boundaries", "freedom", "goals", "optima", "padding"])
def test_a_section_measures_the_meshes_of_the_folder(meshes, monkeypatch, name):
    monkeypatch.setattr("benchmarks.mend.default_method._MESHES", [("cube", 27, 0.3)])
    monkeypatch.setattr("benchmarks.mend.padding._CASES", [("bone.vtk", None)])
    figures = SECTIONS[name].measure()
    assert len(next(iter(figures.values()))) > 0
    assert len(cells(SECTIONS[name].lines(figures))) <= 1


@pytest.mark.slow
def test_whole_processes_are_measured_by_size(monkeypatch):
    for variable, value in {"HEXMEND_SCALE": "100", "HEXMEND_KERSHAW": "6", "HEXMEND_RANKS": "1"}.items():
        monkeypatch.setenv(variable, value)
    lines = SCALE.lines(SCALE.measure())
    assert len(cells(lines)) == 1
    assert "inverted hexes left: 0" in lines[-1]
    assert float(lines[-1].split()[-2]) == pytest.approx(0, abs=1e-6)  # kershaw becomes the lattice


@pytest.mark.slow
def test_quads_of_the_surface_end_better_with_weight(monkeypatch):
    monkeypatch.delenv("HEXMEND_MESHES", raising=False)
    for name, value in {"_SIZE": 300, "_ITERATIONS": 40, "_METHODS": ("local-nr",), "_WEIGHTS": (0.0, 10.0)}.items():
        monkeypatch.setattr(surface_quality, name, value)
    figures = surface_quality.SURFACE_QUALITY.measure()
    _, without, with_quads = figures["runs"]
    assert with_quads["quad_q_mean"] > without["quad_q_mean"]
    assert len(cells(surface_quality.SURFACE_QUALITY.lines(figures))) == 1
