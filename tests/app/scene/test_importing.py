"""Drawing does not import plotting libraries."""

import subprocess
import sys

import pytest


@pytest.mark.slow
def test_a_process_that_draws_loads_no_plots():
    program = "import sys, hexmend_app.scene.page.page_renderer; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    loaded = set(done.stdout.split())
    assert "pyvista" in loaded
    assert loaded.isdisjoint({"pyvista.plotting", "matplotlib.pyplot"})
