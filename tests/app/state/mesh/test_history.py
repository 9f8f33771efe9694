"""What is kept of runs: every figure, and positions under a limit."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.run import StoppingCriteria, iterate
from hexmend.smoothers import METHODS
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.history import History, RecordedIteration
from tests.core.boundary.solids import slid
from tests.core.grids import grid, scrambled

MESH = scrambled(grid(5), 0.4)
SLANTED = slid(grid(4), 0.3, seed=3)
FREE = 12 * int(MESH.free.sum())  # bytes of an iteration


def recorded(history, iterations=20, start=None):
    """A run of local-sd, kept; the record and the iterations as they were."""
    start = start or State.of(MESH)
    record = history.begin("Local steepest descent", start)
    run = iterate(start.mesh, "local-sd", StoppingCriteria(max_iterations=iterations, tolerance=0))
    history.add(record, run.start)
    seen = [run.start]
    for iteration in run:
        history.add(record, iteration)
        seen.append(iteration)
    return record, run, seen


def test_every_iteration_is_there_as_it_was():
    history = History()
    record, run, seen = recorded(history)
    assert [row["iteration"] for row in record.rows] == list(range(21))
    assert [row["q_min"] for row in record.rows] == [row["q_min"] for row in run.history]
    assert history.kept(record).tolist() == list(range(21))
    assert history.bytes == 20 * FREE
    for iteration in seen:
        state = history.state(RecordedIteration(record, iteration.number), MESH)
        way = np.abs(iteration.points - MESH.points).max()
        np.testing.assert_allclose(state.mesh.points, iteration.points, rtol=0, atol=way * 1.2e-7)
        np.testing.assert_array_equal(state.mesh.points[~MESH.free], MESH.points[~MESH.free])
        assert history.moment_of(state) == RecordedIteration(record, iteration.number)


def test_a_boundary_that_slides_is_there_at_every_iteration():
    history = History()
    boundary = SLANTED.topology.boundary
    record = history.begin("Mend", State.of(SLANTED))
    run = iterate(SLANTED, METHODS["local-sd"](boundary="slide"), StoppingCriteria(max_iterations=5, tolerance=0))
    seen = [run.start, *run]
    for iteration in seen:
        history.add(record, iteration)
    assert (seen[1].points != SLANTED.points)[boundary].any()
    for iteration in seen:
        state = history.state(RecordedIteration(record, iteration.number), SLANTED)
        np.testing.assert_allclose(state.mesh.points, iteration.points, rtol=0, atol=1e-6)


def test_a_result_is_exact():
    history = History()
    record, run, _ = recorded(history)
    end = State.of(run.result().mesh)
    history.finish(record, RecordedIteration(record, 20), end, "Done.")
    assert history.state(RecordedIteration(record, 20), end.mesh) is end
    assert history.state(RecordedIteration(record, 0), MESH) is record.start


def test_of_a_run_that_was_removed_nothing_more_is_kept():
    history = History()
    record, _, seen = recorded(history)
    history.clear()
    history.add(record, seen[-1])
    assert history.bytes == 0
    assert len(record.rows) == len(seen)


@given(kept=st.integers(1, 25))
def test_positions_fit_the_limit_and_the_ends_stay(kept):
    history = History(kept * FREE)
    record, _, _ = recorded(history, 24)
    numbers = history.kept(record)
    assert history.bytes == FREE * (len(numbers) - 1) <= history.limit
    assert len(numbers) == 1 + min(kept, 24)
    assert (numbers[0], numbers[-1]) == (0, 24)
    assert len(record.rows) == 25


def test_the_older_the_further_apart():
    history = History(30 * FREE)
    record, _, _ = recorded(history, 300)
    gaps = np.diff(history.kept(record))
    assert gaps[-10:].max() <= 3
    assert gaps.sum() == 300
    early, late = gaps[: len(gaps) // 2].mean(), gaps[len(gaps) // 2 :].mean()
    assert early > 4 * late


def test_a_lower_limit_thins_at_once_and_the_nearest_is_shown():
    history = History()
    record, _, _ = recorded(history)
    history.limit = 4 * FREE
    numbers = history.kept(record)
    assert len(numbers) == 5
    gone = next(n for n in range(20) if n not in numbers)
    moment = history.moment_of(history.state(RecordedIteration(record, gone), MESH))
    assert moment.number in numbers
    assert abs(moment.number - gone) == np.abs(numbers - gone).min()


def test_a_run_knows_what_it_branched_from_and_has_a_name_of_its_own():
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


def test_what_is_pinned_since_stays_pinned():
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
def test_a_run_without_iterations_is_not_kept(added):
    history = History()
    record, run, _ = recorded(history, added)
    result = RecordedIteration(record, added) if added else None
    history.finish(record, result, State.of(run.result().mesh) if added else None, "Stopped.")
    assert history.records == [record] * added


@pytest.mark.parametrize("number", [0, 7, 20])
def test_what_is_tagged_or_pinned_since_is_of_the_same_iteration(number):
    history = History()
    record, run, _ = recorded(history)
    history.finish(record, RecordedIteration(record, 20), State.of(run.result().mesh), "Done.")
    shown = history.state(RecordedIteration(record, number), MESH)
    for change in ({"hex_sets": {"tagged": np.array([3])}}, {"pinned": MESH.topology.boundary.copy()}):
        changed = State.of(shown.mesh.replace(**change))
        assert history.moment_of(changed) == RecordedIteration(record, number)
        shown = changed  # and the one before is gone
    assert history.begin("Mend", shown).parent == RecordedIteration(record, number)
    assert history.moment_of(State.of(scrambled(grid(5), 0.3))) is None
