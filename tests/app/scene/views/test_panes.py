"""Several views in an off-screen window, checked by pixels."""

import numpy as np
import pytest

from hexmend.quality import measure
from hexmend_app.picture.appearance import Arrows, Look, Traces
from hexmend_app.picture.colours import Colours, Range
from hexmend_app.picture.displacement import Displacement, ReferenceState
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.arrangement import columns, grid
from hexmend_app.scene.views.panes import Panes
from hexmend_app.state.view.side_views import Wipe
from tests.core.grids import grid as hexes
from tests.core.grids import scrambled

MESH = hexes(4)
OTHERS = [scrambled(MESH, amount) for amount in (0.2, 0.4, 0.7)]
SIZE = (240, 160)


def shown(mesh):
    return mesh, measure(mesh.points, mesh.hexes)


def look_at(panes, look, movement=None):
    """Draw the same mesh with another look."""
    panes.draw(Frame(panes.first.frame.mesh, panes.first.frame.quality, movement, look))


@pytest.fixture
def stage():
    with Stage(SIZE) as stage:
        yield stage


@pytest.fixture
def panes(stage):
    panes = Panes(stage.window)
    panes.draw(Frame(*shown(MESH)))
    return panes


@pytest.fixture
def pixels(stage, panes):
    """A function that draws a fine frame and returns it."""

    def drawn():
        panes.still()
        return stage.picture().astype(int)

    return drawn


@pytest.mark.parametrize("views", [1, 2, 3, 4])
def test_views_side_by_side_fill_the_window_and_do_not_overlap(views):
    places = grid(views)
    assert len(places) == views
    assert sum((right - left) * (high - low) for left, low, right, high in places) == pytest.approx(1)
    assert len({high for *_, high in places}) == views // columns(views)
    assert places[0][0] == 0
    assert places[0][3] == 1  # reading order: from the upper left


def test_each_view_shows_its_mesh_as_it_would_alone(panes, pixels):
    panes.show([shown(OTHERS[2])])
    panes.first.axes.widget.EnabledOff()
    both = pixels()
    left, right = both[:, :119], both[:, 121:239]
    assert np.abs(left[:, :118] - right).max() > 100
    panes.show([shown(MESH)])
    both = pixels()
    assert np.abs(both[:, 5:115] - both[:, 125:235]).max() < 16  # the same mesh, so the same picture, but for rounding


@pytest.mark.parametrize("parallel", [False, True])
@pytest.mark.parametrize("at", [0.25, 0.5, 0.8])
def test_both_halves_of_a_wipe_are_parts_of_one_picture(panes, at, parallel, pixels):
    panes.camera_controller.set_parallel(parallel)
    panes.camera_controller.fit()
    panes.first.axes.widget.EnabledOff()
    whole = pixels()
    panes.show([shown(MESH)], Wipe(0, 1, at))
    wiped = pixels()
    edge = round(at * 240)
    far = np.abs(np.arange(240) - edge) > 2  # lines end at the edge
    assert (np.abs(wiped - whole).max(axis=2)[:, far] > 60).mean() < 0.002
    panes.show([], None)
    assert np.abs(pixels() - whole).max() <= 1


def test_a_wipe_shows_one_mesh_on_either_side(panes, pixels):
    panes.first.axes.widget.EnabledOff()
    whole = pixels()
    panes.show([shown(mesh) for mesh in OTHERS], Wipe(0, 3, 0.5))
    wiped = pixels()
    different = np.abs(wiped - whole).max(axis=2) > 60
    assert different[:, :118].mean() < 0.002
    assert different[:, 122:].mean() > 0.05
    panes.show([shown(mesh) for mesh in OTHERS], Wipe(3, 0, 0.5))
    swapped = np.abs(pixels() - whole).max(axis=2) > 60
    assert swapped[:, :118].mean() > 0.05
    assert swapped[:, 122:].mean() < 0.002


def test_a_fitted_range_of_colours_spans_all_views_and_shrinks_again(panes):
    scale = Colours(range=Range.FITTED)
    look_at(panes, Look(colours=scale))
    alone = panes.first.colouring.low, panes.first.colouring.high
    panes.show([shown(mesh) for mesh in OTHERS[:2]])
    ranges = {(view.colouring.low, view.colouring.high) for view in panes.all}
    assert len(ranges) == 1
    (low, high), q = ranges.pop(), [shown(mesh)[1] for mesh in OTHERS[:2]]
    assert low == pytest.approx(min(one.q[~one.inverted].min() for one in q))
    assert high >= 1 - 1e-6
    look_at(panes, Look(colours=Colours(range=(0.2, 0.3))))
    assert {(view.colouring.low, view.colouring.high) for view in panes.all} == {(0.2, 0.3)}
    look_at(panes, Look(colours=scale))
    panes.show([])
    assert (panes.first.colouring.low, panes.first.colouring.high) == alone


def test_picking_uses_the_view_under_the_pointer(panes, pixels):
    other = MESH.with_points(1.02 * MESH.points)
    panes.show([shown(other)])
    pixels()
    assert panes.at(60, 80) is panes.first
    assert panes.at(180, 80) is panes.all[1]
    left, right = panes.pick(60, 80), panes.pick(180, 80)
    assert left.hex == right.hex
    for hit, mesh in ((left, MESH), (right, other)):
        np.testing.assert_array_equal(hit.node_place, mesh.points[hit.node])
    assert not np.array_equal(left.node_place, right.node_place)
    panes.show([shown(MESH)], Wipe(0, 1, 0.5))
    pixels()
    wiped = [found(panes, x) for x in (100, 140)]
    panes.show([])
    pixels()
    assert wiped == [found(panes, x) for x in (100, 140)]


def found(panes, x):
    hit = panes.pick(x, 80)
    return hit.hex, hit.node


def test_a_closed_view_leaves_nothing_behind(panes, pixels, stage):
    panes.first.axes.widget.EnabledOff()
    before, renderers = pixels(), stage.window.GetRenderers().GetNumberOfItems()
    for _ in range(3):
        panes.show([shown(mesh) for mesh in OTHERS])
        pixels()
        panes.show([])
    assert stage.window.GetRenderers().GetNumberOfItems() == renderers
    np.testing.assert_array_equal(pixels(), before)


def test_all_views_have_the_same_reference_state(panes):
    first, second = (measure(one.points, MESH.hexes) for one in (MESH, OTHERS[0]))
    look = Look(movement=Traces(arrows=Arrows.ALL), colours=Colours(metric="moved-most", range=Range.FITTED))
    look_at(panes, look, Displacement(MESH, ReferenceState(MESH.points, first, "then"), MESH.points, first))
    panes.show([(OTHERS[2], measure(OTHERS[2].points, MESH.hexes))])
    other = panes.all[1]
    far = np.linalg.norm(OTHERS[2].points - MESH.points, axis=1).max() / MESH.mean_edge_length
    assert panes.first.overlay_layers.arrows.drawn == panes.first.overlay_layers.arrows.moved == 0
    assert other.overlay_layers.arrows.drawn == MESH.free.sum()
    assert other.colouring.high == panes.first.colouring.high == pytest.approx(far)
    look_at(panes, look, Displacement(MESH, ReferenceState(OTHERS[0].points, second, "later"), MESH.points, first))
    assert other.colouring.title.endswith("since later")
    np.testing.assert_array_equal(other.frame.movement.before.points, OTHERS[0].points)
