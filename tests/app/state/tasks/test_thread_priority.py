"""Threads that compute have a lower priority than the window."""

from __future__ import annotations

import os
import sys

import pytest

from hexmend.kernels import set_threads, threads
from hexmend_app.state.tasks.thread_priority import lower_priority


@pytest.fixture
def priorities(monkeypatch):
    """Record the calls of `os.setpriority` instead of making them."""
    calls = []
    monkeypatch.setattr(os, "setpriority", lambda *values: calls.append(values), raising=False)
    before = threads()
    yield calls
    set_threads(before)


def test_a_thread_takes_a_lower_priority_on_linux(priorities, monkeypatch):
    monkeypatch.setattr(sys, "platform", "linux")
    lower_priority()
    assert len(priorities) == 1


@pytest.mark.parametrize("platform", ["darwin", "win32", "freebsd14"])
def test_a_thread_keeps_its_priority_where_its_number_is_not_that_of_a_process(priorities, monkeypatch, platform):
    monkeypatch.setattr(sys, "platform", platform)
    lower_priority()
    assert priorities == []
