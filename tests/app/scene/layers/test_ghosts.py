"""Hexes around isolated hexes are drawn as ghosts, which do not hide them."""

from types import SimpleNamespace

import numpy as np
import pytest
from vtkmodules.vtkRenderingCore import vtkRenderer

from hexmend_app.picture import Cut, Isolate, Show
from hexmend_app.picture.camera import CameraPose
from hexmend_app.picture.colour_map import COLOUR_MAPS
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.camera.vtk_pose import apply_pose
from hexmend_app.scene.colour.colouring import INVALID_INSIDE, INVERTED
from hexmend_app.scene.geometry.coloured_polygons import quads
from hexmend_app.scene.layers.invalid_outline import InvalidOutline, outlines
from hexmend_app.scene.layers.overlay_layers import Ghosts
from hexmend_app.scene.layers.surface import Surface
from hexmend_app.scene.render.graphics import prepare_off_screen
from hexmend_app.scene.render.stage import Stage
from tests.app.scene.showing import frame_of
from tests.core.grids import grid

MESH = grid(5)
MIDDLE = 62


def frame(**look):
    return frame_of(MESH, **look)


@pytest.fixture
def viewport(off_screen):
    return off_screen(240, 180)


@pytest.mark.parametrize("rings", [0, 1, 2])
def test_rings_around_isolated_hexes_are_ghosts(viewport, rings):
    viewport.draw(frame(show=Show(isolate=Isolate((MIDDLE,), rings))))
    assert viewport.shown == 1
    assert set(viewport.mesh_layer.faces.hexes) == {MIDDLE}
    ghosts = viewport.filters.ghosts(viewport.frame)
    if not rings:
        assert ghosts is None
    else:
        assert ghosts.sum() == (2 * rings + 1) ** 3 - 1
        np.testing.assert_allclose(np.ptp(viewport.places, axis=0), 2 * rings + 1)


def test_hexes_dug_out_or_cut_away_are_no_ghosts(viewport):
    viewport.draw(
        frame(show=Show(isolate=Isolate((MIDDLE,), 1), hidden=frozenset({61})), cut=Cut.at((0, 0, 1), (0, 0, 3)))
    )
    ghosts = viewport.filters.ghosts(viewport.frame)
    assert ghosts.sum() == 18 - 2
    assert not ghosts[61]


def test_an_isolated_hex_is_visible_through_its_ghosts(viewport):
    viewport.draw(frame(show=Show(isolate=Isolate((MIDDLE,), 1), outline=False)))
    apply_pose(viewport.camera, CameraPose((7, -5, 7), (2.5, 2.5, 2.5), (0, 0, 1), False, 1.0, "z"))
    viewport.layers[0].ResetCameraClippingRange()
    ghostly = viewport.pixels()
    middle = ghostly[80:100, 110:130].reshape(-1, 3).mean(axis=0)
    assert middle[0] - middle[2] > 60  # yellow still: q is 1
    ground = ghostly[2, 2]
    pale = np.abs(ghostly - ground).sum(axis=2)
    assert ((pale > 15) & (pale < 150)).mean() > 0.1  # the ghosts around it


def test_ghosts_follow_the_nodes():
    ghosts, keep = Ghosts(SimpleNamespace(renderer=vtkRenderer())), np.zeros(MESH.n_hexes, bool)
    keep[MIDDLE] = True
    around = MESH.topology.hexes_around([MIDDLE], 1) & ~keep
    ghosts.draw(frame(), around, keep)
    assert ghosts.shown
    before = ghosts.places.copy()
    ghosts.draw(frame_of(MESH.with_points(MESH.points + 1)), around, keep)
    np.testing.assert_allclose(ghosts.places, before + 1)
    ghosts.draw(frame(), None, keep)
    assert not ghosts.shown
    assert ghosts.places.shape == (0, 3)


# Outlines of invalid hexes, and of the regions that they form.


WHITE = np.array([255, 255, 255])


def board(side, colours, own_points=False):
    """Return a board of unit squares with the given colours, row by row."""
    x, y = np.meshgrid(np.arange(side + 1.0), np.arange(side + 1.0))
    points = np.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()])
    low = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    faces = np.column_stack([low, low + 1, low + side + 2, low + side + 1])
    if own_points:
        points, faces = points[faces.ravel()], np.arange(4 * len(faces)).reshape(-1, 4)
    return quads(points, faces, colours, np.arange(len(faces)).astype(np.int32))


def in_one_colour(side, colour):
    return np.tile(np.array(colour, np.uint8), (side * side, 1))


@pytest.mark.parametrize("own_points", [False, True], ids=["shared points", "own points"])
def test_the_outline_of_a_region_consists_of_edges_of_a_single_polygon(own_points):
    chosen = [(1, 1), (2, 1), (1, 2), (2, 2)]
    marked = np.isin(np.arange(16), [row * 4 + column for column, row in chosen])
    colours = np.where(marked[:, None], in_one_colour(4, INVERTED), in_one_colour(4, (90, 90, 90)))
    poly = board(4, colours, own_points)
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
        outline = InvalidOutline(pane.renderer)
        outline.outline(board(side, in_one_colour(side, colour)))
        pane.camera.SetPosition(0, 0, 1)
        pane.renderer.ResetCamera()
        seen = stage.picture().astype(int)
    third = size // 3
    return int((np.abs(seen[third:-third, third:-third] - WHITE).sum(axis=2) < 30).sum())


def test_large_hexes_are_outlined_individually_and_small_ones_by_region():
    for colour in (INVERTED, INVALID_INSIDE):
        assert white_inside(8, 300, colour) > 200
    assert white_inside(80, 300) == 0


# Edges of polygons: darker than the colour, and faded out on small polygons.


def squares(side, colour, size=320, pen=1.0):
    """Return the brightness of the inner pixels of a picture filled by a board of side × side squares."""
    with Stage((size, size)) as stage:
        pane = Pane(stage.window)
        surface = Surface(pane.renderer, pen)
        surface.replace(board(side, in_one_colour(side, colour)))
        pane.camera.SetPosition(0, 0, 1)
        pane.renderer.ResetCamera()
        pane.camera.SetParallelProjection(True)
        pane.camera.SetParallelScale(0.5 * side)
        seen = stage.picture().astype(float).mean(axis=2)
    return seen[20:-20, 20:-20]


BRIGHT, DARK = (250, 230, 40), (68, 1, 84)


@pytest.mark.parametrize("name", ["viridis", "cividis", "plasma"])
def test_edges_are_darker_than_every_colour_of_a_map(name):
    for colour in COLOUR_MAPS[name].table[::15]:
        seen = squares(8, colour, size=160)
        assert seen.min() < 0.85 * np.median(seen)
        assert seen.max() < np.median(seen) + 5


@pytest.mark.parametrize("colour", [BRIGHT, DARK])
def test_edges_fade_out_on_small_polygons(colour):
    face = np.median(squares(4, colour))
    large, small, smallest = (np.abs(squares(side, colour) - face).mean() for side in (80, 160, 250))
    assert large > 10  # 4 pixels a square: lines
    assert small < 0.5 * large  # 2 pixels, of which half were lines
    assert smallest < 1  # 1.3 pixels: none
