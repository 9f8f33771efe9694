"""The line that says what is going on: of several works the newest, each with its own way out."""

from __future__ import annotations

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


def test_of_several_works_the_newest_is_said_and_ended(busy, ended):
    assert busy.text() == "Drawing…"
    button = busy.findChild(QPushButton)
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    busy.done("film")
    assert (busy.text(), button.text()) == ("Reading…", "Cancel")
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    assert ended == ["film", "open"]
    busy.done("open")
    assert busy.isHidden()


def test_who_was_never_busy_ends_nothing(busy):
    busy.done("run")
    assert busy.text() == "Drawing…"


def test_escape_ends_whom_it_is_given_to(busy, ended):
    busy.take_escape("open")
    QTest.keyClick(busy, Qt.Key.Key_Escape)
    assert ended == ["open"]
    busy.take_escape("")
    QTest.keyClick(busy, Qt.Key.Key_Escape)
    assert ended == ["open"]
