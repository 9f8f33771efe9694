"""The histogram in the window: it counts what the colours show, hides what is not brushed, and keeps what was."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QPushButton

from hexmend.quality import METRICS
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import LEFT, choose, click, drag, key, named, open_and_wait, phase, pixels, press, walk_to
from tests.patience import PATIENCE


@pytest.fixture
def histogram(window):
    """The panel, as large as it is at first."""
    window.show_panel("histogram")
    window.refresh()
    return window.features["histogram"].panel


def at(histogram, x, height=0.5):
    """The point of the plot at x, at a share of its height."""
    view, around = histogram.plot.view, histogram.plot.view.viewRect()
    return histogram.plot.plot.mapFromScene(view.mapViewToScene(QPointF(x, around.top() + height * around.height())))


def brush(window, qtbot, low, high):
    """Drag over the histogram from one place to another, until the view has the range that is shown there."""
    histogram, view = window.features["histogram"].panel, window.session.view
    before = view.look.quality_range
    QApplication.processEvents()  # another metric's axis takes other room
    drag(histogram.plot.plot.viewport(), at(histogram, low), at(histogram, high))
    qtbot.waitUntil(lambda: histogram.range() == view.look.quality_range != before, timeout=PATIENCE)
    window.refresh()
    return view.look.quality_range


def colour_by(window, metric):
    """Choose what the colours show, in the panel of the look."""
    window.show_panel("look")
    walk_to(window, named(window.features["appearance"].panel, QComboBox, "Metric"), metric)


@pytest.mark.slow
def test_brushing_keeps_a_range_in_view(window, qtbot, histogram):
    whole = pixels(window)
    chosen = brush(window, qtbot, 0.2, 0.6)
    assert chosen.metric == "q"
    assert (chosen.low, chosen.high) == pytest.approx((0.2, 0.6), abs=0.03)
    assert (np.abs(pixels(window) - whole).sum(axis=2) > 60).mean() > 0.01
    press(named(histogram, QPushButton, "Show all"))
    qtbot.waitUntil(lambda: window.session.view.look.quality_range is None, timeout=PATIENCE)


@pytest.mark.slow
def test_brushing_another_metric_filters_the_view_and_follows_a_run(window, qtbot, histogram):
    walk_to(window, histogram.head.metric_box, "max-angle")
    assert window.session.view.look.scale.metric == "q"  # colours are left alone
    chosen, viewport = brush(window, qtbot, 0.75, 1.0), window.canvas.viewport
    assert (chosen.metric, chosen.high) == ("max-angle", 180)
    assert chosen.low == pytest.approx(135, abs=4)

    def inside():
        mesh, figures = window.session.document.now.mesh, window.session.document.now.figures
        angles = METRICS["max-angle"].of(mesh.points, mesh.hexes, figures)
        return np.count_nonzero((angles >= chosen.low) & ~figures.inverted)

    start, shown = window.session.document.now, viewport.shown
    assert 0 < shown == inside() < 4000
    assert histogram.words.text().startswith(f"{shown:,} of 4,000 hexes from ")
    click(window, "Step")
    qtbot.waitUntil(lambda: window.session.document.now is not start, timeout=PATIENCE)
    window.refresh()
    assert viewport.shown == inside() != shown
    walk_to(window, histogram.head.metric_box, "volume")  # what it hides could no longer be told from the plot
    assert window.session.view.look.quality_range is None


@pytest.mark.slow
def test_it_counts_what_the_colours_show_until_a_range_or_the_user_holds_it(window, qtbot, histogram):
    colour_by(window, "scaled-jacobian")
    assert histogram.axis.metric == "scaled-jacobian"
    assert histogram.head.metric_box.currentText() == "Scaled Jacobian (as colours)"
    brush(window, qtbot, 0.2, 0.5)
    colour_by(window, "skew")  # colours laid over what the range leaves
    assert window.session.view.look.quality_range == histogram.range()
    assert histogram.axis.metric == histogram.range().metric == "scaled-jacobian"
    assert histogram.head.metric_box.currentText() == "Scaled Jacobian"
    walk_to(window, histogram.head.metric_box, "")
    assert histogram.axis.metric == "skew"
    assert histogram.range() is None
    walk_to(window, histogram.head.metric_box, "volume")
    colour_by(window, "q")
    assert histogram.axis.metric == "volume"


def keep(window, histogram):
    """Keep the moment that is shown, which may not be possible."""
    window.refresh()
    histogram.head.keep.trigger()
    window.refresh()


@pytest.mark.slow
def test_distributions_are_kept_under_the_name_of_the_moment_for_any_metric(window, qtbot, histogram, mesh_file):
    kept = window.session.snapshots
    choose(window, "local-sd")
    start = window.session.document.now
    click(window, "Step")
    qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    qtbot.waitUntil(lambda: window.session.document.now is not start, timeout=PATIENCE)
    keep(window, histogram)
    then = window.session.document.now
    click(window, "Step")
    qtbot.waitUntil(lambda: window.session.document.now is not then, timeout=PATIENCE)
    for _ in range(6):
        keep(window, histogram)
    first, second = "Local steepest descent 1", "Local steepest descent 2"
    assert [one.name for one in kept.all] == [first, second, *(f"{second} ({k})" for k in (2, 3, 4, 5))]
    assert not histogram.head.keep.isEnabled()
    walk_to(window, histogram.head.metric_box, "condition")
    drawn = {one.name: one.part for one in histogram.series()}
    of = METRICS["condition"].of
    np.testing.assert_array_equal(drawn[first].values, of(then.mesh.points, then.mesh.hexes, then.figures))
    assert drawn[first].inverted == then.summary.inverted
    np.testing.assert_array_equal(drawn[second].counts, drawn["now"].counts)
    press(histogram.legend.entries[1].cross)
    assert second not in [one.name for one in kept.all]
    assert histogram.head.keep.isEnabled()
    window.session.run.stop()
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    click(window, "Reset")
    keep(window, histogram)
    assert kept.all[-1].name == "before Local steepest descent"
    assert len({one.slot for one in kept.all}) == 6
    open_and_wait(qtbot, window, mesh_file)
    window.refresh()
    assert not kept.all
    assert [one.name for one in histogram.series()] == ["at the start", "now"]


def test_a_click_on_the_bar_of_the_inverted_shows_only_them(window, histogram):
    QTest.mouseClick(histogram.plot.plot.viewport(), LEFT, pos=at(histogram, sum(histogram.axis.inverted) / 2))
    window.refresh()
    assert window.canvas.viewport.shown == window.session.document.now.figures.n_inverted > 0
    key(window, Qt.Key.Key_Escape)
    assert window.canvas.viewport.shown == 4000


def test_a_refresh_in_the_midst_of_a_drag_takes_nothing_back(window, qtbot, histogram):
    view = histogram.plot.view
    view.brushed.emit((0.2, 0.4))
    view.brushed.emit((0.2, 0.5))  # waits for its turn
    window.refresh()
    qtbot.waitUntil(lambda: window.session.view.look.quality_range == histogram.range(), timeout=PATIENCE)
    assert histogram.range().high == pytest.approx(0.5, abs=1e-9)
