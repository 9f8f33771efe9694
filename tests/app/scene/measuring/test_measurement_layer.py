"""Measurements are drawn in front of the mesh."""

import numpy as np
import pytest

from hexmend.quality import measure
from hexmend_app.picture.appearance import Look, Measurement
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.frame import Frame
from hexmend_app.scene.views.pane import Pane
from hexmend_app.scene.views.viewport import Viewport
from tests.core.grids import grid

MESH = grid(4)
FIGURES = measure(MESH.points, MESH.hexes)
POINTS = (4.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 3.0, 4.0)  # the second is hidden behind the mesh


@pytest.fixture
def drawn():
    """A function that draws points to measure and returns the pixels and the texts."""
    stage = Stage((240, 180))
    viewport = Viewport(Pane(stage.window))

    def draw(*points):
        viewport.draw(Frame(MESH, FIGURES, look=Look(measurement=Measurement(points))))
        viewport.view("iso")
        viewport.moving()
        return stage.picture().astype(int), viewport.overlay_layers.measurement.texts

    yield draw
    stage.close()


def changed(one, other):
    return int((np.abs(one - other).sum(axis=2) > 60).sum())


def test_lines_and_texts_are_drawn_and_removed(drawn):
    before, texts = drawn()
    assert texts == []
    one, texts = drawn(POINTS[0])
    assert texts == []
    assert changed(before, one) > 10
    two, texts = drawn(*POINTS[:2])
    assert texts == ["4"]
    assert changed(one, two) > 100
    three, texts = drawn(*POINTS)
    assert texts == ["4", "5", "90.0°"]
    assert changed(two, three) > 100
    after, texts = drawn()
    assert (changed(before, after), texts) == (0, [])
