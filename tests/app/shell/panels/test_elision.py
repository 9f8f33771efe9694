"""Tabs of panels are elided in narrow windows; they are never scrolled by arrows."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QTabBar, QToolButton


def test_tabs_are_elided_and_not_scrolled(window, qtbot):
    window.show_panel("runs")
    window.resize(window.minimumSizeHint())
    qtbot.waitUntil(lambda: window.width() < 800)
    bars = [bar for bar in window.findChildren(QTabBar) if bar.isVisible() and bar.count()]
    assert len(bars) >= 3
    for bar in bars:
        assert not bar.usesScrollButtons(), bar.accessibleName()
        assert bar.elideMode() is Qt.TextElideMode.ElideRight
        assert not [button for button in bar.findChildren(QToolButton) if button.isVisible()]
        assert bar.rect().right() >= bar.tabRect(bar.count() - 1).right() - 1
