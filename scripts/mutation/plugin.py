"""A plugin of pytest that runs chosen tests in a given order, and records what they do.

The variable MUTATION names a file in JSON: `folder`, the `sources` in it of which lines are recorded (or null), `tests`
to run, each with its seconds, in order (all, if null), and `report`, the file that is written.
"""

from __future__ import annotations

import json
import os
import resource
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import CodeType, FrameType

import pytest
from _pytest import config as pytest_config

#: Memory limit of a process in bytes: a fault may allocate without limit.
_MEMORY = 12 << 30
#: A test may take this many seconds of the processor, and this many times as long as without a fault; and so many
#: seconds of the clock, for one that waits.
_SECONDS, _TIMES, _WAITING = 20.0, 10.0, 300.0

_order = json.loads(Path(os.environ["MUTATION"]).read_text(encoding="utf-8"))
_report: dict[str, dict] = {}
_watched: dict[str, str | None] = {}
_seen: dict[CodeType, set[int]] = {}
_tracers: dict[CodeType, Callable] = {}


def pytest_configure() -> None:
    resource.setrlimit(resource.RLIMIT_DATA, (_MEMORY, _MEMORY))
    for number in (signal.SIGPROF, signal.SIGALRM):
        signal.signal(number, signal.SIG_DFL)


@pytest.hookimpl(tryfirst=True)
def pytest_collection() -> None:
    """Let Hypothesis stop at the first example that fails: nobody will read the simplest one."""
    hypothesis = sys.modules.get("hypothesis")
    if hypothesis is not None:
        phases = set(hypothesis.settings().phases) - {hypothesis.Phase.shrink, hypothesis.Phase.explain}
        hypothesis.settings.register_profile("mutation", hypothesis.settings(), phases=phases)
        hypothesis.settings.load_profile("mutation")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    if _order["tests"] is not None:
        places = {name: place for place, name in enumerate(_order["tests"])}
        items[:] = sorted((one for one in items if one.nodeid in places), key=lambda one: places[one.nodeid])


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Iterator[None]:
    """Run one test: the alarm ends the process where it takes too long, even within a kernel."""
    usual = (_order["tests"] or {}).get(item.nodeid, 60.0)
    _seen.clear()
    began = time.perf_counter()
    signal.setitimer(signal.ITIMER_PROF, _SECONDS + _TIMES * usual)
    signal.setitimer(signal.ITIMER_REAL, _WAITING + _TIMES * usual)
    if _order["sources"]:
        threading.settrace(_trace)
        sys.settrace(_trace)
    try:
        return (yield)
    finally:
        sys.settrace(None)
        threading.settrace(None)  # type: ignore[arg-type]
        for timer in (signal.ITIMER_PROF, signal.ITIMER_REAL):
            signal.setitimer(timer, 0)
        entry = _report.setdefault(item.nodeid, {})
        entry["seconds"] = round(time.perf_counter() - began, 3)
        entry["lines"] = _lines()


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    if report.outcome != "passed":
        _report.setdefault(report.nodeid, {})["outcome"] = report.outcome


@pytest.hookimpl(wrapper=True)
def pytest_load_initial_conftests(args: list[str]) -> Iterator[None]:
    """A `conftest.py` that cannot be imported has failed, too; pytest ends as if it had been called wrongly."""
    try:
        return (yield)
    except pytest_config.ConftestImportFailure as failure:
        Path(_order["report"]).write_text(json.dumps({str(failure.path): {"outcome": "failed"}}), encoding="utf-8")
        raise


def pytest_collectreport(report: pytest.CollectReport) -> None:
    """A file of tests that cannot be imported has failed: without a fault all can."""
    if report.outcome == "failed":
        _report.setdefault(report.nodeid, {})["outcome"] = report.outcome


def pytest_sessionfinish() -> None:
    Path(_order["report"]).write_text(json.dumps(_report), encoding="utf-8")


def _trace(frame: FrameType, event: str, value: object) -> Callable | None:
    code = frame.f_code
    if _path(code.co_filename) is None:
        return None
    lines = _seen.setdefault(code, set())
    lines.add(frame.f_lineno)
    if code not in _tracers:
        _tracers[code] = _tracer(code)
    return _tracers[code]


def _tracer(code: CodeType) -> Callable:
    def tracer(frame: FrameType, event: str, value: object) -> Callable:
        _seen.setdefault(code, set()).add(frame.f_lineno)
        return tracer

    return tracer


def _path(file: str) -> str | None:
    """The path of a watched source from the project's root; None for all others."""
    if file not in _watched:
        inside = os.path.relpath(file, _order["folder"]).replace(os.sep, "/")
        _watched[file] = inside if inside in _order["sources"] else None
    return _watched[file]


def _lines() -> dict[str, list[int]]:
    lines: dict[str, set[int]] = {}
    for code, seen in _seen.items():
        lines.setdefault(_path(code.co_filename), set()).update(seen)
    return {path: sorted(seen) for path, seen in lines.items()}
