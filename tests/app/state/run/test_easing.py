"""Short runs are shown eased; their result is recorded at once, and shown at once for whoever asks."""

from itertools import count

import numpy as np
import pytest

from hexmend.run import StoppingCriteria
from hexmend.smoothers.local.steepest_descent import LocalSteepestDescent
from hexmend_app.state.mesh.history import History
from hexmend_app.state.run import eased_view
from hexmend_app.state.run.pace import Pace
from hexmend_app.state.run.run_controller import Phase, RunController

TEN = StoppingCriteria(max_iterations=10, tolerance=0)


@pytest.fixture(autouse=True)
def clock(monkeypatch):
    """Let 50 ms pass from one look at the clock to the next, however long the machine takes."""
    looks = count()
    monkeypatch.setattr(eased_view, "perf_counter", lambda: 0.05 * next(looks))


@pytest.fixture
def run(document):
    run = RunController(document, History())
    run.set_pace(Pace.EASED)
    yield run
    run.close()


def run_and_wait(qtbot, run, stop=TEN, smoother=None):
    with qtbot.waitSignal(run.ended):
        run.start(smoother or LocalSteepestDescent(), stop)


def test_the_result_is_recorded_at_once_and_shown_after_all_between(document, run, qtbot):
    shown = []
    document.points_moved.connect(lambda: shown.append(document.now))
    run_and_wait(qtbot, run)
    assert run.phase is Phase.FINISHED
    assert run.view.eased.active
    result = document.recorded
    assert document.undo_title == "Local steepest descent"
    assert document.now is not result
    qtbot.waitUntil(lambda: not run.view.eased.active)
    assert document.now is result
    assert len(shown) > 10
    before, after = document.start.mesh.points, result.mesh.points
    among = [state.mesh.points for state in shown[:-1]]
    assert all(not np.array_equal(points, after) for points in among)
    distances = [np.linalg.norm(points - before) for points in among]
    assert min(distances) < 0.2 * np.linalg.norm(after - before)


def test_states_between_are_on_straight_lines_and_name_the_nearest_iteration(document, run, qtbot):
    run_and_wait(qtbot, run)
    run.view.skip_easing()
    history, record, mesh = run.history, run.record, document.now.mesh
    a, b = (history.state_between(record, at, mesh).mesh.points for at in (3, 4))
    between = history.state_between(record, 3.25, mesh)
    np.testing.assert_allclose(between.mesh.points, 0.75 * a + 0.25 * b, atol=1e-12)
    assert history.iteration_of(between).number == 3
    np.testing.assert_array_equal(history.state_between(record, 99, mesh).mesh.points, document.now.mesh.points)
    np.testing.assert_array_equal(history.state_between(record, 0, mesh).mesh.points, document.start.mesh.points)


@pytest.mark.parametrize(
    "act",
    [
        lambda document, run: run.view.skip_easing(),
        lambda document, run: run.set_pace(Pace.FASTEST),
        lambda document, run: run.end(lambda: None),
        lambda document, run: run.start(LocalSteepestDescent(), TEN, iterations=0),
    ],
)
def test_the_result_is_there_for_who_goes_on(document, run, qtbot, act):
    run_and_wait(qtbot, run)
    result = document.recorded
    act(document, run)
    assert not run.view.eased.active
    assert document.now is result


def test_steps_and_large_meshes_are_shown_as_they_are(document, run, qtbot, monkeypatch):
    run.start(LocalSteepestDescent(), TEN, iterations=2)
    assert not run.view.eased.active
    qtbot.waitUntil(lambda: run.phase is Phase.PAUSED)
    run.stop()
    qtbot.waitUntil(lambda: not run.busy)
    monkeypatch.setattr(eased_view, "LIMIT", 10)
    run_and_wait(qtbot, run)
    assert not run.view.eased.active
    assert document.now is document.recorded


def test_a_run_stopped_while_it_prepares_leaves_the_mesh_alone(document, run, qtbot):
    start = document.now
    with qtbot.waitSignal(run.ended):
        run.start(LocalSteepestDescent(), TEN)
        run.stop()
    run.view.skip_easing()
    assert document.now is document.recorded
    assert (document.now is start) == (run.record.newest < 1)
