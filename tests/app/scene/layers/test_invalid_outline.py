"""Outlines of invalid hexes, and of the regions that they form."""

import numpy as np
import pytest

from hexmend_app.scene.colour.colouring import INVALID_INSIDE, INVERTED
from hexmend_app.scene.layers.invalid_outline import InvalidOutline, outlines
from hexmend_app.scene.layers.surface import Surface, quads
from hexmend_app.scene.render.graphics import prepare_off_screen
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.pane import Pane

WHITE = np.array([255, 255, 255])


def board(side, chosen, own_points=False, colour=INVERTED):
    """Return a board of unit squares in which those at the given (column, row) have a colour."""
    x, y = np.meshgrid(np.arange(side + 1.0), np.arange(side + 1.0))
    points = np.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()])
    low = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    faces = np.column_stack([low, low + 1, low + side + 2, low + side + 1])
    colours = np.full((len(faces), 3), 90, np.uint8)
    for column, row in chosen:
        colours[row * side + column] = colour
    if own_points:
        points, faces = points[faces.ravel()], np.arange(4 * len(faces)).reshape(-1, 4)
    return quads(points, faces, colours, np.arange(len(faces)).astype(np.int32))


@pytest.mark.parametrize("own_points", [False, True], ids=["shared points", "own points"])
def test_the_outline_of_a_region_consists_of_edges_of_a_single_polygon(own_points):
    chosen = [(1, 1), (2, 1), (1, 2), (2, 2)]
    poly = board(4, chosen, own_points)
    marked = np.isin(np.arange(16), [row * 4 + column for column, row in chosen])
    ends, once = outlines(poly, marked)
    assert (len(ends), once.sum()) == (12, 8)
    middles = poly.points[ends].mean(axis=1)
    assert (np.isin(middles[once], (1, 3)).any(axis=1)).all()  # on the square around the four
    assert not (np.isin(middles[~once], (1, 3)).any(axis=1)).any()


def white_inside(side, size, colour=INVERTED):
    """Count the white pixels in the middle third of a picture of a board of invalid hexes."""
    prepare_off_screen()
    with Stage((size, size)) as stage:
        pane = Pane(stage.window)
        poly = board(side, [(c, r) for c in range(side) for r in range(side)], colour=colour)
        outline = InvalidOutline(pane.renderer)
        outline.outline(poly)
        pane.camera.SetPosition(0, 0, 1)
        pane.renderer.ResetCamera()
        seen = stage.picture().astype(int)
    third = size // 3
    return int((np.abs(seen[third:-third, third:-third] - WHITE).sum(axis=2) < 30).sum())


def test_large_hexes_are_outlined_individually_and_small_ones_by_region():
    for colour in (INVERTED, INVALID_INSIDE):
        assert white_inside(8, 300, colour) > 200
    assert white_inside(80, 300) == 0


# Edges of polygons: lighter on dark colours, and faded out on small polygons.


def squares(side, colour, size=320, pen=1.0):
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
    bright, dark = squares(8, BRIGHT), squares(8, DARK)
    assert bright.min() < np.median(bright) - 30
    assert bright.max() < np.median(bright) + 5
    assert dark.max() > np.median(dark) + 20


@pytest.mark.parametrize("colour", [BRIGHT, DARK])
def test_edges_fade_out_on_small_polygons(colour):
    face = np.median(squares(4, colour))
    large, small, smallest = (np.abs(squares(side, colour) - face).mean() for side in (80, 160, 250))
    assert large > 10  # 4 pixels a square: lines
    assert small < 0.5 * large  # 2 pixels, of which half were lines
    assert smallest < 1  # 1.3 pixels: none
