"""Tabs of panels are elided in narrow windows; they are never scrolled by arrows."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QTabBar, QToolButton

from hexmend_app.feature import Panel, PanelPlace
from hexmend_app.shell.panels.stacked_panels import stack
from tests.app.driving import turn


def bars_of(window):
    return [bar for bar in window.findChildren(QTabBar) if bar.isVisible() and bar.count() > 1]


@pytest.mark.slow
def test_tabs_are_elided_and_not_scrolled(window, qtbot):
    for panel in ("worst", "compare"):
        window.show_panel(panel)
    window.resize(window.minimumSizeHint())
    turn()
    qtbot.waitUntil(lambda: window.width() < 1000 and all(bar.accessibleName() for bar in bars_of(window)))
    bars = bars_of(window)
    assert len(bars) == 2
    for bar in bars:
        assert not bar.usesScrollButtons(), [bar.tabText(k) for k in range(bar.count())]
        assert bar.elideMode() is Qt.TextElideMode.ElideRight
        arrows = bar.findChildren(QToolButton, options=Qt.FindChildOption.FindDirectChildrenOnly)
        assert not [button for button in arrows if button.isVisible()]
        assert bar.rect().right() >= bar.tabRect(bar.count() - 1).right() - 1


# Panels one below the other in a scroll area.


def test_a_panel_that_becomes_wider_is_not_cut_off(shown, qtbot):
    label = QLabel("short")
    area = shown(stack([Panel(id="one", title="One", widget=label, place=PanelPlace.TOOLS)]), width=60, height=80)
    label.setText("a text that needs several times the width")
    qtbot.waitUntil(lambda: area.width() >= label.minimumSizeHint().width())
    assert area.widget().width() <= area.viewport().width()
