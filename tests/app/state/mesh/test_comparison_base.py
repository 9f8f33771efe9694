"""States with which the mesh is compared."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from hexmend.run import StoppingCriteria
from hexmend.smoothers.local.steepest_descent import LocalSteepestDescent
from hexmend_app.picture.appearance import Since
from hexmend_app.state.mesh.document import State
from hexmend_app.state.session.session import Session
from tests.core.grids import grid, scrambled
from tests.patience import PATIENCE


@pytest.fixture
def session(qtbot):
    session = Session()
    session.document.replace(State.of(scrambled(grid(5), 0.4)), Path("a.vtu"))
    yield session
    session.close()


def run(qtbot, session):
    with qtbot.waitSignal(session.run.ended, timeout=PATIENCE):
        session.run.start(LocalSteepestDescent(), StoppingCriteria(max_iterations=12, tolerance=0))
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
    session.history.limit = session.history.bytes // 3
    numbers = session.history.recorded_numbers(record).tolist()
    earlier, at = next((m, n) for m, n in pairwise(numbers) if n - m > 1)
    session.timeline.go(record, at)
    name = f"{record.name} {earlier}" if earlier else f"{record.name} started"
    assert before(session, Since.ITERATION).name == name
    assert session.comparison_bases.displacement(Since.ITERATION).counts.moved > 0
