"""Runs in the worker thread, without a window."""

import dataclasses
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from hexmend import Iteration, Laplacian, Smoother, Step, StoppingCriteria, gallery, iterate, measure, smooth
from hexmend.smoothers.local.steepest_descent import LocalSteepestDescent
from hexmend_app.state.mesh import metric_cache
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.mesh.history import History
from hexmend_app.state.mesh.run_record import RecordedIteration
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.run_controller import Phase, RunController
from hexmend_app.state.tasks.task import Task, running, wait_for_dropped
from tests.app.driving import heard_from, turn
from tests.core.grids import grid, scrambled

SLOW = StoppingCriteria(tolerance=0, max_iterations=100_000)


class Failing(Smoother):
    """Method that raises in its second step."""

    name, title, help, source = "failing", "Failing", "Fails.", "test"

    def steps(self, mesh):
        yield Step(mesh.points)
        yield Step(mesh.points + 0.01 * mesh.free[:, None])
        raise ZeroDivisionError("one over nothing")


@pytest.fixture
def smoothing(document):
    smoothing = RunController(document, History())
    yield smoothing
    smoothing.close()


def phase_is(smoothing, phase):
    return lambda: smoothing.phase is phase


def test_a_run_has_the_result_of_the_command_line(document, smoothing, qtbot):
    expected = smooth(document.now.mesh, LocalSteepestDescent())
    with qtbot.waitSignal(smoothing.ended) as ended:
        smoothing.start(LocalSteepestDescent(), StoppingCriteria())
    (result,) = ended.args
    assert result.outcome is expected.outcome
    assert result.iterations == expected.iterations
    np.testing.assert_array_equal(document.now.mesh.points, expected.mesh.points)
    assert document.undo_title == "Local steepest descent"
    assert smoothing.phase is Phase.FINISHED
    document.undo()
    assert document.now is document.start


def test_every_iteration_is_shown_where_that_is_asked_for(document, smoothing, qtbot):
    seen = []
    smoothing.iterated.connect(lambda frame: seen.append(frame.iteration.number))
    smoothing.show_every(True)
    with qtbot.waitSignal(smoothing.ended) as ended:
        smoothing.start(LocalSteepestDescent(), StoppingCriteria(max_iterations=12, tolerance=0))
    assert sorted(set(seen)) == list(range(1, 13))
    assert ended.args[0].iterations == 12


def test_a_run_that_waits_to_be_shown_can_be_closed_and_let_go_on(document, smoothing, qtbot):
    smoothing.show_every(True)
    smoothing.start(LocalSteepestDescent(), SLOW)
    qtbot.waitUntil(lambda: smoothing.record.newest > 2)
    smoothing.show_every(False)
    before = smoothing.record.newest
    qtbot.waitUntil(lambda: smoothing.record.newest > before + 5)
    smoothing.show_every(True)
    smoothing.close()
    wait_for_dropped()
    assert not running()


def test_steps_are_single_iterations_and_resume_goes_on(document, smoothing, qtbot):
    seen = []
    smoothing.iterated.connect(lambda frame: seen.append(frame.iteration.number))
    smoothing.start(LocalSteepestDescent(), SLOW, iterations=1)
    qtbot.waitUntil(phase_is(smoothing, Phase.PAUSED))
    for count in (2, 3):
        smoothing.step()
        qtbot.waitUntil(lambda count=count: seen[-1:] == [count])
    qtbot.waitUntil(phase_is(smoothing, Phase.PAUSED))
    assert seen == [1, 2, 3]
    smoothing.resume()
    qtbot.waitUntil(lambda: seen[-1] > 6)
    smoothing.pause()
    qtbot.waitUntil(phase_is(smoothing, Phase.PAUSED))
    turn()  # signals that were queued when it paused
    last = seen[-1]
    smoothing.step()
    qtbot.waitUntil(lambda: seen[-1] > last)
    qtbot.waitUntil(phase_is(smoothing, Phase.PAUSED))
    assert seen[-1] == last + 1  # it went no further while it was paused
    assert seen == sorted(set(seen))


@pytest.mark.parametrize("iterations", [1, float("inf")])
def test_closing_leaves_no_thread(document, smoothing, qtbot, iterations):
    with qtbot.waitSignal(smoothing.iterated):
        smoothing.start(LocalSteepestDescent(), SLOW, iterations=iterations)
    smoothing.close()
    assert not smoothing.busy
    wait_for_dropped()
    assert running() == ()


def test_a_mesh_is_replaced_without_waiting_for_the_current_iteration(document, smoothing, qtbot, monkeypatch):
    with qtbot.waitSignal(smoothing.iterated):
        smoothing.start(LocalSteepestDescent(), SLOW)
    with monkeypatch.context() as patch:
        patch.setattr(Task, "join", lambda *_: pytest.fail("the window waits for the run"))
        document.replace(MeasuredMesh.of(grid(2)), Path("b.vtu"))
    assert smoothing.phase is Phase.IDLE
    wait_for_dropped()
    assert running() == ()


def test_a_method_that_raises_leaves_its_last_iteration_which_can_be_undone(document, smoothing, qtbot):
    before = document.now
    with qtbot.waitSignal(smoothing.failed) as failed:
        smoothing.start(Failing(), SLOW)
    assert isinstance(failed.args[0], ZeroDivisionError)
    assert smoothing.phase is Phase.IDLE
    assert smoothing.record.result == 1
    assert document.undo_title is not None
    document.undo()
    assert document.now is before


def test_requested_metrics_are_computed_by_the_worker(document, smoothing, qtbot):
    frames = heard_from(smoothing.iterated)
    smoothing.request_metrics({"condition"})
    smoothing.start(LocalSteepestDescent(), StoppingCriteria(), iterations=1)
    qtbot.waitUntil(lambda: len(frames) == 1)
    assert "condition" in metric_cache.CACHE[frames[0].state.quality]
    assert smoothing.record.name == "Local steepest descent"
    smoothing.request_metrics({"taper", "q"})  # during a run
    smoothing.step()
    qtbot.waitUntil(lambda: len(frames) == 2)
    assert set(metric_cache.CACHE[frames[1].state.quality]) == {"taper", "q"}


def test_stop_takes_effect_within_one_iteration(document, smoothing, qtbot):
    smoothing.start(LocalSteepestDescent(), SLOW)
    qtbot.waitUntil(lambda: smoothing.record is not None and smoothing.record.newest > 3)
    with qtbot.waitSignal(smoothing.ended):
        smoothing.stop()
        newest = smoothing.record.newest
    assert smoothing.record.newest <= newest + 1


def test_stop_keeps_an_earlier_iteration_that_is_shown(document, smoothing, qtbot):
    document.replace(MeasuredMesh.of(MESH), Path("bridge.vtu"))
    smoothing.start(Laplacian(), SLOW, iterations=12)
    qtbot.waitUntil(phase_is(smoothing, Phase.PAUSED))
    record = smoothing.record
    smoothing.follow(False)
    state = smoothing.history.state(RecordedIteration(record, 4), document.now.mesh)
    document.preview(state)
    with qtbot.waitSignal(smoothing.ended):
        smoothing.stop()
    assert record.result == 4
    assert document.recorded is document.now is state


def test_a_run_that_keeps_the_initial_mesh_changes_nothing(document, smoothing, qtbot):
    best = smooth(MESH, "laplacian", StoppingCriteria(max_iterations=12, tolerance=0)).mesh
    document.replace(MeasuredMesh.of(best), Path("a.vtu"))
    with qtbot.waitSignal(smoothing.ended):
        smoothing.start(Laplacian(), StoppingCriteria(max_iterations=12, tolerance=0))
    assert smoothing.record.result == 0
    assert not document.modified


# What a run pauses at.


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
    smoothing.set_breakpoints(Breakpoints(inverts=True))
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
    smoothing.set_breakpoints(Breakpoints())
    with qtbot.waitSignal(smoothing.ended):
        smoothing.resume()
    assert smoothing.record.newest == 15


def test_breakpoints_can_be_set_during_a_run(session, qtbot):
    session.document.replace(MeasuredMesh.of(scrambled(grid(6), 0.4)), Path("b.vtu"))
    session.run.start(Laplacian(), StoppingCriteria(max_iterations=10**6, tolerance=0))
    qtbot.waitUntil(lambda: session.run.phase is Phase.RUNNING)
    node = int(np.flatnonzero(session.document.now.mesh.free)[0])
    with qtbot.waitSignal(session.run.hit):
        session.run.set_breakpoints(Breakpoints(node=node, move=0.0))
