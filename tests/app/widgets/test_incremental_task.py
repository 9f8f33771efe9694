"""Pieces come one in a turn of the event loop, until they are there, fail, or are given up."""

import pytest
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from hexmend_app.widgets.busy import Busy
from hexmend_app.widgets.incremental_task import IncrementalTask
from tests.app.driving import LEFT
from tests.patience import PATIENCE


class Source:
    """A generator of numbers, which knows how many were asked for and whether it was closed."""

    def __init__(self, count, fails_at=None):
        self.count, self.fails_at = count, fails_at
        self.brought, self.closed = 0, False

    def numbers(self):
        try:
            for number in range(self.count):
                if number == self.fails_at:
                    raise ValueError(f"no {number}")
                self.brought += 1
                yield number
        finally:
            self.closed = True


def say(taken):
    return f"{taken} are there"


@pytest.fixture
def busy(shown):
    return shown(Busy())


@pytest.fixture
def pieces(busy):
    return IncrementalTask(busy, "somebody", "Give it up.", busy)


@pytest.fixture
def heard(pieces):
    told = []
    pieces.finished.connect(lambda taken: told.append(("finished", taken)))
    pieces.failed.connect(lambda error: told.append(("failed", str(error))))
    return told


def test_all_pieces_come_and_what_is_done_is_said(pieces, busy, heard, qtbot):
    said = []
    pieces.begin(Source(3).numbers(), lambda taken: said.append(taken) or say(taken))
    assert pieces.going_on
    assert busy.text() == "0 are there"
    qtbot.waitUntil(lambda: not pieces.going_on, timeout=PATIENCE)
    assert heard == [("finished", [0, 1, 2])]
    assert said == [0, 1, 2, 3]
    assert busy.isHidden()


def test_the_rest_can_be_given_up(pieces, busy, heard, qtbot):
    source = Source(10**9)
    pieces.begin(source.numbers(), say)
    qtbot.waitUntil(lambda: source.brought > 0, timeout=PATIENCE)
    cancel = next(one for one in busy.findChildren(QPushButton) if one.text() == "Cancel")
    QTest.mouseClick(cancel, LEFT)
    assert not pieces.going_on
    assert source.closed
    assert busy.isHidden()
    assert heard == []


def test_one_that_cannot_be_had_ends_all(pieces, busy, heard, qtbot):
    source = Source(5, fails_at=2)
    pieces.begin(source.numbers(), say)
    qtbot.waitUntil(lambda: not pieces.going_on, timeout=PATIENCE)
    assert heard == [("failed", "no 2")]
    assert (source.brought, source.closed) == (2, True)
    assert busy.isHidden()


def test_others_take_the_place_of_those_that_are_coming(pieces, heard, qtbot):
    first = Source(10**9)
    pieces.begin(first.numbers(), say)
    qtbot.waitUntil(lambda: first.brought > 0, timeout=PATIENCE)
    pieces.begin(Source(2).numbers(), say)
    assert first.closed
    qtbot.waitUntil(lambda: not pieces.going_on, timeout=PATIENCE)
    assert heard == [("finished", [0, 1])]
