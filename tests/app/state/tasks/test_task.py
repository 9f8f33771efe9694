"""Background tasks: signals, cancelling, dropping, and threads that stay running."""

import gc
import os
import threading
import weakref

import pytest

from hexmend_app.state.tasks.task import Task, running
from hexmend_app.state.tasks.ui_thread_gc import UiThreadGC


def test_reports_come_in_order_and_before_the_end_in_the_thread_that_made_the_task(qtbot):
    signals, threads = [], []

    def work(task):
        for word in ("one", "two"):
            task.report(word)
        return threading.get_ident()

    task = Task("reading a test", work)
    task.reported.connect(signals.append)
    task.ended.connect(lambda: (signals.append("end"), threads.append(threading.get_ident())))
    task.start()
    qtbot.waitUntil(lambda: signals[-1:] == ["end"])
    assert signals == ["one", "two", "end"]
    assert threads == [threading.get_ident()] != [task.result]
    assert task.error is None
    assert task.over


@pytest.mark.parametrize("error", [ValueError("no"), SystemExit(1)])
def test_an_exception_of_any_kind_becomes_the_error(qtbot, error):
    def work(task):
        raise error

    task = Task("reading a test", work)
    with qtbot.waitSignal(task.ended):
        task.start()
    assert task.error is error
    assert task.result is None


def test_a_running_thread_is_listed_by_name(qtbot, gate):
    task = Task("reading a test", lambda task: gate.wait())
    assert not task.over
    task.start()
    assert running() == (task,)
    assert "reading a test" in {thread.name for thread in threading.enumerate()}
    assert not task.over
    gate.set()
    task.wait()
    assert running() == ()
    assert "reading a test" not in {thread.name for thread in threading.enumerate()}


def test_a_cancelled_task_ends_early_and_emits_ended(qtbot):
    task = Task("reading a test", lambda task: task.cancelled.wait())
    with qtbot.waitSignal(task.ended):
        task.start()
        task.cancel()
    assert task.result is True


def test_dropped_tasks_and_those_waited_for_emit_nothing(qtbot, gate):
    signals = []

    def work(task):
        gate.wait()
        task.report("word")

    dropped, waited = Task("reading one", work), Task("reading another", work)
    for task in (dropped, waited):
        task.reported.connect(signals.append)
        task.ended.connect(lambda: signals.append("end"))
        task.start()
    dropped.drop()
    gate.set()
    waited.wait()
    last = Task("reading the last", lambda task: None)
    qtbot.waitUntil(lambda: dropped.over)
    with qtbot.waitSignal(last.ended):  # their signals would have come before
        last.start()
    assert signals == []


def test_a_task_without_references_lives_until_it_is_over(qtbot, gate):
    signals = []
    task = Task("reading a test", lambda task: gate.wait())
    task.ended.connect(lambda: signals.append("end"))
    task.start()
    known = weakref.ref(task)
    del task
    gc.collect()
    assert known() is not None
    gate.set()
    qtbot.waitUntil(lambda: signals == ["end"])
    gc.collect()
    assert known() is None


@pytest.mark.skipif(not hasattr(os, "getpriority"), reason="the system has no process priorities")
@pytest.mark.parametrize("yields", [False, True])
def test_a_task_that_yields_has_a_lower_priority(qtbot, yields):
    own = os.getpriority(os.PRIO_PROCESS, threading.get_native_id())
    task = Task("smoother", lambda task: os.getpriority(os.PRIO_PROCESS, threading.get_native_id()), yields=yields)
    with qtbot.waitSignal(task.ended):
        task.start()
    assert (task.result > own) == (yields and own < 19)  # the lowest
    assert os.getpriority(os.PRIO_PROCESS, threading.get_native_id()) == own


# Cyclic garbage is collected in the thread of the window only.


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
