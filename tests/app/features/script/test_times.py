"""The script reads the times of a case again, and runs from one of them."""

import pytest

from hexmend import io
from hexmend.io.formats.openfoam.points import replaced_points
from hexmend_app.features.script.script import Script
from tests.app.features.script.recording import opened, run, same_again, stage
from tests.core.grids import grid, scrambled
from tests.patience import PATIENCE


@pytest.fixture
def case(tmp_path):
    """Folder of a case with two times."""
    folder = tmp_path / "case"
    io.write(folder / "case.foam", scrambled(grid(4), 0.3))
    points = io.read(folder).points
    for time in ("0.1", "0.7"):
        (folder / time / "polyMesh").mkdir(parents=True)
        content = replaced_points(folder / "constant/polyMesh/points", points * (1, 1, 1 + float(time)))
        (folder / time / "polyMesh/points").write_bytes(content)
    return folder


@pytest.mark.parametrize("boundary", ["fixed", "slide"])
@pytest.mark.parametrize("then", ["", "reset"])
def test_a_run_from_a_time_is_repeated(boundary, then, session, qtbot, case, tmp_path):
    opened(qtbot, session, case)
    qtbot.waitUntil(lambda: not session.time_reader.busy, timeout=PATIENCE)
    times = session.timeline.record
    session.timeline.go(times, 2)
    run(qtbot, session, stage("laplacian", boundary=boundary))
    if then:
        session.commands.reset()
        run(qtbot, session, stage("laplacian", boundary=boundary))
    else:
        session.timeline.go(session.run.record, 3)
    assert "recorded_times(" in same_again(session, tmp_path)


def test_a_script_that_begins_after_the_case_was_opened_reads_it(session, qtbot, case, tmp_path):
    opened(qtbot, session, case)
    qtbot.waitUntil(lambda: not session.time_reader.busy, timeout=PATIENCE)
    session.script = Script(session, session)
    session.timeline.go(session.timeline.record, 2)
    run(qtbot, session, stage("laplacian"))
    assert "recorded_times(" in same_again(session, tmp_path)


def test_a_time_that_is_saved_is_read_again(session, qtbot, case, tmp_path):
    opened(qtbot, session, case)
    qtbot.waitUntil(lambda: not session.time_reader.busy, timeout=PATIENCE)
    session.timeline.go(session.timeline.record, 1)
    assert "points = run_0.points(1)" in same_again(session, tmp_path)
