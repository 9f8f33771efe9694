"""Arrows of nodes that have moved."""

import dataclasses

import numpy as np
import pytest

from hexmend.quality import measure
from hexmend_app.picture import Colours, Cut, LineStyle, Page, Range, Show
from hexmend_app.picture.appearance import Arrows, Look, Traces
from hexmend_app.picture.displacement import Displacement, ReferenceState
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.layers import arrows as layer
from tests.app.scene.showing import show
from tests.core.grids import grid, scrambled

MESH = grid(6)
THEN = ReferenceState(MESH.points, measure(MESH.points, MESH.hexes), "then")
NOW = scrambled(MESH, 0.5).points
FIGURES = measure(NOW, MESH.hexes)
CUT = Cut.at((1, 0, 0), (3.3, 3.0, 3.0))


@pytest.fixture
def viewport(off_screen):
    viewport = off_screen(300, 300)
    viewport.draw(Frame(MESH, THEN.quality))
    viewport.view("iso")
    return viewport


def move(viewport, points=NOW, figures=FIGURES):
    moved = MESH.with_points(points.copy())
    viewport.draw(Frame(moved, figures, Displacement(MESH, THEN, points, figures), viewport.frame.look))


def look_at(viewport, look):
    viewport.draw(dataclasses.replace(viewport.frame, look=look))


def test_an_arrow_ends_at_the_end_of_its_path_and_the_length_of_its_head_is_limited():
    rng = np.random.default_rng(2)
    start, path = rng.normal(size=(2, 50, 3))
    path[0], path[1] = (0, 0, 2), (1e-7, 0, 0)
    shafts, heads = layer.arrows(start, path, 0.25)
    ends = np.asarray(shafts.points, dtype=float).reshape(-1, 2, 3)
    np.testing.assert_allclose(ends[:, 0], start, atol=1e-6)
    tips = np.asarray(heads.points, dtype=float).reshape(50, -1, 3)
    assert np.linalg.norm(tips - (start + path)[:, None], axis=2).min(axis=1).max() < 1e-6
    head, length = np.linalg.norm(start + path - ends[:, 1], axis=1), np.linalg.norm(path, axis=1)
    assert (head <= np.minimum(0.25, length) + 1e-6).all()


def test_arrows_are_drawn_move_with_the_nodes_and_are_removed(viewport):
    drawn = viewport.pixels
    without = drawn()
    look_at(viewport, Look(cut=CUT, movement=Traces(arrows=Arrows.SIGHT, factor=1)))
    plain = drawn()
    move(viewport)
    one = drawn()
    look_at(viewport, Look(cut=CUT, movement=Traces(arrows=Arrows.SIGHT, factor=3)))
    assert (drawn() != one).any()
    look_at(viewport, Look())
    move(viewport, MESH.points, THEN.quality)
    np.testing.assert_array_equal(drawn(), without)
    assert (one != plain).any()


def test_colours_of_a_change_distinguish_newly_invalid_and_mended_hexes(viewport):
    look_at(viewport, Look(colours=Colours(metric="q-change", range=Range.FITTED)))
    bad = scrambled(MESH, 1.2).points
    figures = measure(bad, MESH.hexes)
    move(viewport, bad, figures)
    assert [(name, count) for name, count, _ in viewport.colours.special_counts] == [
        ("newly invalid", np.count_nonzero(figures.invalid)),
        ("still invalid", 0),
        ("mended", 0),
    ]
    colouring = viewport.colouring
    assert colouring.low == -colouring.high < 0
    assert colouring.title == "change of q(H) since then"
    assert not np.array_equal(colouring.table[0], colouring.table[-1])
    assert colouring.table[127:129].min() > 230  # nothing has changed in the middle


# Light of surfaces: colours in the picture can be compared with those of the legend.


CUBES = grid(3)  # of cubes, with the last colour of the map


def faces(viewport, direction, colour_map="viridis", edges=0.0, fine=True):
    """Return the colours of the faces that are seen, (k, 3), and the colour of the legend, (3,)."""
    look = Look(
        lines=LineStyle(edges=edges),
        show=Show(outline=False),
        page=Page(shading=False),
        colours=Colours(map=colour_map),
    )
    show(viewport, CUBES, look)
    viewport.view(direction)
    (viewport.still if fine else viewport.moving)()
    pixels = viewport.pixels().reshape(-1, 3)
    colours, counts = np.unique(pixels, axis=0, return_counts=True)
    drawn = (counts > 200) & (colours != pixels[0]).any(axis=1)
    return colours[drawn].astype(float), viewport.colouring.table[-1].astype(float)


@pytest.mark.parametrize(
    ("direction", "edges", "fine"), [("+x", None, True), ("-y", 0.0, True), ("+z", None, False), ("+x", 0.0, False)]
)
def test_a_face_towards_the_viewer_has_the_colour_of_the_legend(off_screen, direction, edges, fine):
    colours, legend = faces(off_screen(200, 200, axes=False), direction, edges=edges, fine=fine)
    assert np.abs(colours - legend).max(axis=1).min() <= 2


@pytest.mark.parametrize(
    ("direction", "colour_map"), [("iso", "viridis"), ((1.0, 0.3, 0.1), "plasma"), ((-1.0, -0.2, -0.9), "viridis")]
)
def test_shades_keep_the_hue_and_most_of_the_brightness(off_screen, direction, colour_map):
    colours, legend = faces(off_screen(200, 200, axes=False), direction, colour_map)
    shades = colours / legend
    assert len(colours) >= 2
    assert shades.min() > 0.7
    assert shades.max() < 1.06
    assert np.ptp(shades, axis=1).max() < 0.04  # of red, green and blue of a face: rounding, and no clipping
    assert np.ptp(shades.mean(axis=1)) > 0.05  # faces can be distinguished
