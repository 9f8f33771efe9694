"""Shading is computed in the background when nothing moves."""

import numpy as np
import pytest

from hexmend_app.picture.appearance import Look
from hexmend_app.picture.page import Page
from hexmend_app.picture.visibility import Show
from tests.patience import PATIENCE

pytestmark = pytest.mark.slow


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


def test_a_change_computes_the_shading_again(window, qtbot):
    mesh_layer = rested(window, qtbot)
    before = mesh_layer.light
    heard = []
    window.canvas.shading_task.finished.connect(lambda: heard.append(1))
    window.session.view.change(show={"hidden": frozenset(np.arange(40).tolist())})
    qtbot.waitUntil(lambda: bool(heard), timeout=PATIENCE)
    assert mesh_layer.light is not before


def test_nothing_is_computed_without_shading(window, qtbot):
    rested(window, qtbot)
    window.session.view.change(page={"shading": False}, show={"hidden": frozenset({3})})
    qtbot.waitUntil(lambda: window.canvas.viewport.frame.look == window.session.view.look, timeout=PATIENCE)
    window.canvas.panes.still()
    window.canvas.shading_task.start()
    assert not window.canvas.shading_task.active
    assert window.session.view.look == Look(page=Page(shading=False), show=Show(hidden=frozenset({3})))


def test_shutting_down_ends_the_computation(window):
    window.canvas.panes.still()
    window.canvas.shading_task.start()
    window.canvas.shading_task.shut_down()
    assert not window.canvas.shading_task.active
