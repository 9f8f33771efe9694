"""Drawing does not import plotting libraries."""

import pytest

from tests.programs import run_python


@pytest.mark.slow
def test_a_process_that_draws_loads_no_plots():
    program = "import sys, hexmend_app.scene.page.page_renderer; print(*sys.modules)"
    done = run_python("-c", program, check=True)
    loaded = set(done.stdout.split())
    assert "pyvista" in loaded
    assert loaded.isdisjoint({"pyvista.plotting", "matplotlib.pyplot"})
