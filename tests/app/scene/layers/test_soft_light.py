"""Light of surfaces: colours in the picture can be compared with those of the legend."""

import numpy as np
import pytest

from hexmend_app.picture.appearance import Look
from hexmend_app.picture.colours import Colours
from hexmend_app.picture.page import LineStyle, Page
from hexmend_app.picture.visibility import Show
from tests.app.scene.showing import show
from tests.core.grids import grid

MESH = grid(3)  # of cubes, with the last colour of the map


def faces(viewport, direction, colour_map="viridis", edges=0.0, fine=True):
    """Return the colours of the faces that are seen, (k, 3), and the colour of the legend, (3,)."""
    look = Look(
        lines=LineStyle(edges=edges),
        show=Show(outline=False),
        page=Page(shading=False),
        colours=Colours(map=colour_map),
    )
    show(viewport, MESH, look)
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
