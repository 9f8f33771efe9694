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
def indicator(shown, ended):
    indicator = shown(Busy())
    indicator.show_work("open", "Reading…", "Cancel", "Do not.", lambda: ended.append("open"))
    indicator.show_work("film", "Drawing…", "Give up", "Do not.", lambda: ended.append("film"))
    return indicator


def test_the_newest_of_several_tasks_is_shown_and_ended(indicator, ended):
    assert indicator.text() == "Drawing…"
    button = indicator.findChild(QPushButton)
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    indicator.done("film")
    assert (indicator.text(), button.text()) == ("Reading…", "Cancel")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    assert ended == ["film", "open"]
    indicator.done("open")
    assert indicator.isHidden()


def test_escape_ends_the_task_of_its_owner(indicator, ended):
    indicator.take_escape("open")
    QTest.keyClick(indicator, Qt.Key.Key_Escape)
    assert ended == ["open"]
    indicator.take_escape("")
    QTest.keyClick(indicator, Qt.Key.Key_Escape)
    assert ended == ["open"]


def test_the_bar_shows_the_share_of_the_newest_task_where_it_is_known(indicator):
    assert indicator.share is None
    indicator.show_work("film", "Drawing: 40%…", "Give up", "Do not.", lambda: None, 0.4)
    assert indicator.share == pytest.approx(0.4)
    indicator.done("film")
    assert indicator.share is None
    indicator.show_work("open", "Reading…", share=0.0)
    assert indicator.share == 0
