"""The start of the whole program: what is on the screen when, and what was loaded for it."""

from __future__ import annotations

import pytest

from hexmend_app.bench.start import MOMENTS, measure_start

#: Top packages that the first paint of the window can do without.
LATER = {"matplotlib", "pyqtgraph", "pyvista", "pyvistaqt", "scipy", "vtk", "vtkmodules"}


@pytest.fixture(scope="module")
def moments(qapp, mesh_file):
    return measure_start(mesh_file)


def loaded(moment):
    return {name.partition(".")[0] for name in moment["modules"]}


@pytest.mark.slow
def test_the_window_is_there_first_and_then_its_mesh(moments):
    assert list(moments) == list(MOMENTS)
    assert 0 < moments["window"]["seconds"] < moments["picture"]["seconds"]
    assert "PySide6" in loaded(moments["window"])
    assert "vtkmodules" in loaded(moments["picture"])
    assert set(moments["window"]["modules"]) <= set(moments["picture"]["modules"])


def test_the_window_is_painted_before_what_draws_in_it_is_loaded(moments):
    assert loaded(moments["window"]) & LATER == set()


def test_nothing_is_loaded_that_saved_figures_alone_need(moments):
    assert "matplotlib.pyplot" not in moments["picture"]["modules"]
