"""Times of a case in the window: recorded like iterations, with their own boundary."""

import numpy as np
import pytest

from hexmend import Laplacian, StoppingCriteria, io, measure
from hexmend.io.formats.openfoam.foam_text import replaced_points
from hexmend_app.state.mesh.history import RecordedIteration
from hexmend_app.state.session.session import Session
from tests.core.grids import grid

TIMES = ("10", "0.002", "0.5")


def moved(points, time):
    """Return points that are sheared and stretched: the boundary moves."""
    return points @ np.array([[1 + time, 0, 0], [time, 1, 0], [0, 0, 1.0]])


@pytest.fixture
def case(tmp_path):
    """Folder of a case of 27 hexes with three times."""
    folder = tmp_path / "case"
    io.write(folder / "case.foam", grid(3))
    points = io.read(folder).points
    for time in TIMES:
        (folder / time / "polyMesh").mkdir(parents=True)
        content = replaced_points(folder / "constant/polyMesh/points", moved(points, float(time)))
        (folder / time / "polyMesh/points").write_bytes(content)
    (folder / "0.7").mkdir()  # results alone
    return folder


@pytest.fixture
def session(qapp):
    session = Session()
    yield session
    session.close()


def opened(qtbot, session, path):
    """Open a case, wait for its times, and return the errors of those left out."""
    with qtbot.waitSignal(session.time_reader.ended):
        session.commands.open(path)
    return session.time_reader.errors


@pytest.mark.parametrize("named", ["", "case.foam", "constant/polyMesh/points"])
def test_the_times_of_a_case_are_a_record_in_numeric_order(named, case, session, qtbot):
    constant = io.read(case).points
    assert opened(qtbot, session, case / named) == ()
    (record,) = session.history.records
    assert record is session.timeline.record
    assert record.labels() == ["constant", "t = 0.002", "t = 0.5", "t = 10"]
    np.testing.assert_array_equal(session.document.now.mesh.points, constant)
    assert not session.document.modified
    hexes = session.document.now.mesh.hexes
    for number, time in enumerate((0.0, 0.002, 0.5, 10.0)):
        expected = moved(constant, time)
        session.timeline.go(record, number)
        assert session.timeline.shown_iteration == RecordedIteration(record, number)
        np.testing.assert_allclose(session.document.now.mesh.points, expected, atol=1e-6 * max(time, 1))
        quality = measure(expected, hexes)
        row = record.rows[number]
        assert (row["seconds"], row["inverted"]) == (time, quality.n_inverted)
        assert row["q_min"] == pytest.approx(quality.q.min())


def test_times_of_other_meshes_and_damaged_files_are_left_out(case, session, qtbot):
    (case / "0.002/polyMesh/points").write_bytes(b"FoamFile { class vectorField; }\n64((0 0 0)")
    other = case / "other"
    io.write(other / "other.foam", grid(2))
    (case / "0.5/polyMesh/points").write_bytes((other / "constant/polyMesh/points").read_bytes())
    damaged, different = opened(qtbot, session, case)
    assert "t = 0.002" in damaged.problem
    assert "27 points, expected 64" in different.problem
    assert session.timeline.record.labels() == ["constant", "t = 10"]


def test_times_after_other_faces_are_left_out(case, session, qtbot):
    (case / "0.5/polyMesh/faces").write_bytes((case / "constant/polyMesh/faces").read_bytes())
    errors = opened(qtbot, session, case)
    assert [error.problem.split(":")[0] for error in errors] == ["t = 0.5", "t = 10"]
    assert session.timeline.record.labels() == ["constant", "t = 0.002"]


def test_a_run_from_a_time_slides_on_the_boundary_of_that_time(case, session, qtbot):
    opened(qtbot, session, case)
    times = session.timeline.record
    session.timeline.go(times, 2)
    shown = session.document.now.mesh
    assert shown.surface_points is shown.points
    with qtbot.waitSignal(session.run.ended):
        session.run.start(Laplacian(boundary="slide"), StoppingCriteria(max_iterations=3))
    run = session.run.record
    assert run.parent == RecordedIteration(times, 2)
    box = shown.points.min(axis=0), shown.points.max(axis=0)
    session.timeline.go(times, 0)
    session.timeline.go(run, 1)  # with the surface of its start, not of the time shown before
    now = session.document.now.mesh
    np.testing.assert_array_equal(now.surface_points, shown.points)
    np.testing.assert_allclose([now.points.min(axis=0), now.points.max(axis=0)], box, atol=1e-6)
    session.commands.reset()
    start = session.document.start.mesh
    assert session.document.now.mesh.surface_points is start.surface_points


def test_sessions_keep_the_times(case, session, qtbot, tmp_path):
    opened(qtbot, session, case)
    session.timeline.go(session.timeline.record, 1)
    with qtbot.waitSignal(session.saver.ended):
        session.commands.save_in_background(tmp_path / "a.hexmend")
    points = session.document.now.mesh.points
    other = Session()
    with qtbot.waitSignal(other.opener.ended):
        other.commands.open(tmp_path / "a.hexmend")
    assert not other.time_reader.busy
    (record,) = other.history.records
    assert record.labels() == session.timeline.record.labels()
    assert other.timeline.shown_iteration.number == 1
    np.testing.assert_array_equal(other.document.now.mesh.points, points)
    np.testing.assert_array_equal(other.document.now.mesh.surface_points, points)
    other.close()


def test_another_mesh_ends_the_reading(case, session, qtbot, tmp_path):
    io.write(tmp_path / "a.vtu", grid(2))
    session.commands.open(case)
    session.commands.open(tmp_path / "a.vtu")
    qtbot.waitUntil(lambda: session.document.name == "a.vtu")
    assert not session.time_reader.busy
    assert session.history.records == []
