"""Times of a case in the window: recorded like iterations, with their own boundary."""

import numpy as np
import pytest

from hexmend import Laplacian, StoppingCriteria, io, measure
from hexmend.boundary import NodeClass, boundary_of
from hexmend.io.formats.openfoam.foam_text import replaced_points
from hexmend_app.state.mesh.document import Document
from hexmend_app.state.mesh.run_record import RecordedIteration
from hexmend_app.state.session.session import Session
from hexmend_app.state.tasks.boundary_classifier import (
    LEFT,
    PIN,
    WHISKER,
    BoundaryClassifier,
    classify_boundary,
    node_classes,
)
from tests.core.boundary.solids import ball, slid
from tests.core.grids import displaced, grid

TIMES = ("10", "0.002", "0.5")


def moved(points, time):
    """Return points that are sheared and stretched: the boundary moves."""
    return points @ np.array([[1 + time, 0, 0], [time, 1, 0], [0, 0, 1.0]])


def write_case(folder):
    """Write a case of 27 hexes with three times."""
    io.write(folder / "case.foam", grid(3))
    points = io.read(folder).points
    for time in TIMES:
        (folder / time / "polyMesh").mkdir(parents=True)
        content = replaced_points(folder / "constant/polyMesh/points", moved(points, float(time)))
        (folder / time / "polyMesh/points").write_bytes(content)
    (folder / "0.7").mkdir()  # results alone


@pytest.fixture
def case(tmp_path):
    """Folder of a case of 27 hexes with three times."""
    write_case(tmp_path / "case")
    return tmp_path / "case"


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


# Classification of the nodes of a boundary in the background.


MESH = grid(4)
FIGURES = measure(MESH.points, MESH.hexes)


@pytest.fixture
def classifier(qapp):
    classifier = BoundaryClassifier(Document())
    yield classifier
    classifier.close()


def creased():
    """Return a block with a crease across part of its top."""
    mesh = grid(8)
    x, y, z = mesh.points.T
    return displaced(mesh, np.s_[(z == 8) & (x == 4) & (np.abs(y - 4) <= 1), 2], 1)


def test_without_whiskers_the_classes_are_those_of_the_core():
    np.testing.assert_array_equal(node_classes(MESH, 40.0), boundary_of(MESH).node_class)
    assert np.bincount(node_classes(ball(3), 40.0)).tolist() == np.bincount(boundary_of(ball(3)).node_class).tolist()


def test_sharp_edges_that_are_left_out_are_whiskers():
    mesh = creased()
    kinds = node_classes(mesh, 40.0)
    assert (kinds == WHISKER).any()
    on_top = mesh.points[kinds == WHISKER][:, 2] >= 8
    assert on_top.all()
    assert (boundary_of(mesh).node_class[kinds == WHISKER] == NodeClass.PATCH).all()


def test_locked_hexes_are_counted_with_those_that_sliding_frees():
    mesh = slid(ball(3), 0.6, seed=0)
    classes = classify_boundary(mesh, measure(mesh.points, mesh.hexes), 40.0)
    assert 0 < classes.freed < classes.locked
    assert classify_boundary(MESH, FIGURES, 40.0).locked == 0


def lifted():
    """Return a grid of which a node of an edge and one of a face have been lifted off, and their numbers."""
    mesh = MESH.keeping_surface()
    points = mesh.points.copy()
    nodes = [int(np.flatnonzero((points == place).all(axis=1))[0]) for place in ([2, 0, 4], [2, 2, 4])]
    points[nodes, 2] += 0.25
    return mesh.with_points(points), nodes


def test_nodes_that_have_left_their_curve_or_patch_are_a_class_with_distances():
    mesh, nodes = lifted()
    classes = classify_boundary(mesh, measure(mesh.points, mesh.hexes), 40.0)
    assert np.flatnonzero(classes.kinds == LEFT).tolist() == sorted(nodes)
    assert classes.count(LEFT) == 2
    np.testing.assert_allclose(classes.departures.distance[nodes], 0.25)
    assert classify_boundary(MESH, FIGURES, 40.0).departures is None


def test_pinned_nodes_stay_a_class_of_their_own():
    mesh, nodes = lifted()
    pinned = mesh.replace(pinned=np.isin(np.arange(mesh.n_nodes), nodes[:1]))
    classes = classify_boundary(pinned, measure(mesh.points, mesh.hexes), 40.0)
    assert classes.kinds[nodes].tolist() == [PIN, LEFT]


def test_only_the_latest_request_is_answered(classifier, qtbot):
    pinned = MESH.replace(pinned=MESH.topology.boundary)
    with qtbot.waitSignal(classifier.found):
        classifier.ask(ball(2), FIGURES, 40.0)
        classifier.ask(MESH, FIGURES, 40.0)
        classifier.ask(pinned, FIGURES, 40.0)
    qtbot.waitUntil(lambda: not classifier.busy)
    assert classifier.of(MESH).count(PIN) == MESH.topology.boundary.sum()
    assert classifier.of(ball(2)) is None
    answer = classifier.result
    classifier.ask(pinned, FIGURES, 40.0)
    assert not classifier.busy
    assert classifier.result is answer


def test_an_error_is_reported_and_the_next_request_is_computed(classifier, qtbot):
    with qtbot.waitSignal(classifier.found):
        classifier.ask(MESH, FIGURES, 40.0)
    with qtbot.waitSignal(classifier.found):
        classifier.ask(MESH, None, 40.0)
    assert isinstance(classifier.error, AttributeError)
    assert classifier.of(MESH) is None
    classifier.ask(MESH, None, 40.0)
    assert not classifier.busy  # it would fail again
    with qtbot.waitSignal(classifier.found):
        classifier.ask(MESH, FIGURES, 30.0)
    assert classifier.error is None
    assert classifier.of(MESH) is not None


@pytest.mark.parametrize("figures", [None, FIGURES])
def test_results_for_a_closed_mesh_are_dropped(figures, classifier, qtbot):
    results = []
    classifier.found.connect(lambda: results.append((classifier.result, classifier.error)))
    classifier.ask(MESH, figures, 40.0)
    classifier.forget()
    other = ball(2)
    classifier.ask(other, measure(other.points, other.hexes), 40.0)
    qtbot.waitUntil(lambda: not classifier.busy)
    ((classes, error),) = results
    assert classes.mesh is other
    assert error is None
