"""Original surface: visible where the boundary of the mesh has moved, and nowhere else."""

import numpy as np
import pytest

from hexmend.quality import measure
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.picture.cut import Cut
from hexmend_app.picture.visibility import Show
from hexmend_app.scene.views.frame import Frame
from tests.app.scene.showing import MESH

ON, OFF = Look(structure=Structure.of("original")), Look()


def frame(points, look=ON):
    mesh = MESH.with_points(points)
    return Frame(mesh, measure(points, MESH.hexes), look=look, original=MESH.points)


@pytest.fixture
def drawn(off_screen):
    """A function that draws a frame and returns its pixels; its attribute `surface` is the layer."""
    viewport = off_screen(240, 180)
    viewport.draw(frame(MESH.points))
    viewport.view("iso")

    def draw(one):
        viewport.draw(one)
        viewport.moving()
        return viewport.pixels()

    draw.surface = viewport.overlay_layers.optional["original"]
    return draw


def differ(one, other):
    return int((np.abs(one - other).sum(axis=2) > 20).sum())


def test_it_is_hidden_where_the_boundary_is_unchanged(drawn):
    assert differ(drawn(frame(MESH.points, OFF)), drawn(frame(MESH.points))) < 40  # a rim


def test_it_is_visible_around_a_shrunk_mesh(drawn):
    centre = MESH.points.mean(axis=0)
    shrunk = centre + 0.7 * (MESH.points - centre)
    without, seen = drawn(frame(shrunk, OFF)), drawn(frame(shrunk))
    assert differ(without, seen) > 2000
    assert drawn.surface.shown
    np.testing.assert_array_equal(np.ptp(drawn.surface.places, axis=0), 4)


def test_faces_of_hidden_hexes_are_not_drawn(drawn):
    half = Look(cut=Cut.at((0, 0, 1), (2, 2, 1.9)), structure=Structure.of("original"))
    drawn(frame(MESH.points))
    assert len(drawn.surface.places) == MESH.topology.boundary.sum()
    drawn(frame(MESH.points, half))
    assert 0 < np.ptp(drawn.surface.places, axis=0)[2] < 3
    drawn(frame(MESH.points, Look(structure=Structure.of("original"), show=Show(peel=1))))
    assert not drawn.surface.shown
    drawn(frame(MESH.points))
    assert drawn.surface.shown
