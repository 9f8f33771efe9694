"""The window as a whole: content, layout and errors."""

import sys
from collections import Counter

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QLineEdit, QScrollArea, QSpinBox, QWidget

from hexmend.quality import METRICS
from hexmend_app.picture.colours import Range
from hexmend_app.shell.start.program import report_unexpected_errors
from hexmend_app.shell.window_actions import KeysPage, name_of
from hexmend_app.widgets.section import Section
from tests.app.canvas.test_shading_task import rested
from tests.app.driving import named, pixels


def test_an_opened_mesh_is_shown_with_its_figures(window):
    assert window.windowTitle().startswith("bridge.vtu")
    assert "4,000 hexes" in named(window, QLabel, "Counts").text()
    summary = window.session.document.now.summary
    window.refresh()
    assert f"inverted {summary.inverted:,}" in window.features["quality"].bar.text
    assert not window.features["open"].welcome.isVisible()
    image = pixels(window)
    assert (image.max(axis=2) - image.min(axis=2) > 60).mean() > 0.05


@pytest.mark.slow
@pytest.mark.parametrize("size", [(1440, 900), (1100, 700)])
def test_nothing_is_cut_off(window, qtbot, size):
    window.resize(*size)
    qtbot.waitUntil(lambda: window.width() == size[0])
    for panel in ("run", "look", "cut", "show", "histogram"):
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


def test_expanded_sections_fit_the_width_of_the_column(window, qtbot):
    window.resize(1100, 700)
    qtbot.waitUntil(lambda: window.width() == 1100)
    for panel in ("run", "recipe", "look", "cut", "inside", "show"):
        window.show_panel(panel)
        for section in window.findChildren(Section):
            if section.isVisible():
                section.expand()
        window.refresh()
        qtbot.waitUntil(lambda: columns_overflowing(window) == [])


def columns_overflowing(window):
    """Return the scroll areas whose content is wider than they are."""
    return [
        area
        for area in window.findChildren(QScrollArea)
        if area.isVisible() and area.widget() and area.widget().width() > area.viewport().width()
    ]


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
    qtbot.waitUntil(lambda: len(later) > 0)
    for _ in range(50):
        QApplication.processEvents()
    ((_, _, text),) = [message for message in window.messages.messages() if message[0] == "error"]
    assert "ZeroDivisionError: one over nothing" in text
    assert len(later) < 5


# Shortcuts of actions are unique.


def test_no_two_actions_have_the_same_keys(window):
    keys = [action.shortcut().toString() for action in window.findChildren(QAction) if not action.shortcut().isEmpty()]
    assert [key for key, times in Counter(keys).items() if times > 1] == []


def test_letters_cut_after_a_number_was_typed(window):
    window.show_panel("run")
    steps = named(window.features["smooth"].panel, QSpinBox, "Iterations per step")
    steps.setFocus()
    QTest.keyClick(steps, Qt.Key.Key_Return)
    QTest.keyClick(QApplication.focusWidget(), Qt.Key.Key_C)
    window.refresh()
    assert window.session.view.look.cut.active


# Keys of VTK do nothing in the view.


@pytest.mark.slow
def test_keys_of_vtk_do_nothing(window, qtbot):
    view = window.canvas.interactor
    view.setFocus()
    rested(window, qtbot)
    before = pixels(window)
    hexmend = {declared.keys for declared in window.menus.declared()}
    for typed in sorted(set("3acefjpqrstuw") - {keys.lower() for keys in hexmend}):
        QTest.keyClicks(view, typed)
    rested(window, qtbot)
    assert (np.abs(pixels(window) - before).sum(axis=2) > 60).mean() < 0.01
    assert window.isVisible()


# The page of mouse and keys.


def test_the_page_lists_every_key_and_can_be_filtered(window, qtbot):
    QTest.keyClick(window.windowHandle(), Qt.Key.Key_F1)
    page = next(page for page in window.findChildren(KeysPage) if page.isVisible())
    text = page.text()
    for declared in window.menus.declared():
        assert name_of(declared) in text
        assert declared.keys in text.replace("\xa0", " ")
    QTest.keyClicks(page.findChild(QLineEdit), "sharp")
    assert "Sharp edges" in page.text()
    assert "Open" not in page.text()
    page.close()
