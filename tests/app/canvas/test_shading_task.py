"""Shading is computed in the background when nothing moves."""

import numpy as np
import pytest

from tests.patience import PATIENCE


def rested(window, qtbot):
    """Wait until the view is shaded, and return its mesh layer."""
    window.canvas.rest()
    mesh_layer = window.canvas.viewport.mesh_layer
    qtbot.waitUntil(lambda: mesh_layer.light is not None and not window.canvas.shading_task.active, timeout=PATIENCE)
    return mesh_layer


def test_a_view_at_rest_is_shaded(window, qtbot):
    mesh_layer = rested(window, qtbot)
    assert mesh_layer.needs_shading is None
    assert mesh_layer.light.min() < 1


@pytest.mark.slow
def test_a_change_computes_the_shading_again(window, qtbot):
    mesh_layer = rested(window, qtbot)
    before = mesh_layer.light
    heard = []
    window.canvas.shading_task.finished.connect(lambda: heard.append(1))
    window.session.view.change(show={"hidden": frozenset(np.arange(40).tolist())})
    qtbot.waitUntil(lambda: bool(heard), timeout=PATIENCE)
    assert mesh_layer.light is not before


@pytest.mark.slow
def test_shutting_down_ends_the_computation(window):
    window.canvas.panes.still()
    window.canvas.shading_task.start()
    window.canvas.shading_task.shut_down()
    assert not window.canvas.shading_task.active
