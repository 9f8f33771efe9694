"""Runs in the worker thread, without a window."""

from pathlib import Path

import numpy as np
import pytest

from hexmend import LocalSteepestDescent, Smoother, Step, StoppingCriteria, smooth
from hexmend_app.state.mesh import metric_cache
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.history import History
from hexmend_app.state.run import worker
from hexmend_app.state.run.run_controller import Phase, RunController
from hexmend_app.state.run.run_settings import Pace
from hexmend_app.state.tasks.task import Task, running, wait_for_dropped
from tests.app.driving import turn
from tests.core.grids import grid

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


@pytest.mark.parametrize("pace", list(Pace))
def test_every_iteration_is_shown_where_that_is_asked_for(document, smoothing, qtbot, pace):
    seen = []
    smoothing.iterated.connect(lambda frame: seen.append(frame.iteration.number))
    smoothing.set_pace(pace)
    with qtbot.waitSignal(smoothing.ended) as ended:
        smoothing.start(LocalSteepestDescent(), StoppingCriteria(max_iterations=12, tolerance=0))
    numbers = sorted(set(seen))
    if pace is Pace.EVERY:
        assert numbers == list(range(1, 13))
    assert ended.args[0].iterations == 12


def test_a_run_that_waits_to_be_shown_can_be_closed_and_let_go_on(document, smoothing, qtbot):
    smoothing.set_pace(Pace.EVERY)
    smoothing.start(LocalSteepestDescent(), SLOW)
    qtbot.waitUntil(lambda: smoothing.record.newest > 2)
    smoothing.set_pace(Pace.FASTEST)
    before = smoothing.record.newest
    qtbot.waitUntil(lambda: smoothing.record.newest > before + 5)
    smoothing.set_pace(Pace.EVERY)
    smoothing.close()
    wait_for_dropped()
    assert not running()


def test_a_slow_start_shows_an_iteration_for_a_moment_and_can_be_closed(document, smoothing, qtbot, monkeypatch):
    monkeypatch.setattr(worker, "_SHOWN", 1e4)  # seconds
    smoothing.set_pace(Pace.SLOW_START)
    with qtbot.waitSignal(smoothing.iterated):
        smoothing.start(LocalSteepestDescent(), SLOW)
    assert smoothing.record.newest == 1
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
        document.replace(State.of(grid(2)), Path("b.vtu"))
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
    frames = []
    smoothing.iterated.connect(frames.append)
    smoothing.request_metrics({"condition"})
    smoothing.start(LocalSteepestDescent(), StoppingCriteria(), iterations=1)
    qtbot.waitUntil(lambda: len(frames) == 1)
    assert "condition" in metric_cache.CACHE[frames[0].state.figures]
    assert smoothing.record.name == "Local steepest descent"
    smoothing.request_metrics({"taper", "q"})  # during a run
    smoothing.step()
    qtbot.waitUntil(lambda: len(frames) == 2)
    assert set(metric_cache.CACHE[frames[1].state.figures]) == {"taper", "q"}


def test_stop_takes_effect_within_one_iteration(document, smoothing, qtbot):
    smoothing.start(LocalSteepestDescent(), SLOW)
    qtbot.waitUntil(lambda: smoothing.record is not None and smoothing.record.newest > 3)
    with qtbot.waitSignal(smoothing.ended):
        smoothing.stop()
        newest = smoothing.record.newest
    assert smoothing.record.newest <= newest + 1
