"""Overlays."""

import pytest
from PySide6.QtCore import QPoint, QPointF, QSize, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from hexmend_app.widgets.overlay import Overlay
from tests.app.conftest import separate_settings
from tests.app.driving import turn

_LEFT = Qt.MouseButton.LeftButton


@pytest.fixture(autouse=True)
def own_settings(tmp_path):
    with separate_settings(tmp_path):
        yield


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


def laid(over, home=(1.0, 0.5), key="card"):
    card = Card()
    place = Overlay(card, over, home, key=key)
    card.show()
    return card, place


@pytest.mark.parametrize(("home", "corner"), [((1.0, 0.5), (492, 100)), ((0.0, 0.0), (8, 8)), ((0.5, 1.0), (250, 192))])
def test_its_position_is_given_by_shares(over, home, corner):
    card, _ = laid(over, home)
    assert (card.x(), card.y()) == corner
    assert card.size() == QSize(100, 300)


def test_it_follows_and_shrinks_with_the_widget_below(over):
    card, _ = laid(over)
    over.resize(400, 200)
    turn()
    assert card.geometry().getRect() == (292, 8, 100, 184)
    over.resize(900, 700)
    turn()
    assert card.geometry().getRect() == (792, 200, 100, 300)


def moved(card, by):
    """Drag a card by its centre."""
    start = card.mapTo(card.parentWidget(), QPoint(50, 150))
    window = card.window().windowHandle()
    QTest.mousePress(window, _LEFT, pos=start)
    for k in range(1, 9):
        QTest.mouseMove(window, start + by * (k / 8))
    QTest.mouseRelease(window, _LEFT, pos=start + by)


def test_its_position_is_stored_as_shares_and_reset_by_a_double_click(over):
    card, place = laid(over)
    moved(card, QPoint(-242, 0))
    again, _ = laid(over)
    assert again.x() == card.x() == 250
    over.resize(1000, 500)
    turn()
    assert card.x() == 450
    again.hide()
    QTest.mouseDClick(card.window().windowHandle(), _LEFT, pos=card.geometry().center())
    assert place.place == (1.0, 0.5)
    assert laid(over)[1].place == (1.0, 0.5)


def test_the_wheel_reaches_the_widget_below_and_so_do_clicks_outside(over):
    card, _ = laid(over)
    QTest.wheelEvent(card.window().windowHandle(), QPointF(card.geometry().center()), QPoint(0, 120))
    assert "wheel" in over.heard
    QTest.mouseClick(over, _LEFT, pos=QPoint(200, 250))
    assert "press" in over.heard
