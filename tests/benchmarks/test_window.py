"""Start of the program: the order in which things are shown, and the modules loaded by then."""

import pytest

from benchmarks.window.start import MOMENTS, measure_start
from hexmend import io
from hexmend.gallery import make

#: Packages that are not needed to paint the window.
LATER = {"matplotlib", "pyqtgraph", "pyvista", "pyvistaqt", "scipy", "vtk", "vtkmodules"}


def loaded(moment):
    return {name.partition(".")[0] for name in moment["modules"]}


@pytest.mark.slow
def test_the_window_is_shown_before_its_mesh_and_before_slow_imports(qapp, tmp_path):
    io.write(tmp_path / "mesh.vtu", make("cube", size=27))
    moments = measure_start(tmp_path / "mesh.vtu")
    assert list(moments) == list(MOMENTS)
    assert 0 < moments["window"]["seconds"] < moments["picture"]["seconds"]
    assert "PySide6" in loaded(moments["window"])
    assert "vtkmodules" in loaded(moments["picture"])
    assert loaded(moments["window"]) & LATER == set()
    assert "matplotlib.pyplot" not in moments["picture"]["modules"]
