"""Cuts that are drawn coarsely while they are dragged, and at rest as they are."""

import numpy as np
import pytest

from hexmend_app.picture.appearance import Look
from hexmend_app.picture.colours import Colours, Range
from hexmend_app.picture.cut import Cut, CutStyle
from hexmend_app.scene.views.frame import Frame
from tests.app.scene.showing import MESH, figures_of, show
from tests.core.grids import scrambled


@pytest.mark.parametrize("style", list(CutStyle))
@pytest.mark.parametrize("many", [0, 1000], ids=["squares", "faces"])
def test_a_cut_that_moves_is_drawn_coarsely_and_at_rest_as_it_is(seen, monkeypatch, style, many):
    monkeypatch.setattr("hexmend_app.scene.views.moving_cut.COARSE_CUT_HEXES", 1)
    monkeypatch.setattr("hexmend_app.scene.layers.mesh.MANY", many)
    viewport, pixels = seen
    looks = [Look(cut=Cut.at((0, 0.1, 1), (0, 0, z), style)) for z in (1.3, 2.4, 3.1)]
    expected = []
    for look in looks:
        show(viewport, look=look)
        viewport.still()
        expected.append(pixels())
    viewport.coarse_cuts = True
    show(viewport, look=looks[0])
    figures = viewport.frame.figures
    for look, picture in zip(looks[1:], expected[1:], strict=True):
        viewport.draw(Frame(MESH, figures, look=look))
        coarse = pixels()
        assert (coarse != picture).any()
        assert viewport.mesh_layer.section.shown
        assert (np.abs(coarse - picture).max(axis=2) < 60).mean() > 0.6
        viewport.still()
        np.testing.assert_array_equal(pixels(), picture)
    viewport.draw(Frame(MESH, figures, look=looks[1]))
    assert viewport.pick(100, 75) is not None
    viewport.draw(Frame(MESH, figures, look=looks[2]))
    show(viewport, MESH.with_points(MESH.points * 1.0), looks[1])
    viewport.still()
    np.testing.assert_array_equal(pixels(), expected[1])


def test_a_coarse_cut_of_a_tangled_mesh_survives_what_comes_between_it_and_the_fine_frame(seen, monkeypatch):
    monkeypatch.setattr("hexmend_app.scene.views.moving_cut.COARSE_CUT_HEXES", 1)
    monkeypatch.setattr("hexmend_app.scene.layers.mesh.MANY", 0)
    viewport, pixels = seen
    tangled, scale = scrambled(MESH, 1.5), Colours(range=Range.FITTED)
    looks = [Look(cut=Cut.at((0, 0, 1), (0, 0, z)), colours=scale) for z in (1.3, 2.4)]
    figures = figures_of(tangled)
    assert figures.n_inverted
    viewport.coarse_cuts = True
    for look in (*looks, looks[0]):
        viewport.draw(Frame(tangled, figures, look=look))
        viewport.moving()
    coarse = pixels()
    viewport.extend_range((-2.0, 2.0))  # of another view: drawn as it is
    assert (pixels() != coarse).any()
    viewport.extend_range(None)
    viewport.still()
    fine = pixels()
    show(viewport, MESH)
    show(viewport, tangled, looks[0])
    viewport.still()
    np.testing.assert_array_equal(pixels(), fine)
    viewport.draw(Frame(tangled, viewport.frame.figures, look=looks[1]))
    viewport.clear()
    viewport.still()
    pixels()
