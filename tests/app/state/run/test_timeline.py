"""Timeline: stepping, playing and branching, also during a run."""

import numpy as np
import pytest

from hexmend import LocalSteepestDescent, StoppingCriteria
from hexmend import smooth as smoothed
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import smooth
from tests.core.grids import grid, scrambled

ENDLESS = StoppingCriteria(tolerance=0, max_iterations=1_000_000)


@pytest.fixture
def session(hosted):
    return hosted(scrambled(grid(6), 0.4)).session


def run(qtbot, session, method="local-sd", iterations=12):
    smooth(qtbot, session, method, iterations)
    return session.run.record


def test_no_iteration_is_lost_and_all_are_shown_in_order(session, qtbot):
    start = session.document.now.mesh
    record = run(qtbot, session, iterations=40)
    assert [row["iteration"] for row in record.rows] == list(range(41))
    shown = []
    session.timeline.moved.connect(lambda: shown.append(session.timeline.shown_iteration))
    session.timeline.go(record, 0)
    for _ in range(40):
        session.timeline.step(1)
    assert [iteration.number for iteration in shown] == list(range(41))
    expected = smoothed(start, LocalSteepestDescent(), StoppingCriteria(max_iterations=17, tolerance=0))
    session.timeline.go(record, 17)
    np.testing.assert_allclose(session.document.now.mesh.points, expected.mesh.points, atol=1e-7)


def test_a_run_is_one_undo_step_at_any_iteration(session, qtbot):
    record = run(qtbot, session)
    end = session.document.now
    session.timeline.go(record, 5)
    assert session.document.previews
    assert session.document.undo_title == "Local steepest descent"
    session.document.undo()
    assert session.document.now is session.document.start
    assert session.timeline.shown_iteration.number == 0
    session.document.redo()
    assert session.document.now is end
    assert session.timeline.shown_iteration.number == 12


def test_a_branch_starts_from_the_iteration_shown_and_is_one_undo_step(session, qtbot):
    first = run(qtbot, session)
    end = session.document.now
    session.timeline.go(first, 4)
    points = session.document.now.mesh.points
    second = run(qtbot, session, "laplacian", 3)
    assert second.parent.record is first
    assert second.parent.number == 4
    np.testing.assert_array_equal(second.points(0), points)
    assert session.timeline.record is second
    session.document.undo()
    assert session.document.now is end
    assert session.timeline.record is first


def test_earlier_iterations_can_be_shown_during_a_run(session, qtbot):
    timeline, smoothing = session.timeline, session.run
    smoothing.start(LocalSteepestDescent(), ENDLESS)
    qtbot.waitUntil(lambda: smoothing.record is not None and smoothing.record.newest > 20)
    timeline.go(smoothing.record, 3)
    assert not timeline.live
    newest = smoothing.record.newest
    qtbot.waitUntil(lambda: smoothing.record.newest > newest + 5)
    assert timeline.shown_iteration.number == 3
    timeline.go(smoothing.record, smoothing.record.newest)
    assert timeline.live
    qtbot.waitUntil(lambda: timeline.shown_iteration.number > newest)
    timeline.go(smoothing.record, 3)
    with qtbot.waitSignal(smoothing.ended):
        smoothing.stop()
    assert timeline.shown_iteration.number == 3  # the result is recorded but not shown, as the user views an iteration
    assert session.document.undo_title == "Local steepest descent"


def test_a_paused_run_resumes_from_its_newest_iteration(session, qtbot):
    timeline, smoothing = session.timeline, session.run
    smoothing.start(LocalSteepestDescent(), ENDLESS, iterations=8)
    qtbot.waitUntil(lambda: smoothing.phase is Phase.PAUSED)
    timeline.go(smoothing.record, 2)
    smoothing.step(4)
    qtbot.waitUntil(lambda: timeline.shown_iteration.number == 12)
    qtbot.waitUntil(lambda: smoothing.phase is Phase.PAUSED)


def test_playing_pauses_at_the_end(session, qtbot):
    record = run(qtbot, session)
    shown = []
    session.timeline.moved.connect(lambda: shown.append(session.timeline.shown_iteration.number))
    session.timeline.speed = 100
    session.timeline.play()
    assert session.timeline.playing
    qtbot.waitUntil(lambda: not session.timeline.playing)
    assert shown == list(range(13))
    session.timeline.go(record, 6)
    session.timeline.speed = 100
    session.timeline.play()
    session.timeline.step(-1)
    assert not session.timeline.playing
