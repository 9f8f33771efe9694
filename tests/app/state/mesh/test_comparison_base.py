"""States with which the mesh is compared."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import METHODS, StoppingCriteria, iterate
from hexmend_app.picture.appearance import Since
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.mesh.history import History
from hexmend_app.state.mesh.run_record import RecordedIteration
from tests.app.driving import smooth
from tests.core.boundary.solids import slid
from tests.core.grids import grid, scrambled


@pytest.fixture
def session(hosted):
    return hosted(scrambled(grid(5), 0.4)).session


def run(qtbot, session):
    smooth(qtbot, session, "local-sd", 12)
    return session.run.record


def before(session, since):
    return session.comparison_bases.displacement(since).before


def test_the_reference_depends_on_the_iteration_that_is_shown(session, qtbot):
    document, timeline = session.document, session.timeline
    opened = document.now.mesh.points
    assert before(session, Since.ITERATION).points is opened
    first = run(qtbot, session)
    timeline.go(first, 4)
    second = run(qtbot, session)
    timeline.go(second, 5)
    assert before(session, Since.OPENED).points is opened
    assert before(session, Since.OPENED).name == "the file was opened"
    assert before(session, Since.RUN).points is second.points(0)
    assert before(session, Since.RUN).name == f"{second.name} started"
    np.testing.assert_array_equal(before(session, Since.ITERATION).points, second.points(4))
    assert before(session, Since.ITERATION).name == f"{second.name} 4"
    timeline.go(second, 1)
    assert before(session, Since.ITERATION).points is second.points(0)
    assert session.comparison_bases.displacement(Since.RUN) is session.comparison_bases.displacement(Since.RUN)


def test_if_the_previous_iteration_was_dropped_the_nearest_earlier_one_is_the_reference(session, qtbot):
    record = run(qtbot, session)
    session.history.set_limit(session.history.bytes // 3)
    numbers = session.history.recorded_numbers(record).tolist()
    earlier, at = next((m, n) for m, n in pairwise(numbers) if n - m > 1)
    session.timeline.go(record, at)
    name = f"{record.name} {earlier}" if earlier else f"{record.name} started"
    assert before(session, Since.ITERATION).name == name
    assert session.comparison_bases.displacement(Since.ITERATION).counts.moved > 0


# History of runs: all rows, and positions up to a memory limit.


MESH = scrambled(grid(5), 0.4)
SLANTED = slid(grid(4), 0.3, seed=3)
FREE = 12 * int(MESH.free.sum())  # bytes of an iteration


def recorded(history, iterations=20, start=None):
    """Run and record local-sd; return the record, the run and its iterations."""
    start = start or MeasuredMesh.of(MESH)
    record = history.begin("Local steepest descent", start)
    run = iterate(start.mesh, "local-sd", StoppingCriteria(max_iterations=iterations, tolerance=0))
    history.add(record, run.start)
    seen = [run.start]
    for iteration in run:
        history.add(record, iteration)
        seen.append(iteration)
    return record, run, seen


def test_every_iteration_is_recorded():
    history = History()
    record, run, seen = recorded(history)
    assert [row["iteration"] for row in record.rows] == list(range(21))
    assert [row["q_min"] for row in record.rows] == [row["q_min"] for row in run.history]
    assert history.recorded_numbers(record).tolist() == list(range(21))
    assert history.bytes == 20 * FREE
    for iteration in seen:
        state = history.state(RecordedIteration(record, iteration.number), MESH)
        largest = np.abs(iteration.points - MESH.points).max()
        np.testing.assert_allclose(state.mesh.points, iteration.points, rtol=0, atol=largest * 1.2e-7)
        np.testing.assert_array_equal(state.mesh.points[~MESH.free], MESH.points[~MESH.free])
        assert history.iteration_of(state) == RecordedIteration(record, iteration.number)


def test_a_sliding_boundary_is_recorded_at_every_iteration():
    history = History()
    boundary = SLANTED.topology.boundary
    record = history.begin("Mend", MeasuredMesh.of(SLANTED))
    run = iterate(SLANTED, METHODS["local-sd"](boundary="slide"), StoppingCriteria(max_iterations=5, tolerance=0))
    seen = [run.start, *run]
    for iteration in seen:
        history.add(record, iteration)
    assert (seen[1].points != SLANTED.points)[boundary].any()
    for iteration in seen:
        state = history.state(RecordedIteration(record, iteration.number), SLANTED)
        np.testing.assert_allclose(state.mesh.points, iteration.points, rtol=0, atol=1e-6)


def test_the_limit_holds_for_runs_that_are_recorded_at_the_same_time():
    history = History(6 * FREE)
    first, _, _ = recorded(history, 0)
    second, _, _ = recorded(history, 0)
    for iteration in iterate(MESH, "local-sd", StoppingCriteria(max_iterations=20, tolerance=0)):
        for record in (first, second):
            history.add(record, iteration)
            assert history.bytes <= history.limit
    for record in (first, second):
        assert {0, 20} <= set(history.recorded_numbers(record).tolist())


def test_a_result_is_exact():
    history = History()
    record, run, _ = recorded(history)
    end = MeasuredMesh.of(run.result().mesh)
    history.finish(record, RecordedIteration(record, 20), end, "Done.")
    assert history.state(RecordedIteration(record, 20), end.mesh) is end
    assert history.state(RecordedIteration(record, 0), MESH) is record.start


@given(count=st.integers(1, 25))
def test_positions_meet_the_limit_and_the_first_and_last_stay(count):
    history = History(count * FREE)
    record, _, _ = recorded(history, 24)
    numbers = history.recorded_numbers(record)
    assert history.bytes == FREE * (len(numbers) - 1) <= history.limit
    assert len(numbers) == 1 + min(count, 24)
    assert (numbers[0], numbers[-1]) == (0, 24)
    assert len(record.rows) == 25


def test_a_lower_limit_drops_positions_at_once_and_the_nearest_is_shown():
    history = History()
    record, _, _ = recorded(history)
    history.set_limit(4 * FREE)
    numbers = history.recorded_numbers(record)
    assert len(numbers) == 5
    dropped = next(n for n in range(20) if n not in numbers)
    iteration = history.iteration_of(history.state(RecordedIteration(record, dropped), MESH))
    assert iteration.number in numbers
    assert abs(iteration.number - dropped) == np.abs(numbers - dropped).min()


def test_a_branch_has_its_parent_and_a_unique_name():
    history = History()
    first, _, _ = recorded(history)
    middle = history.state(RecordedIteration(first, 7), MESH)
    second, _, _ = recorded(history, 3, middle)
    assert second.parent == RecordedIteration(first, 7)
    assert [first.name, second.name] == ["Local steepest descent", "Local steepest descent (2)"]
    assert RecordedIteration(second, 3).name == "Local steepest descent (2) 3"
    history.remove(first)
    assert history.records == [second]
    assert history.bytes == 3 * FREE


def test_nodes_pinned_after_a_run_are_pinned_in_its_iterations():
    history = History()
    record, _, _ = recorded(history)
    pinned = MESH.topology.boundary.copy()
    pinned[np.flatnonzero(MESH.free)[:5]] = True
    now = MESH.replace(pinned=pinned)
    for number in (0, 10, 20):
        state = history.state(RecordedIteration(record, number), now)
        np.testing.assert_array_equal(state.mesh.pinned, pinned)
        assert state.summary.free_nodes == int(now.free.sum())


@pytest.mark.parametrize("added", [0, 1])
def test_a_run_without_iterations_is_removed(added):
    history = History()
    record, run, _ = recorded(history, added)
    result = RecordedIteration(record, added) if added else None
    history.finish(record, result, MeasuredMesh.of(run.result().mesh) if added else None, "Stopped.")
    assert history.records == [record] * added


@pytest.mark.parametrize("number", [0, 7, 20])
def test_tagging_and_pinning_do_not_change_the_iteration_of_a_state(number):
    history = History()
    record, run, _ = recorded(history)
    history.finish(record, RecordedIteration(record, 20), MeasuredMesh.of(run.result().mesh), "Done.")
    shown = history.state(RecordedIteration(record, number), MESH)
    for change in ({"hex_sets": {"tagged": np.array([3])}}, {"pinned": MESH.topology.boundary.copy()}):
        changed = MeasuredMesh.of(shown.mesh.replace(**change))
        assert history.iteration_of(changed) == RecordedIteration(record, number)
        shown = changed  # the state before is deleted
    assert history.begin("Mend", shown).parent == RecordedIteration(record, number)
    assert history.iteration_of(MeasuredMesh.of(scrambled(grid(5), 0.3))) is None
