"""Overlays."""

import pytest
from PySide6.QtCore import QPoint, QPointF, QSize, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from hexmend_app.widgets.overlay import Overlay
from tests.app.driving import turn

_LEFT = Qt.MouseButton.LeftButton


class Below(QWidget):
    """Widget below an overlay, which records mouse events."""

    def __init__(self):
        super().__init__()
        self.heard = []

    def mousePressEvent(self, event):
        self.heard.append("press")

    def mouseMoveEvent(self, event):
        self.heard.append("move")

    def wheelEvent(self, event):
        self.heard.append("wheel")


class Card(QWidget):
    """Widget with a fixed preferred size and a text."""

    def __init__(self):
        super().__init__()
        QVBoxLayout(self).addWidget(QLabel("text"))

    def sizeHint(self):
        return QSize(100, 300)


@pytest.fixture
def over(shown):
    return shown(Below(), 600, 500)


def laid(over, place=(1.0, 0.5)):
    card = Card()
    Overlay(card, over, place)
    card.show()
    return card


@pytest.mark.parametrize(
    ("place", "corner"), [((1.0, 0.5), (492, 100)), ((0.0, 0.0), (8, 8)), ((0.5, 1.0), (250, 192))]
)
def test_its_position_is_given_by_shares(over, place, corner):
    card = laid(over, place)
    assert (card.x(), card.y()) == corner
    assert card.size() == QSize(100, 300)


def test_it_follows_and_shrinks_with_the_widget_below(over):
    card = laid(over)
    over.resize(400, 200)
    turn()
    assert card.geometry().getRect() == (292, 8, 100, 184)
    over.resize(900, 700)
    turn()
    assert card.geometry().getRect() == (792, 200, 100, 300)


def test_the_wheel_reaches_the_widget_below_and_so_do_clicks_outside(over):
    card = laid(over)
    QTest.wheelEvent(card.window().windowHandle(), QPointF(card.geometry().center()), QPoint(0, 120))
    assert "wheel" in over.heard
    QTest.mouseClick(over, _LEFT, pos=QPoint(200, 250))
    assert "press" in over.heard
