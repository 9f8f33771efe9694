"""Shading is computed in the background when nothing moves."""

import pytest


def rested(window, qtbot):
    """Wait until the view is shaded, and return its mesh layer."""
    window.canvas.rest()
    mesh_layer = window.canvas.viewport.mesh_layer
    qtbot.waitUntil(lambda: mesh_layer.light is not None and not window.canvas.shading_task.busy)
    return mesh_layer


@pytest.mark.slow
def test_a_view_at_rest_is_shaded(window, qtbot):
    mesh_layer = rested(window, qtbot)
    assert mesh_layer.needs_shading is None
    assert mesh_layer.light.min() < 1


@pytest.mark.slow
def test_shutting_down_ends_the_computation(window):
    window.canvas.panes.still()
    window.canvas.shading_task.start()
    window.canvas.shading_task.close()
    assert not window.canvas.shading_task.busy
