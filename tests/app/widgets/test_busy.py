"""Progress indicator: the newest of several tasks, each with its own button."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from hexmend_app.widgets.busy import Busy


@pytest.fixture
def ended():
    return []


@pytest.fixture
def busy(shown, ended):
    busy = shown(Busy())
    busy.show_work("open", "Reading…", "Cancel", "Do not.", lambda: ended.append("open"))
    busy.show_work("film", "Drawing…", "Give up", "Do not.", lambda: ended.append("film"))
    return busy


def test_the_newest_of_several_tasks_is_shown_and_ended(busy, ended):
    assert busy.text() == "Drawing…"
    button = busy.findChild(QPushButton)
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    busy.done("film")
    assert (busy.text(), button.text()) == ("Reading…", "Cancel")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    assert ended == ["film", "open"]
    busy.done("open")
    assert busy.isHidden()


def test_escape_ends_the_task_of_its_owner(busy, ended):
    busy.take_escape("open")
    QTest.keyClick(busy, Qt.Key.Key_Escape)
    assert ended == ["open"]
    busy.take_escape("")
    QTest.keyClick(busy, Qt.Key.Key_Escape)
    assert ended == ["open"]


def test_the_bar_shows_the_share_of_the_newest_task_where_it_is_known(busy):
    assert busy.share is None
    busy.show_work("film", "Drawing: 40%…", "Give up", "Do not.", lambda: None, 0.4)
    assert busy.share == pytest.approx(0.4)
    busy.done("film")
    assert busy.share is None
    busy.show_work("open", "Reading…", share=0.0)
    assert busy.share == 0
