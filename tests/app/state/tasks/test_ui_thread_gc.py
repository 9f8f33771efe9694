"""Circular garbage that threads come upon stays for the window's thread."""

import gc
import threading
import weakref

import pytest
from PySide6.QtCore import QObject

from hexmend_app.state.tasks.ui_thread_gc import UiThreadGC
from tests.patience import PATIENCE


class Circle:
    """Garbage as soon as nobody else knows it."""

    def __init__(self, went):
        self.itself = self
        weakref.finalize(self, lambda: went.append(threading.current_thread()))


@pytest.fixture
def garbage(qapp):
    return qapp.findChild(UiThreadGC)


def test_a_thread_collects_none(qapp):
    went = []
    Circle(went)
    thread = threading.Thread(target=lambda: [[] for _ in range(100_000)])
    thread.start()
    thread.join()
    assert went == []
    gc.collect()
    assert went == [threading.current_thread()]


def test_it_is_collected_while_the_window_waits(garbage, qtbot):
    went = []
    Circle(went)
    kept = [[] for _ in range(10_000)]
    qtbot.waitUntil(lambda: bool(went), timeout=PATIENCE)
    assert kept


@pytest.mark.slow
def test_old_garbage_goes_too(garbage):
    went = []
    circle = Circle(went)
    gc.collect()  # by now it is old
    del circle
    kept = []
    for _ in range(200):
        kept.append([[] for _ in range(1000)])
        garbage.look()
    assert went


def test_what_is_spared_is_looked_at_no_more_and_what_comes_after_is(garbage):
    went, before = [], Circle([])
    gc.collect()  # or garbage would be spared too
    garbage.spare()
    assert not any(one is before for one in gc.get_objects())
    Circle(went)
    gc.collect()
    assert went


def test_little_is_left_alone(garbage):
    went = []
    gc.collect()
    Circle(went)
    garbage.look()
    assert went == []
    gc.collect()


def test_there_is_one_of_an_application(garbage, qapp):
    from hexmend_app.shell.start.program import application

    assert application().findChildren(UiThreadGC) == [garbage]
    assert isinstance(garbage, QObject)
    assert not gc.isenabled()
