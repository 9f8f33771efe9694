"""Work in threads: where it is reported, how it is called off, what is left running."""

from __future__ import annotations

import gc
import os
import threading
import weakref

import pytest

from hexmend_app.state.tasks.task import Task, running
from tests.patience import PATIENCE


@pytest.fixture
def gate():
    """An event that a thread waits for; set at the end, so that a failing test leaves none waiting."""
    gate = threading.Event()
    yield gate
    gate.set()


def test_the_result_comes_to_the_thread_that_asked_whoever_listens(qtbot):
    worked, heard = [], []
    task = Task("reading a test", lambda task: worked.append(threading.get_ident()) or 42)
    task.ended.connect(lambda: heard.append(threading.get_ident()))
    task.start()
    qtbot.waitUntil(lambda: heard != [], timeout=PATIENCE)
    assert heard == [threading.get_ident()]
    assert worked != heard
    assert (task.result, task.error) == (42, None)
    assert task.over


def test_what_is_told_comes_first_and_in_order(qtbot):
    heard = []

    def work(task):
        for word in ("one", "two"):
            task.tell(word)

    task = Task("reading a test", work)
    task.reported.connect(heard.append)
    task.ended.connect(lambda: heard.append("end"))
    task.start()
    qtbot.waitUntil(lambda: heard[-1:] == ["end"], timeout=PATIENCE)
    assert heard == ["one", "two", "end"]


@pytest.mark.parametrize("error", [ValueError("no"), SystemExit(1)])
def test_whatever_is_raised_is_the_error(qtbot, error):
    def work(task):
        raise error

    task = Task("reading a test", work)
    with qtbot.waitSignal(task.ended, timeout=PATIENCE):
        task.start()
    assert task.error is error
    assert task.result is None


def test_a_thread_that_runs_is_seen_by_its_name(qtbot, gate):
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


def test_called_off_it_ends_early_and_says_so(qtbot):
    task = Task("reading a test", lambda task: task.cancelled.wait())
    with qtbot.waitSignal(task.ended, timeout=PATIENCE):
        task.start()
        task.cancel()
    assert task.result is True


def test_nothing_is_heard_of_what_was_dropped_or_waited_for(qtbot, gate):
    heard = []

    def work(task):
        gate.wait()
        task.tell("word")

    dropped, waited = Task("reading one", work), Task("reading another", work)
    for task in (dropped, waited):
        task.reported.connect(heard.append)
        task.ended.connect(lambda: heard.append("end"))
        task.start()
    dropped.drop()
    gate.set()
    waited.wait()
    last = Task("reading the last", lambda task: None)
    qtbot.waitUntil(lambda: dropped.over, timeout=PATIENCE)
    with qtbot.waitSignal(last.ended, timeout=PATIENCE):  # so that theirs would have come before
        last.start()
    assert heard == []


def test_a_task_that_nobody_keeps_lives_until_it_is_over(qtbot, gate):
    heard = []
    task = Task("reading a test", lambda task: gate.wait())
    task.ended.connect(lambda: heard.append("end"))
    task.start()
    known = weakref.ref(task)
    del task
    gc.collect()
    assert known() is not None
    gate.set()
    qtbot.waitUntil(lambda: heard == ["end"], timeout=PATIENCE)
    gc.collect()
    assert known() is None


@pytest.mark.skipif(not hasattr(os, "getpriority"), reason="the system knows no such priorities")
@pytest.mark.parametrize("yields", [False, True])
def test_it_lets_the_window_go_first_where_it_should(qtbot, yields):
    mine = os.getpriority(os.PRIO_PROCESS, threading.get_native_id())
    task = Task("smoother", lambda task: os.getpriority(os.PRIO_PROCESS, threading.get_native_id()), yields=yields)
    with qtbot.waitSignal(task.ended, timeout=PATIENCE):
        task.start()
    assert (task.result > mine) == yields
    assert os.getpriority(os.PRIO_PROCESS, threading.get_native_id()) == mine
