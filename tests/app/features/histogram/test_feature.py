"""Histogram in the window: metric of the colours, brushed ranges and snapshots."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox

from hexmend.quality import METRICS
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import LEFT, choose, click, drag, key, named, open_and_wait, phase, press, walk_to
from tests.patience import PATIENCE


@pytest.fixture
def histogram(window):
    """Return the panel, in its default size."""
    window.show_panel("histogram")
    window.refresh()
    return window.features["histogram"].panel


def point_at(histogram, x):
    """Return the point of the plot at x, at half of its height."""
    view = histogram.plot.view
    return histogram.plot.plot.mapFromScene(view.mapViewToScene(QPointF(x, view.viewRect().center().y())))


def brush(window, qtbot, low, high):
    """Drag over the histogram, wait until the view has its range, and return the range."""
    histogram, view = window.features["histogram"].panel, window.session.view
    before = view.look.show.by_quality
    QApplication.processEvents()  # lays out the axis of another metric
    drag(histogram.plot.plot.viewport(), point_at(histogram, low), point_at(histogram, high))
    qtbot.waitUntil(lambda: histogram.range() == view.look.show.by_quality != before, timeout=PATIENCE)
    window.refresh()
    return view.look.show.by_quality


def colour_by(window, metric):
    """Select the metric of the colours."""
    window.show_panel("look")
    walk_to(window, named(window.features["appearance"].panel, QComboBox, "Metric"), metric)


@pytest.mark.slow
def test_brushing_another_metric_filters_the_view_and_follows_a_run(window, qtbot, histogram):
    walk_to(window, histogram.head.metric_box, "max-angle")
    assert window.session.view.look.colours.metric == "q"  # unchanged
    range, viewport = brush(window, qtbot, 0.75, 1.0), window.canvas.viewport
    assert (range.metric, range.high) == ("max-angle", 180)
    assert range.low == pytest.approx(135, abs=4)

    def inside():
        mesh, figures = window.session.document.now.mesh, window.session.document.now.figures
        angles = METRICS["max-angle"].of(mesh.points, mesh.hexes, figures)
        return np.count_nonzero((angles >= range.low) & ~figures.inverted)

    start, shown = window.session.document.now, viewport.shown
    assert 0 < shown == inside() < 4000
    assert histogram.summary.text().startswith(f"{shown:,} of 4,000 hexes from ")
    click(window, "Step")
    qtbot.waitUntil(lambda: window.session.document.now is not start, timeout=PATIENCE)
    window.refresh()
    assert viewport.shown == inside() != shown
    walk_to(window, histogram.head.metric_box, "volume")  # the plot cannot show a range of another metric
    assert window.session.view.look.show.by_quality is None


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


def keep(window, histogram):
    """Keep the present distribution, if possible."""
    window.refresh()
    histogram.head.keep.trigger()
    window.refresh()


@pytest.mark.slow
def test_snapshots_are_named_after_the_iteration_and_shown_for_every_metric(window, qtbot, histogram, mesh_file):
    snapshots = window.session.snapshots
    choose(window, "local-sd")
    start = window.session.document.now
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    qtbot.waitUntil(lambda: window.session.document.now is not start, timeout=PATIENCE)
    keep(window, histogram)
    first_step = window.session.document.now
    click(window, "Step")
    qtbot.waitUntil(lambda: window.session.document.now is not first_step, timeout=PATIENCE)
    for _ in range(6):
        keep(window, histogram)
    first, second = "Local steepest descent 1", "Local steepest descent 2"
    assert [one.name for one in snapshots.all] == [first, second, *(f"{second} ({k})" for k in (2, 3, 4, 5))]
    assert not histogram.head.keep.isEnabled()
    walk_to(window, histogram.head.metric_box, "condition")
    drawn = {one.name: one.distribution for one in histogram.series()}
    of = METRICS["condition"].of
    np.testing.assert_array_equal(
        drawn[first].values, of(first_step.mesh.points, first_step.mesh.hexes, first_step.figures)
    )
    assert drawn[first].inverted == first_step.summary.inverted
    np.testing.assert_array_equal(drawn[second].counts, drawn["now"].counts)
    press(histogram.legend.entries[1].cross)
    assert second not in [one.name for one in snapshots.all]
    assert histogram.head.keep.isEnabled()
    window.session.run.stop()
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    click(window, "Reset")
    keep(window, histogram)
    assert snapshots.all[-1].name == "before Local steepest descent"
    assert len({one.slot for one in snapshots.all}) == 6
    open_and_wait(qtbot, window, mesh_file)
    window.refresh()
    assert not snapshots.all
    assert [one.name for one in histogram.series()] == ["at the start", "now"]


def test_a_click_on_the_bar_of_inverted_hexes_shows_only_them(window, histogram):
    QTest.mouseClick(histogram.plot.plot.viewport(), LEFT, pos=point_at(histogram, sum(histogram.axis.inverted) / 2))
    window.refresh()
    assert window.canvas.viewport.shown == window.session.document.now.figures.n_inverted > 0
    key(window, Qt.Key.Key_Escape)
    assert window.canvas.viewport.shown == 4000


@pytest.mark.slow
def test_the_bars_have_the_colours_of_the_view(window, qtbot, histogram):
    window.refresh()
    gradient, colouring = histogram.series()[0].gradient, window.canvas.colouring
    assert [series.key for series in histogram.series()] == ["now", "start"]
    assert gradient[0] == (0.0, f"#{bytes(colouring.table[0]).hex()}")
    assert gradient[-1] == (1.0, f"#{bytes(colouring.table[-1]).hex()}")
    window.session.view.change(colours={"map": "cividis"})
    window.refresh()
    assert histogram.series()[0].gradient != gradient
    histogram.head.metric_chosen.emit("condition")
    window.refresh()
    assert [series.key for series in histogram.series()] == ["start", "now"]
    assert histogram.series()[1].gradient == ()
