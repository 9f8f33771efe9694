"""What a run pauses at."""

import dataclasses
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from hexmend import Iteration, Laplacian, StoppingCriteria, gallery, iterate, measure
from hexmend_app.state.mesh.document import State
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.run_controller import Phase
from tests.core.grids import grid, scrambled

MESH = gallery.make("bridge-sharp", size=864)  # Laplacian inverts hexes of it


def iteration(number, points, **diagnostics):
    return Iteration(number, points, measure(points, MESH.hexes), 0.0, 0.0, diagnostics)


@pytest.fixture(scope="module")
def run():
    run = iterate(MESH, "laplacian", StoppingCriteria(max_iterations=15, tolerance=0))
    return [run.start, *run]


def test_an_element_that_inverts_is_named(run):
    for before, now in pairwise(run):
        hit = Breakpoints(inverts=True).hit(before, now, 1.0)
        expected = np.flatnonzero(now.quality.inverted & ~before.quality.inverted)
        assert (hit is not None) == bool(len(expected))
        if hit is not None:
            assert hit.hexes == tuple(expected)
    assert run[-1].quality.n_inverted > 0


def test_q_min_falling_is_told_with_its_element(run):
    before, now = run[0], next(one for one in run if one.quality.q.min() < run[0].quality.q.min())
    hit = Breakpoints(q_min_falls=True).hit(before, now, 1.0)
    assert hit.hexes == (int(now.quality.q.argmin()),)
    assert Breakpoints(q_min_falls=True).hit(now, before, 1.0) is None


def test_moves_and_changes_are_measured_against_what_is_asked(run):
    before, now = run[:2]
    moves = np.linalg.norm(now.points - before.points, axis=1)
    node = int(moves.argmax())
    unit = MESH.mean_edge_length
    assert Breakpoints(node=node, move=moves[node] / unit * 0.99).hit(before, now, unit).nodes == (node,)
    assert Breakpoints(node=node, move=moves[node] / unit * 1.01).hit(before, now, unit) is None
    changes = np.abs(now.quality.q - before.quality.q)
    hex = int(changes.argmax())
    assert Breakpoints(hex=hex, change=changes[hex] * 0.99).hit(before, now, unit).hexes == (hex,)
    assert Breakpoints(hex=hex, change=changes[hex] * 1.01).hit(before, now, unit) is None


def test_cuts_of_the_line_search():
    still, cut = iteration(1, MESH.points), iteration(2, MESH.points, backtracks=5, step_length=0.17)
    assert Breakpoints(backtracks=5).hit(still, cut, 1.0) is None
    assert "5 times, to 0.17" in Breakpoints(backtracks=4).hit(still, cut, 1.0).sentence
    assert Breakpoints(backtracks=0).hit(cut, still, 1.0) is None


def test_how_many_elements_inverted_is_said(run):
    def said(*hexes):
        sigma = np.ones(MESH.n_hexes)
        sigma[list(hexes)] = 0.0
        quality = dataclasses.replace(run[0].quality, sigma=sigma)
        return Breakpoints(inverts=True).hit(run[0], dataclasses.replace(run[1], quality=quality), 1.0).sentence

    assert said(4) == "Hex 4 inverted"
    assert said(4, 9) == "Hex 4 and 1 more inverted"
    assert said(4, 9, 12) == "Hex 4 and 2 more inverted"


# Pausing of runs at breakpoints.


@pytest.fixture
def session(hosted):
    return hosted(MESH).session


def test_a_run_pauses_exactly_at_the_iteration_of_a_breakpoint(session, run, qtbot):
    smoothing = session.run
    smoothing.break_at(Breakpoints(inverts=True))
    pauses = [b.number for a, b in pairwise(run) if Breakpoints(inverts=True).hit(a, b, 1.0)]
    with qtbot.waitSignal(smoothing.hit) as hit:
        smoothing.start(Laplacian(), StoppingCriteria(max_iterations=15, tolerance=0))
    assert hit.args[0].iteration.number == pauses[0]
    qtbot.waitUntil(lambda: smoothing.phase is Phase.PAUSED)
    assert smoothing.record.newest == pauses[0] == session.timeline.shown_iteration.number
    for number in pauses[1:3]:
        with qtbot.waitSignal(smoothing.hit) as hit:
            smoothing.resume()
        assert hit.args[0].iteration.number == number
    assert list(smoothing.record.pauses) == pauses[:3]
    smoothing.break_at(Breakpoints())
    with qtbot.waitSignal(smoothing.ended):
        smoothing.resume()
    assert smoothing.record.newest == 15


def test_breakpoints_can_be_set_during_a_run(session, qtbot):
    session.document.replace(State.of(scrambled(grid(6), 0.4)), Path("b.vtu"))
    session.run.start(Laplacian(), StoppingCriteria(max_iterations=10**6, tolerance=0))
    qtbot.waitUntil(lambda: session.run.phase is Phase.RUNNING)
    node = int(np.flatnonzero(session.document.now.mesh.free)[0])
    with qtbot.waitSignal(session.run.hit):
        session.run.break_at(Breakpoints(hex=0, change=-1.0, node=node))
