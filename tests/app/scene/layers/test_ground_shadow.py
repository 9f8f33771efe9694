"""The ground shadow: where it is, when it is seen, and in which pictures."""

from dataclasses import replace

import numpy as np
import pytest

from hexmend.quality import measure
from hexmend_app.picture import Camera, ColourBarStyle, Page, Scene, TextPlace
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.cut import Cut, CutStyle
from hexmend_app.scene.geometry.footprint import footprint
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import draw_page
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.frame import Frame
from hexmend_app.scene.views.panes import Panes
from tests.core.grids import grid

MESH = grid(4, 4, 2)
FIGURES = measure(MESH.points, MESH.hexes)
BARE = Look(structure=Look().structure.without("shadow"))
NO_CUT = Cut()


@pytest.fixture
def panes():
    with Stage((300, 240)) as stage:
        panes = Panes(stage.window)
        panes.draw(Frame(MESH, FIGURES))
        panes.first.axes.widget.EnabledOff()
        panes.pixels = lambda: stage.picture().astype(int)
        yield panes


def darkened(panes, cut=NO_CUT):
    """Return True for pixels that the shadow darkens in a fine frame, (height, width) bool."""
    pictures = []
    for look in (replace(Look(), cut=cut), replace(BARE, cut=cut)):
        panes.draw(Frame(MESH, FIGURES, look=look))
        panes.camera_controller.reset_depth()
        panes.still()
        pictures.append(panes.pixels())
    with_shadow, without = pictures
    assert (with_shadow <= without + 1).all()
    return (without - with_shadow).max(axis=2) > 3


def test_the_shadow_is_below_the_mesh(panes):
    rows = np.flatnonzero(darkened(panes).any(axis=1))
    assert len(rows) > 20
    assert rows.min() > 0.4 * 240  # rows count from above


@pytest.mark.parametrize("view", [(1.0, 0.5, -0.6), "-z"])
def test_there_is_no_shadow_for_a_camera_below_the_ground(panes, view):
    panes.camera_controller.look_along(view)
    assert not darkened(panes).any()


def test_there_is_no_shadow_upside_down(panes):
    panes.camera_controller.roll(180)
    assert not darkened(panes).any()


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_the_ground_is_perpendicular_to_the_vertical_axis(panes, axis):
    panes.camera_controller.set_up(axis)
    assert darkened(panes)[120:].sum() > 100


@pytest.mark.parametrize("style", CutStyle)
def test_the_shadow_is_that_of_the_hexes_that_a_cut_leaves(panes, style):
    whole = darkened(panes)
    cut = darkened(panes, Cut.at((1, 0, 0), (1.0, 2.0, 1.0), style))
    assert 0.2 * whole.sum() < cut.sum() < 0.7 * whole.sum()
    assert (darkened(panes) == whole).all()


def test_the_shadow_is_no_part_of_a_fitted_view(panes):
    places = panes.first.places
    panes.draw(Frame(MESH, FIGURES, look=BARE))
    np.testing.assert_array_equal(panes.first.places, places)


@pytest.mark.parametrize(
    ("background", "drawn"), [("white", False), ("#FFFFFF", False), ("transparent", False), ("#e0e0e0", True)]
)
def test_pictures_on_white_or_without_a_background_have_no_shadow(background, drawn):
    page = Page(pixels=(300, 240), background=background)
    images = []
    for look in (Look(), BARE):
        scene = Scene.of(look, camera=Camera(), page=page, bar=ColourBarStyle(TextPlace.NONE))
        images.append(np.asarray(draw_page(scene, [PageMesh.of(MESH)]).image()).astype(int))
    assert (np.abs(images[0] - images[1]).max() > 5) == drawn


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("n", [1, 3, 12])
def test_a_footprint_has_the_place_and_the_area_of_the_projection(axis, n):
    mesh = grid(n)
    mesh = mesh.with_points(mesh.points / n * [1.0, 2.0, 3.0] + 5)
    image, low, high = footprint(mesh.points, mesh.hexes, axis)
    across = [k for k in range(3) if k != axis]
    sides = np.array([1.0, 2.0, 3.0])[across]
    pixel = (high - low) / len(image)
    assert pixel[0] == pytest.approx(pixel[1])
    assert image.sum() * pixel.prod() == pytest.approx(sides.prod(), rel=0.12)
    assert image.min() >= 0
    assert image.max() <= 1 + 1e-9
    assert max(image[0].max(), image[-1].max(), image[:, 0].max(), image[:, -1].max()) < 0.02
    rows, columns = np.indices(image.shape)
    centre = [(index * image).sum() / image.sum() + 0.5 for index in (columns, rows)]
    np.testing.assert_allclose(low + pixel * centre, 5 + sides / 2, atol=0.05 * sides.max())


def test_fast_frames_show_the_shadow_until_nodes_move(panes):
    def in_fast_frame(mesh):
        pictures = []
        for look in (Look(), BARE):
            if look is not BARE:
                panes.draw(Frame(MESH, FIGURES, look=look))
                panes.still()
                panes.pixels()
            panes.draw(Frame(mesh, FIGURES, look=look))
            panes.moving()
            pictures.append(panes.pixels())
        return np.abs(pictures[0] - pictures[1]).max()

    assert in_fast_frame(MESH) > 3
    assert in_fast_frame(MESH.with_points(1.01 * MESH.points)) == 0


def test_hidden_hexes_cast_no_shadow(panes):
    everything = darkened(panes).sum()
    hidden = frozenset(range(MESH.n_hexes - 2))
    look = Look(show=Look().show.with_keys(hidden=hidden))
    panes.draw(Frame(MESH, FIGURES, look=look))
    panes.still()
    few = panes.pixels()
    panes.draw(Frame(MESH, FIGURES, look=look.with_keys(structure=BARE.structure)))
    assert 0 < ((panes.pixels() - few).max(axis=2) > 3).sum() < everything
