"""Threads that compute give way to the window."""

from __future__ import annotations

import os
import sys

import pytest

from hexmend.kernels import set_threads, threads
from hexmend_app.state.tasks.thread_priority import lower_priority


@pytest.fixture
def priorities(monkeypatch):
    """What the system is asked for, which it is not given."""
    asked = []
    monkeypatch.setattr(os, "setpriority", lambda *values: asked.append(values), raising=False)
    before = threads()
    yield asked
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
