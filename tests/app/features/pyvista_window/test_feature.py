"""Windows of PyVista that show the mesh as the view does."""

import sys

import numpy as np
import pytest
import pyvista as pv

from hexmend_app.features.pyvista_window.shown_mesh import show_in
from hexmend_app.picture.cut import Cut, CutStyle
from hexmend_app.scene.colour.colouring import OUTSIDE


def _cut(window, style, metric):
    """Cut the mesh by a horizontal plane through its middle, and colour it by a metric."""
    middle = np.reshape(window.canvas.viewport.bounds, (3, 2)).mean(axis=1)
    window.session.view.change(cut=Cut.at((0, 0, 1), middle, style), colours={"metric": metric})
    window.refresh()
    return middle[2]


def _drawn(plotter):
    """Return the data set that a plotter draws."""
    plotter.actors["mesh"].mapper.Update()
    return plotter.actors["mesh"].mapper.dataset


@pytest.mark.slow
def test_the_window_shows_the_colours_and_the_cut_and_its_plane_cuts_more(fresh_window, qtbot):
    feature, height = fresh_window.features["pyvista_window"], _cut(fresh_window, CutStyle.SMOOTH, "q")
    fresh_window.action("pyvista_window").trigger()
    (plotter,) = feature.plotters
    qtbot.waitUntil(lambda: plotter.app_window.windowHandle().isExposed())
    grid, quality = _drawn(plotter), fresh_window.session.document.now.quality
    assert np.isclose(grid.bounds[5], height)
    assert set(grid["vtkOriginalCellIds"]) == set(np.flatnonzero(fresh_window.canvas.viewport.remaining_after_cut()))
    assert (grid["q"] == quality.q[grid["vtkOriginalCellIds"]]).all()
    assert (np.isnan(grid["q(H)"]) == quality.inverted[grid["vtkOriginalCellIds"]]).all()
    assert list(plotter.scalar_bars.keys()) == ["q(H)"]
    assert np.allclose(plotter.camera.direction, fresh_window.canvas.viewport.camera.GetDirectionOfProjection())
    pixels = plotter.screenshot()
    assert np.count_nonzero(np.ptp(pixels.astype(int), axis=2) > 50) > 0.05 * pixels[..., 0].size  # is colourful
    (plane,) = plotter.widgets.plane_widgets
    plane.SetOrigin(grid.center)
    plane.InvokeEvent("EndInteractionEvent")
    (cut,) = plotter.widgets.plane_clipped_meshes
    assert cut.bounds[0] == pytest.approx(grid.center[0], abs=1e-6)
    plotter.app_window.close()
    assert feature.plotters == []


@pytest.mark.parametrize(("metric", "bar"), [("scaled-jacobian", "Scaled Jacobian"), ("material", "Material")])
def test_whole_hexes_are_shown_with_their_values(window, metric, bar):
    _cut(window, CutStyle.CRINKLE, metric)
    view = window.canvas.viewport
    plotter = pv.Plotter(off_screen=True)
    show_in(plotter, view, "z")
    grid = _drawn(plotter)
    kept = np.flatnonzero(view.kept())
    assert (np.sort(grid["vtkOriginalCellIds"]) == kept).all()
    assert list(plotter.scalar_bars.keys()) == [bar]
    plotter.close()


def test_neutral_colours_are_those_of_the_view(window):
    window.session.view.change(colours={"neutral": True})
    window.refresh()
    plotter = pv.Plotter(off_screen=True)
    show_in(plotter, window.canvas.viewport, "z")
    assert (plotter.actors["mesh"].mapper.lookup_table.values[:, :3] == OUTSIDE).all()
    plotter.close()


def test_a_message_says_that_pyvistaqt_is_missing(window, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyvistaqt", None)
    monkeypatch.delitem(sys.modules, show_in.__module__)
    window.action("pyvista_window").trigger()
    assert "pip install" in window.messages.text


def test_a_message_says_that_nothing_is_shown(window):
    window.session.view.change(cut=Cut.at((0, 0, 1), (0, 0, -1e6), CutStyle.SMOOTH))
    window.refresh()
    window.action("pyvista_window").trigger()
    assert "shows no hexes" in window.messages.text
