"""The window as a whole: content, layout and errors."""

from __future__ import annotations

import sys

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QWidget

from hexmend.quality import METRICS
from hexmend_app.picture.colours import Range
from hexmend_app.shell.start.program import report_unexpected_errors
from tests.app.driving import key, named, pixels
from tests.patience import PATIENCE


def test_an_opened_mesh_is_shown_with_its_figures(window):
    assert window.windowTitle().startswith("bridge.vtu")
    assert "4,000 hexes" in named(window, QLabel, "Counts").text()
    summary = window.session.document.now.summary
    window.show_panel("quality")
    window.refresh()
    assert f"{summary.inverted:,}" in window.features["quality"].panel.text()
    assert not window.features["open"].welcome.isVisible()
    image = pixels(window)
    assert (image.max(axis=2) - image.min(axis=2) > 60).mean() > 0.05


@pytest.mark.slow
@pytest.mark.parametrize("size", [(1440, 900), (1100, 700)])
def test_nothing_is_cut_off(window, qtbot, size):
    window.resize(*size)
    qtbot.waitUntil(lambda: window.width() == size[0], timeout=PATIENCE)
    for panel in ("run", "look", "cut", "show", "histogram", "quality"):
        window.show_panel(panel)
        window.refresh()
        QApplication.processEvents()
        assert cut_off(window) == [], panel
    window.show_panel("look")
    window.show_panel("histogram")
    width = window.docks.centre.width()
    for metric in METRICS:  # no metric's numbers make the window or the column wider
        window.session.view.change(colours={"metric": metric, "range": Range.FITTED})
        window.refresh()
        QApplication.processEvents()
        assert cut_off(window) == [], metric
        assert (window.width(), window.height(), window.docks.centre.width()) == (*size, width)


def cut_off(window):
    """Return the visible widgets that exceed the window or are narrower than their minimum width."""
    return [
        part
        for part in window.findChildren(QWidget)
        if part.isVisible()
        and part.window() is window
        and not part.visibleRegion().isEmpty()
        and (part.mapTo(window, part.rect().bottomRight()).x() >= window.width() or part.width() < part.minimumWidth())
    ]


def test_unexpected_errors_are_shown(window, monkeypatch):
    monkeypatch.setattr(sys, "excepthook", sys.excepthook)
    report_unexpected_errors(window)
    try:
        raise ZeroDivisionError("one over nothing")
    except ZeroDivisionError as error:
        sys.excepthook(type(error), error, error.__traceback__)
    assert "ZeroDivisionError: one over nothing" in window.messages.messages()[-1][2]


@pytest.mark.slow
def test_messages_and_the_colour_bar_do_not_change_the_layout(window, qtbot):
    canvas, bar = window.canvas, window.canvas.colour_bar
    before = canvas.interactor.geometry(), bar.geometry()
    assert canvas.interactor.rect().contains(bar.geometry())
    window.messages.show_error("The mesh was not saved", "There is no room. " * 20)
    qtbot.waitUntil(window.messages.isVisible, timeout=PATIENCE)
    assert (canvas.interactor.geometry(), bar.geometry()) == before
    assert window.messages.width() <= 560
    width = canvas.interactor.width()
    window.resize(1000, 640)
    qtbot.waitUntil(lambda: canvas.interactor.width() < width, timeout=PATIENCE)
    qtbot.waitUntil(lambda: canvas.interactor.rect().contains(bar.geometry()), timeout=PATIENCE)
    key(window, Qt.Key.Key_Escape)
    assert not window.messages.isVisible()


@pytest.mark.slow
def test_the_view_has_the_focus_when_a_mesh_is_shown(fresh_window):
    view = fresh_window.canvas.interactor
    fresh_window.canvas.hide()
    fresh_window.refresh()
    assert fresh_window.focusWidget() is view
    QTest.keyClick(view, Qt.Key.Key_Tab)
    assert fresh_window.docks.hidden
    QTest.keyClick(view, Qt.Key.Key_Tab)
    assert not fresh_window.docks.hidden


@pytest.mark.slow
def test_a_failing_refresh_is_reported_once_and_other_features_are_refreshed(fresh_window, qtbot, monkeypatch):
    window = fresh_window
    monkeypatch.setattr(sys, "excepthook", sys.excepthook)
    report_unexpected_errors(window)

    def fail():
        raise ZeroDivisionError("one over nothing")

    later = []
    monkeypatch.setattr(window.features["appearance"], "refresh", fail)
    monkeypatch.setattr(window.features["compare"], "refresh", lambda: later.append(1))
    window.session.selection.changed.emit()
    qtbot.waitUntil(lambda: len(later) > 0, timeout=PATIENCE)
    for _ in range(50):
        QApplication.processEvents()
    ((_, _, text),) = [message for message in window.messages.messages() if message[0] == "error"]
    assert "one over nothing" in text
    assert len(later) < 5
