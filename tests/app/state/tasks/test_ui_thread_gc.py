"""Cyclic garbage is collected in the thread of the window only."""

import gc
import threading
import weakref

import pytest

from hexmend_app.state.tasks.ui_thread_gc import UiThreadGC


class Cycle:
    """Object that refers to itself: garbage without other references; `collected` gets the collecting thread."""

    def __init__(self, collected):
        self.itself = self
        weakref.finalize(self, lambda: collected.append(threading.current_thread()))


@pytest.fixture
def garbage(qapp):
    return qapp.findChild(UiThreadGC)


def test_other_threads_do_not_collect(qapp):
    collected = []
    Cycle(collected)
    thread = threading.Thread(target=lambda: [[] for _ in range(100_000)])
    thread.start()
    thread.join()
    assert collected == []
    gc.collect()
    assert collected == [threading.current_thread()]


def test_garbage_is_collected_while_the_window_waits(garbage, qtbot):
    collected = []
    Cycle(collected)
    kept = [[] for _ in range(10_000)]
    qtbot.waitUntil(lambda: bool(collected))
    assert kept


@pytest.mark.slow
def test_old_garbage_is_collected_too(garbage):
    collected = []
    cycle = Cycle(collected)
    gc.collect()  # moves it to the oldest generation
    del cycle
    kept = []
    for _ in range(200):
        kept.append([[] for _ in range(1000)])
        garbage.collect()
    assert collected


def test_frozen_objects_are_not_examined_but_newer_ones_are(garbage):
    collected, before = [], Cycle([])
    gc.collect()  # or garbage would be frozen too
    garbage.freeze()
    assert not any(one is before for one in gc.get_objects())
    Cycle(collected)
    gc.collect()
    assert collected
