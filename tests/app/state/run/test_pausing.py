"""Pausing of runs at breakpoints."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from hexmend import gallery
from hexmend.run import StoppingCriteria, iterate
from hexmend.smoothers.laplacian.laplacian import Laplacian
from hexmend_app.state.mesh.document import State
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.session.session import Session
from tests.core.grids import grid, scrambled
from tests.patience import PATIENCE

MESH = gallery.make("bridge-sharp", size=864)  # Laplacian smoothing inverts some of its hexes


@pytest.fixture(scope="module")
def run():
    run = iterate(MESH, "laplacian", StoppingCriteria(max_iterations=15, tolerance=0))
    return [run.start, *run]


@pytest.fixture
def session(qtbot):
    session = Session()
    session.document.replace(State.of(MESH), Path("a.vtu"))
    yield session
    session.close()


def test_a_run_pauses_exactly_at_the_iteration_of_a_breakpoint(session, run, qtbot):
    smoothing = session.run
    smoothing.break_at(Breakpoints(inverts=True))
    pauses = [b.number for a, b in pairwise(run) if Breakpoints(inverts=True).hit(a, b, 1.0)]
    with qtbot.waitSignal(smoothing.hit, timeout=PATIENCE) as hit:
        smoothing.start(Laplacian(), StoppingCriteria(max_iterations=15, tolerance=0))
    assert hit.args[0].iteration.number == pauses[0]
    qtbot.waitUntil(lambda: smoothing.phase is Phase.PAUSED, timeout=PATIENCE)
    assert smoothing.record.newest == pauses[0] == session.timeline.shown_iteration.number
    for number in pauses[1:3]:
        with qtbot.waitSignal(smoothing.hit, timeout=PATIENCE) as hit:
            smoothing.resume()
        assert hit.args[0].iteration.number == number
    assert list(smoothing.record.pauses) == pauses[:3]
    smoothing.break_at(Breakpoints())
    with qtbot.waitSignal(smoothing.ended, timeout=PATIENCE):
        smoothing.resume()
    assert smoothing.record.newest == 15


def test_breakpoints_can_be_set_during_a_run(session, qtbot):
    session.document.replace(State.of(scrambled(grid(6), 0.4)), Path("b.vtu"))
    session.run.start(Laplacian(), StoppingCriteria(max_iterations=10**6, tolerance=0))
    qtbot.waitUntil(lambda: session.run.phase is Phase.RUNNING, timeout=PATIENCE)
    node = int(np.flatnonzero(session.document.now.mesh.free)[0])
    with qtbot.waitSignal(session.run.hit, timeout=PATIENCE):
        session.run.break_at(Breakpoints(hex=0, change=-1.0, node=node))
