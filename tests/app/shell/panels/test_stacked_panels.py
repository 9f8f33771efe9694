"""Panels one below the other in a scroll area."""

from PySide6.QtWidgets import QLabel

from hexmend_app.feature import Panel, PanelPlace
from hexmend_app.shell.panels.stacked_panels import stack


def test_a_panel_that_becomes_wider_is_not_cut_off(shown, qtbot):
    label = QLabel("short")
    area = shown(stack([Panel(id="one", title="One", widget=label, place=PanelPlace.TOOLS)]), width=60, height=80)
    label.setText("a text that needs several times the width")
    qtbot.waitUntil(lambda: area.width() >= label.minimumSizeHint().width())
    assert area.widget().width() <= area.viewport().width()
