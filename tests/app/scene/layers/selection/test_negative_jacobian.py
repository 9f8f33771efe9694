"""Region of the selected hex in which det J is not positive."""

import numpy as np
import pytest

from hexmend.mesh.mesh import Mesh
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.visibility import Show
from tests.app.invalid_hexes import BENT, INSIDE, INVERTED, THREE, VALID
from tests.app.scene.showing import frame_of, show
from tests.core.grids import placed


@pytest.fixture
def viewport(off_screen):
    return off_screen(200, 150, axes=False)


@pytest.fixture
def selection(viewport):
    show(viewport, THREE)
    return viewport.overlay_layers.selection


def test_the_region_inside_a_hex_ends_where_the_determinant_is_zero(selection):
    selection.select(INSIDE, False, None)
    assert selection.negative.shown
    heights = np.asarray(selection.negative.region.points)[:, 2]
    assert (heights.min(), heights.max()) == pytest.approx((1 / 3, 2 / 3), abs=2e-3)
    across = np.isclose(heights[:, None], [1 / 3, 2 / 3], atol=2e-3)  # both ends are surfaces inside the hex
    assert across.any(axis=0).all()


def test_the_region_of_a_curved_hex_is_that_of_its_own_map(viewport):
    show(viewport, BENT)
    selection = viewport.overlay_layers.selection
    selection.select(0, False, None)
    x = np.asarray(selection.negative.region.points)[:, 0]
    assert selection.negative.shown
    assert (x.min(), x.max()) == pytest.approx((1.0, 121 / 120), abs=1e-3)  # the map turns back from 121/120 to 1


def test_only_a_single_invalid_hex_has_a_region(viewport, selection):
    for h, expected in ((INVERTED, True), (VALID, False), (INSIDE, True), (None, False)):
        selection.select(h, False, None)
        assert selection.negative.shown == expected
    show(viewport, look=Look(show=Show(marked=frozenset({INVERTED, INSIDE}))))
    assert not selection.negative.shown


def test_the_region_follows_the_nodes_and_goes_when_the_hex_is_valid(selection):
    selection.select(INSIDE, False, None)
    selection.draw(frame_of(THREE.with_points(2 * THREE.points)))
    assert np.asarray(selection.negative.region.points)[:, 2].max() == pytest.approx(4 / 3, abs=4e-3)
    moved = placed(THREE, THREE.hexes[INSIDE], THREE.points[THREE.hexes[VALID]] + [6.0, 0.0, 0.0])
    selection.draw(frame_of(moved))
    assert not selection.negative.shown


@pytest.mark.parametrize("h", [INVERTED, INSIDE])
def test_the_region_is_seen_in_pictures_of_the_marked_hex_through_what_is_in_front_of_it(viewport, h):
    wall = THREE.points[THREE.hexes[VALID]] * [20.0, 0.1, 5.0] + [3.0, -9.0, -2.0]
    mesh = Mesh(np.concatenate([THREE.points, wall]), np.arange(32, dtype=np.int32).reshape(4, 8))
    counts = []
    for marked in (frozenset(), frozenset({h})):
        show(viewport, mesh, Look(show=Show(outline=False, marked=marked)))
        viewport.view((0.0, -1.0, 0.0))
        red, green, blue = np.moveaxis(viewport.pixels(), -1, 0)
        counts.append(np.count_nonzero((red > 100) & (green < 60) & (blue > 50)))
    assert counts[1] > counts[0] + 20
