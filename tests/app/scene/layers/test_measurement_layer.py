"""Measurements are drawn in front of the mesh."""

import numpy as np
import pytest

from hexmend_app.picture.appearance import Measurement
from tests.app.scene.showing import MESH, frame_of

POINTS = (4.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 3.0, 4.0)  # the second is hidden behind the mesh


@pytest.fixture
def drawn(off_screen):
    """A function that draws points to measure and returns the pixels and the texts."""
    viewport = off_screen(240, 180)

    def draw(*points):
        viewport.draw(frame_of(MESH, measurement=Measurement(points)))
        viewport.view("iso")
        viewport.moving()
        return viewport.pixels(), viewport.overlay_layers.measurement.texts

    return draw


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
