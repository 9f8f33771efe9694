"""Display of the displacement in the window."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from hexmend_app.picture import Cut, CutStyle, Range
from hexmend_app.picture.appearance import Arrows, Since
from tests.app.driving import brought, named, pixels, smooth, type_text


@pytest.fixture
def panel(window, qtbot):
    return brought(window, qtbot, "movement")


@pytest.fixture
def record(window, qtbot):
    smooth(qtbot, window.session, "laplacian", 6)
    return window.session.run.record


def choose(box, value):
    """Select an entry as the user does."""
    box.setCurrentIndex(box.findData(value.value))
    box.activated.emit(box.currentIndex())
    box.window().refresh()


def arrows_text(panel):
    panel.window().refresh()
    return named(panel, QLabel, "Number of arrows").text()


def go(window, record, number):
    window.session.timeline.go(record, number)
    window.refresh()


@pytest.mark.slow
def test_colours_follow_the_iteration_and_the_reference_state(window, record, panel):
    viewport, timeline = window.canvas.viewport, window.session.timeline
    window.session.view.colour_by("q-change")
    window.refresh()
    assert window.session.view.look.colours.range is Range.FITTED
    assert viewport.colouring.title == "change of q(H) since the file was opened"
    np.testing.assert_array_equal(
        viewport.colours.values, window.session.document.now.quality.q - window.session.document.start.quality.q
    )
    go(window, record, 3)
    choose(panel.form.editors["since"], Since.ITERATION)
    then = window.session.history.state(type(timeline.shown_iteration)(record, 2), window.session.document.now.mesh)
    np.testing.assert_allclose(viewport.colours.values, window.session.document.now.quality.q - then.quality.q)
    assert window.canvas.colour_bar.accessibleDescription().endswith(viewport.colouring.label(viewport.colouring.high))
    timeline.step(1)
    window.refresh()
    assert viewport.colouring.title == f"change of q(H) since {record.name} 3"
    go(window, record, 0)
    assert not viewport.colours.values.any()
    window.session.view.colour_by("q")
    window.refresh()
    assert window.session.view.look.colours.metric == "q"
    assert window.session.view.look.colours.range is Range.FULL


@pytest.mark.slow
def test_arrows_are_drawn_counted_and_scaled(window, record, panel):
    free = window.session.document.now.summary.free_nodes
    choose(panel.form.editors["arrows"], Arrows.ALL)
    layer = window.canvas.viewport.overlay_layers.arrows
    assert (layer.drawn, layer.moved) == (free, free)
    assert arrows_text(panel) == f"{free:,} arrows, true length."
    choose(panel.form.editors["arrows"], Arrows.SIGHT)
    assert arrows_text(panel) == "No visible node has moved."
    window.session.view.set_handles(False)
    for style in CutStyle:
        middle = tuple(window.session.document.now.mesh.points.mean(axis=0))
        window.session.view.set_cut(Cut.at((1, 0, 0), middle, style))
        window.refresh()
        assert 0 < layer.drawn < free
    before = pixels(window)
    type_text(panel.form.editors["factor"].lineEdit(), "4")
    QTest.keyClick(panel.form.editors["factor"], Qt.Key.Key_Return)
    assert window.session.view.look.movement.factor == 4
    window.refresh()
    assert arrows_text(panel).endswith("4 × true length.")
    assert (pixels(window) != before).any()
    go(window, record, 0)
    assert arrows_text(panel) == "No visible node has moved."
