"""Histogram in the window: metric of the colours, brushed ranges and snapshots."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox

from hexmend.quality import METRICS
from tests.app.driving import (
    LEFT,
    brought,
    drag,
    key,
    named,
    open_and_wait,
    press,
    smooth,
    walk_to,
)
from tests.app.features.histogram.mouse import point_at


@pytest.fixture
def histogram(window, qtbot):
    """Return the panel, in its default size."""
    return brought(window, qtbot, "histogram")


def brush(window, qtbot, low, high):
    """Drag over the histogram, wait until the view has its range, and return the range."""
    histogram, view = window.features["histogram"].panel, window.session.view
    before = view.look.show.by_quality
    QApplication.processEvents()  # lays out the axis of another metric
    drag(histogram.plot.plot.viewport(), point_at(histogram, low), point_at(histogram, high))
    qtbot.waitUntil(lambda: histogram.range() == view.look.show.by_quality != before)
    window.refresh()
    return view.look.show.by_quality


def colour_by(window, metric):
    """Select the metric of the colours."""
    window.show_panel("look")
    walk_to(window, named(window.features["appearance"].panel, QComboBox, "Metric"), metric)


@pytest.mark.slow
def test_the_metric_follows_the_colours_until_a_range_or_the_user_fixes_it(window, qtbot, histogram):
    colour_by(window, "scaled-jacobian")
    assert histogram.axis.metric == "scaled-jacobian"
    assert histogram.head.metric_box.currentText() == "Scaled Jacobian (as colours)"
    brush(window, qtbot, 0.2, 0.5)
    colour_by(window, "skew")  # colours of the hexes in the range
    assert window.session.view.look.show.by_quality == histogram.range()
    assert histogram.axis.metric == histogram.range().metric == "scaled-jacobian"
    assert histogram.head.metric_box.currentText() == "Scaled Jacobian"
    walk_to(window, histogram.head.metric_box, "")
    assert histogram.axis.metric == "skew"
    assert histogram.range() is None
    walk_to(window, histogram.head.metric_box, "volume")
    colour_by(window, "q")
    assert histogram.axis.metric == "volume"


@pytest.mark.slow
def test_snapshots_are_named_after_the_iteration_and_shown_for_every_metric(window, qtbot, histogram, mesh_file):
    states = []
    for _ in range(2):
        smooth(qtbot, window.session, "local-sd", 1)
        window.refresh()
        histogram.head.keep.trigger()
        states.append(window.session.document.now)
    window.refresh()
    walk_to(window, histogram.head.metric_box, "condition")
    drawn = {one.name: one.distribution for one in histogram.series()}
    names = ["Local steepest descent 1", "Local steepest descent (2) 1"]
    assert [one.name for one in window.session.snapshots.all] == names
    for name, state in zip(names, states, strict=True):
        values = METRICS["condition"].of(state.mesh.points, state.mesh.hexes, state.figures)
        np.testing.assert_array_equal(drawn[name].values, values)
    press(histogram.legend.entries[1].cross)
    assert names[1] not in [one.name for one in window.session.snapshots.all]
    open_and_wait(qtbot, window, mesh_file)
    window.refresh()
    assert [one.name for one in histogram.series()] == ["at the start", "now"]


def test_a_click_on_the_bar_of_inverted_hexes_shows_only_them(window, histogram):
    QTest.mouseClick(histogram.plot.plot.viewport(), LEFT, pos=point_at(histogram, sum(histogram.axis.inverted) / 2))
    window.refresh()
    assert window.canvas.viewport.shown == window.session.document.now.figures.n_inverted > 0
    key(window, Qt.Key.Key_Escape)
    assert window.canvas.viewport.shown == 4000
