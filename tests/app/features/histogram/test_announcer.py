"""The newest of many values is told; one that is heard again takes back nothing that is newer."""

import pytest

from hexmend_app.features.histogram.announcer import Announcer
from tests.patience import PATIENCE


@pytest.fixture
def announcer(qtbot):
    return Announcer()


@pytest.fixture
def heard(announcer):
    values = []
    announcer.announced.connect(values.append)
    return values


def test_of_many_values_the_newest_is_told(announcer, heard, qtbot):
    for value in range(20):
        announcer.tell(value)
    qtbot.waitUntil(lambda: heard[-1] == 19, timeout=PATIENCE)
    assert heard == [0, 19]


def test_what_was_told_last_takes_back_nothing_newer(announcer, heard, qtbot):
    announcer.tell(1)
    announcer.tell(2)
    assert heard == [1]
    assert not announcer.hear(1)
    qtbot.waitUntil(lambda: heard == [1, 2], timeout=PATIENCE)
    assert announcer.hear(2)


def test_another_value_is_told_instead_of_one_that_waits(announcer, heard, qtbot):
    announcer.tell_instead(0)  # none does
    announcer.tell(1)
    announcer.tell(2)
    announcer.tell_instead(None)
    qtbot.waitUntil(lambda: len(heard) == 2, timeout=PATIENCE)
    assert heard == [1, None]


def test_what_others_set_takes_back_what_waits(announcer, heard, qtbot):
    announcer.tell(1)
    announcer.tell(2)
    assert announcer.hear(None)
    announcer.tell(3)
    qtbot.waitUntil(lambda: heard[-1] == 3, timeout=PATIENCE)
    assert 2 not in heard
