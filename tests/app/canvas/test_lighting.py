"""Shading is computed in the background when nothing moves."""

import numpy as np
import pytest

from hexmend_app.picture.appearance import Look
from tests.patience import PATIENCE

pytestmark = pytest.mark.slow


def rested(window, qtbot):
    """Wait until the view is shaded, and return its mesh layer."""
    window.canvas.rest()
    body = window.canvas.viewport.body
    qtbot.waitUntil(lambda: body.light is not None and not window.canvas.lighting.active, timeout=PATIENCE)
    return body


def test_a_view_at_rest_is_shaded(window, qtbot):
    body = rested(window, qtbot)
    assert body.needs_shading is None
    assert body.light.min() < 1


def test_a_change_computes_the_shading_again(window, qtbot):
    body = rested(window, qtbot)
    before = body.light
    heard = []
    window.canvas.lighting.lit.connect(lambda: heard.append(1))
    window.session.view.change(dug=frozenset(np.arange(40).tolist()))
    qtbot.waitUntil(lambda: bool(heard), timeout=PATIENCE)
    assert body.light is not before


def test_nothing_is_computed_without_shading(window, qtbot):
    rested(window, qtbot)
    window.session.view.change(shading=False, dug=frozenset({3}))
    qtbot.waitUntil(lambda: window.canvas.viewport.frame.look == window.session.view.look, timeout=PATIENCE)
    window.canvas.panes.still()
    window.canvas.lighting.start()
    assert not window.canvas.lighting.active
    assert window.session.view.look == Look(shading=False, dug=frozenset({3}))


def test_shutting_down_ends_the_computation(window):
    window.canvas.panes.still()
    window.canvas.lighting.start()
    window.canvas.lighting.shut_down()
    assert not window.canvas.lighting.active
