"""Incremental tasks: one item per turn of the event loop, until they finish, fail or are cancelled."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from hexmend_app.widgets.busy import Busy
from hexmend_app.widgets.incremental_task import IncrementalTask
from tests.app.driving import LEFT, button


class Source:
    """Generator of numbers that records how many were taken and whether it was closed."""

    def __init__(self, count, fails_at=None):
        self.count, self.fails_at = count, fails_at
        self.taken, self.closed = 0, False

    def numbers(self):
        try:
            for number in range(self.count):
                if number == self.fails_at:
                    raise ValueError(f"no {number}")
                self.taken += 1
                yield number
        finally:
            self.closed = True


def describe(count):
    return f"{count} done"


@pytest.fixture
def busy(shown):
    return shown(Busy())


@pytest.fixture
def task(busy):
    return IncrementalTask(busy, "somebody", "Cancel it.", busy)


@pytest.fixture
def signals(task):
    signals = []
    task.finished.connect(lambda taken: signals.append(("finished", taken)))
    task.failed.connect(lambda error: signals.append(("failed", str(error))))
    return signals


def test_all_items_are_computed_and_progress_is_shown(task, busy, signals, qtbot):
    counts = []
    task.begin(Source(3).numbers(), lambda count: counts.append(count) or describe(count))
    assert task.going_on
    assert busy.text() == "0 done"
    qtbot.waitUntil(lambda: not task.going_on)
    assert signals == [("finished", [0, 1, 2])]
    assert counts == [0, 1, 2, 3]
    assert busy.isHidden()


def test_a_task_can_be_cancelled(task, busy, signals, qtbot):
    source = Source(10**9)
    task.begin(source.numbers(), describe)
    qtbot.waitUntil(lambda: source.taken > 0)
    QTest.mouseClick(button(busy, "Cancel"), LEFT)
    assert not task.going_on
    assert source.closed
    assert busy.isHidden()
    assert signals == []


def test_a_failing_item_ends_the_task(task, busy, signals, qtbot):
    source = Source(5, fails_at=2)
    task.begin(source.numbers(), describe)
    qtbot.waitUntil(lambda: not task.going_on)
    assert signals == [("failed", "no 2")]
    assert (source.taken, source.closed) == (2, True)
    assert busy.isHidden()


def test_a_new_task_replaces_the_current_one(task, signals, qtbot):
    first = Source(10**9)
    task.begin(first.numbers(), describe)
    qtbot.waitUntil(lambda: first.taken > 0)
    task.begin(Source(2).numbers(), describe)
    assert first.closed
    qtbot.waitUntil(lambda: not task.going_on)
    assert signals == [("finished", [0, 1])]


# Progress indicator: the newest of several tasks, each with its own button.


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
