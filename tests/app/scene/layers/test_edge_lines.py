"""Edges of polygons: lighter on dark colours, and faded out on small polygons."""

import numpy as np
import pytest

from hexmend_app.scene.layers.surface import Surface, quads
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.pane import Pane


def board(side, colour, size=320, pen=1.0):
    """Return the brightness of the inner pixels of a picture filled by a board of side × side squares."""
    x, y = np.meshgrid(np.arange(side + 1.0), np.arange(side + 1.0))
    points = np.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()]) / side
    low = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    faces = np.column_stack([low, low + 1, low + side + 2, low + side + 1])
    colours = np.tile(np.array(colour, np.uint8), (len(faces), 1))
    with Stage((size, size)) as stage:
        pane = Pane(stage.window)
        surface = Surface(pane.renderer, pen)
        surface.replace(quads(points, faces, colours, np.arange(len(faces)).astype(np.int32)))
        pane.camera.SetPosition(0, 0, 1)
        pane.renderer.ResetCamera()
        pane.camera.SetParallelProjection(True)
        pane.camera.SetParallelScale(0.5)
        seen = stage.picture().astype(float).mean(axis=2)
    return seen[20:-20, 20:-20]


BRIGHT, DARK = (250, 230, 40), (68, 1, 84)


def test_edges_are_dark_on_bright_colours_and_light_on_dark_ones():
    bright, dark = board(8, BRIGHT), board(8, DARK)
    assert bright.min() < np.median(bright) - 30
    assert bright.max() < np.median(bright) + 5
    assert dark.max() > np.median(dark) + 20


@pytest.mark.parametrize("colour", [BRIGHT, DARK])
def test_edges_fade_out_on_small_polygons(colour):
    face = np.median(board(4, colour))
    large, small, smallest = (np.abs(board(side, colour) - face).mean() for side in (80, 160, 250))
    assert large > 10  # 4 pixels a square: lines
    assert small < 0.5 * large  # 2 pixels, of which half were lines
    assert smallest < 1  # 1.3 pixels: none
