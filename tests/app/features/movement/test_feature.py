"""Display of the displacement in the window."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from hexmend import gallery, io
from hexmend.run import StoppingCriteria
from hexmend.smoothers import METHODS
from hexmend_app.picture.appearance import Since
from hexmend_app.picture.colours import Range
from hexmend_app.picture.cut import Cut
from tests.app.driving import open_and_wait, pixels
from tests.app.driving import press as press_button
from tests.patience import PATIENCE


@pytest.fixture
def panel(window, qtbot):
    window.show_panel("movement")
    qtbot.waitUntil(window.features["movement"].panel.isVisible, timeout=PATIENCE)
    return window.features["movement"].panel


@pytest.fixture
def record(window, qtbot):
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE):
        window.session.run.start(METHODS["laplacian"](), StoppingCriteria(max_iterations=6, tolerance=0))
    return window.session.run.record


def press(segmented, key):
    press_button(segmented.button(key))


def text_of(panel, name):
    """Return the text of the label with this name."""
    panel.window().refresh()
    return next(label.text() for label in panel.findChildren(QLabel) if label.accessibleName() == name)


def go(window, record, number):
    window.session.timeline.go(record, number)
    window.refresh()


def test_colours_follow_the_iteration_and_the_reference_state(window, record, panel):
    viewport, timeline = window.canvas.viewport, window.session.timeline
    press(panel.colours, "q-change")
    assert window.session.view.look.colours.range is Range.FITTED
    assert viewport.colouring.title == "change of q(H) since the file was opened"
    np.testing.assert_array_equal(
        viewport.colours.values, window.session.document.now.figures.q - window.session.document.start.figures.q
    )
    go(window, record, 3)
    press(panel.since, "iteration")
    then = window.session.history.state(type(timeline.shown_iteration)(record, 2), window.session.document.now.mesh)
    np.testing.assert_allclose(viewport.colours.values, window.session.document.now.figures.q - then.figures.q)
    assert window.canvas.colour_bar.accessibleDescription().endswith(viewport.colouring.label(viewport.colouring.high))
    timeline.step(1)
    window.refresh()
    assert viewport.colouring.title == f"change of q(H) since {record.name} 3"
    go(window, record, 0)
    assert not viewport.colours.values.any()
    press(panel.colours, "")
    assert window.session.view.look.colours.metric == "q"
    assert window.session.view.look.colours.range is Range.FULL


@pytest.mark.slow
def test_arrows_are_drawn_counted_and_scaled(window, record, panel):
    free = window.session.document.now.summary.free_nodes
    press(panel.arrows, "all")
    layer = window.canvas.viewport.overlay_layers.arrows
    assert (layer.drawn, layer.moved) == (free, free)
    assert text_of(panel, "Number of arrows") == f"{free:,} arrows, true length."
    press(panel.arrows, "sight")
    assert text_of(panel, "Number of arrows") == "No visible node has moved."
    window.session.view.set_cut(Cut.at((1, 0, 0), tuple(window.session.document.now.mesh.points.mean(axis=0))))
    window.session.view.set_handles(False)
    window.refresh()
    before = pixels(window)
    assert 0 < layer.drawn < free
    panel.factor.lineEdit().selectAll()
    QTest.keyClicks(panel.factor.lineEdit(), "4")
    QTest.keyClick(panel.factor, Qt.Key.Key_Return)
    assert window.session.view.look.movement.factor == 4
    window.refresh()
    assert text_of(panel, "Number of arrows").endswith("4 × true length.")
    assert (pixels(window) != before).any()
    go(window, record, 0)
    assert text_of(panel, "Number of arrows") == "No visible node has moved."


@pytest.fixture
def mesh_to_invert(window, qtbot, tmp_path):
    """Open a mesh in which Laplacian smoothing inverts valid hexes."""
    io.write(tmp_path / "inverts.vtu", gallery.make("bridge-sharp", size=4000, scramble=0.4, seed=2))
    open_and_wait(qtbot, window, tmp_path / "inverts.vtu")


@pytest.mark.slow
def test_newly_invalid_hexes_are_isolated(window, mesh_to_invert, record, panel, qtbot):
    inverted = [record.rows[k]["inverted"] for k in range(len(record.rows))]
    for number in range(1, len(inverted)):
        go(window, record, number)
        press(panel.since, "iteration")
        movement = window.session.comparison_bases.displacement(Since.ITERATION)
        assert panel.show_newly.isEnabled() == (movement.counts.newly_invalid > 0)
        if panel.show_newly.isEnabled():
            break
    else:
        pytest.fail("Laplacian smoothing of this mesh inverts no hex in any iteration")
    press_button(panel.show_newly)
    isolated = window.session.view.look.show.isolate.hexes
    assert window.session.document.now.figures.invalid[list(isolated)].all()
    assert len(isolated) == movement.counts.newly_invalid
