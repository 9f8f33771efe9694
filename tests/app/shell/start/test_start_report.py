"""Start of the program: the order in which things are shown, and the modules loaded by then."""

from __future__ import annotations

import pytest

from hexmend_app.bench.start import MOMENTS, measure_start

#: Packages that are not needed to paint the window.
LATER = {"matplotlib", "pyqtgraph", "pyvista", "pyvistaqt", "scipy", "vtk", "vtkmodules"}


@pytest.fixture(scope="module")
def moments(qapp, mesh_file):
    return measure_start(mesh_file)


def loaded(moment):
    return {name.partition(".")[0] for name in moment["modules"]}


@pytest.mark.slow
def test_the_window_is_shown_before_its_mesh(moments):
    assert list(moments) == list(MOMENTS)
    assert 0 < moments["window"]["seconds"] < moments["picture"]["seconds"]
    assert "PySide6" in loaded(moments["window"])
    assert "vtkmodules" in loaded(moments["picture"])
    assert set(moments["window"]["modules"]) <= set(moments["picture"]["modules"])


def test_the_window_is_painted_before_slow_imports(moments):
    assert loaded(moments["window"]) & LATER == set()


def test_modules_of_saved_figures_are_not_loaded(moments):
    assert "matplotlib.pyplot" not in moments["picture"]["modules"]
