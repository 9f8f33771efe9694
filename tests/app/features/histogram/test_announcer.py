"""The latest of many values is announced; an announced value that returns does not replace a newer one."""

import pytest

from hexmend_app.features.histogram.announcer import Announcer
from tests.patience import PATIENCE


@pytest.fixture
def announcer(qtbot):
    return Announcer()


@pytest.fixture
def announced(announcer):
    values = []
    announcer.announced.connect(values.append)
    return values


def test_the_latest_of_many_values_is_announced(announcer, announced, qtbot):
    for value in range(20):
        announcer.send(value)
    qtbot.waitUntil(lambda: announced[-1] == 19, timeout=PATIENCE)
    assert announced == [0, 19]


def test_an_announced_value_that_returns_does_not_replace_a_newer_one(announcer, announced, qtbot):
    announcer.send(1)
    announcer.send(2)
    assert announced == [1]
    assert not announcer.receive(1)
    qtbot.waitUntil(lambda: announced == [1, 2], timeout=PATIENCE)
    assert announcer.receive(2)


def test_a_pending_value_is_replaced(announcer, announced, qtbot):
    announcer.replace_pending(0)  # nothing is pending
    announcer.send(1)
    announcer.send(2)
    announcer.replace_pending(None)
    qtbot.waitUntil(lambda: len(announced) == 2, timeout=PATIENCE)
    assert announced == [1, None]


def test_a_received_value_drops_the_pending_one(announcer, announced, qtbot):
    announcer.send(1)
    announcer.send(2)
    assert announcer.receive(None)
    announcer.send(3)
    qtbot.waitUntil(lambda: announced[-1] == 3, timeout=PATIENCE)
    assert 2 not in announced
