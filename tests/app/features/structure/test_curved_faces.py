"""The switch of curved faces in the window, and curved faces while a method runs."""

import numpy as np
import pytest
from PySide6.QtCore import Qt

from hexmend import io
from tests.app.driving import click, open_and_wait, tick
from tests.core.curved_shell import curved_shell
from tests.core.grids import grid
from tests.patience import PATIENCE

pytestmark = pytest.mark.slow


def shell():
    """Return a shell with free nodes that are moved away from their places."""
    mesh = curved_shell(20, through=3, around=3, along=3)
    points = mesh.points.copy()
    points[mesh.free] += np.random.default_rng(0).normal(scale=0.05, size=(np.count_nonzero(mesh.free), 3))
    return mesh.with_points(points)


@pytest.fixture
def opened(window, qtbot, tmp_path):
    io.write(tmp_path / "shell.vtu", shell())
    open_and_wait(qtbot, window, tmp_path / "shell.vtu")
    window.refresh()
    return window


def parts(window):
    """Return the number of drawn polygons for each visible face."""
    layer = window.canvas.viewport.mesh_layer
    return layer.whole.n_cells / len(layer.faces.quads)


def test_the_switch_is_on_for_hexes_with_mid_nodes_and_not_offered_for_others(opened, qtbot, tmp_path):
    box, action = opened.features["structure"].panel.layers["curved"].box, opened.window_actions["show_curved"]
    assert action.isEnabled()
    assert action.isChecked()
    assert parts(opened) == 64
    opened.show_panel("show")
    tick(box)
    assert not action.isChecked()
    assert parts(opened) == 1
    action.trigger()
    opened.refresh()
    assert box.checkState() == Qt.CheckState.Checked
    assert parts(opened) == 64
    io.write(tmp_path / "grid.vtu", grid(3))
    open_and_wait(qtbot, opened, tmp_path / "grid.vtu")
    opened.refresh()
    assert not action.isEnabled()
    assert not box.isVisibleTo(opened)
    assert parts(opened) == 1


def test_iterations_are_drawn_with_the_mid_nodes_that_follow(opened, qtbot):
    document, layer = opened.session.document, opened.canvas.viewport.mesh_layer
    opened.session.view.change(show={"peel": 1})  # nodes of the inside move
    opened.refresh()
    before = np.array(layer.whole.points)
    click(opened, "Run")
    qtbot.waitUntil(lambda: not opened.session.run.busy, timeout=PATIENCE)
    opened.refresh()
    mesh = document.now.mesh
    middles = mesh.points[np.unique(mesh.mid_nodes[13, :12])]
    drawn = np.asarray(layer.whole.points)
    assert np.abs(drawn - before).max() > 0.01
    distances = np.linalg.norm(drawn[:, None] - middles[None], axis=2).min(axis=0)
    assert len(middles) == 12
    assert distances.max() < 1e-9
