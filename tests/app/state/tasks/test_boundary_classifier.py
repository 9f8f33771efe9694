"""What the nodes of a boundary are, found beside the window."""

import numpy as np
import pytest

from hexmend.boundary import NodeClass, boundary_of
from hexmend.quality import measure
from hexmend_app.state.mesh.document import Document
from hexmend_app.state.tasks.boundary_classifier import (
    PIN,
    WHISKER,
    BoundaryClassifier,
    classify_boundary,
    node_classes,
)
from tests.core.boundary.solids import ball, slid
from tests.core.grids import grid
from tests.patience import PATIENCE

MESH = grid(4)
FIGURES = measure(MESH.points, MESH.hexes)


@pytest.fixture
def classer(qapp):
    classer = BoundaryClassifier(Document())
    yield classer
    classer.close()


def creased():
    """A block with a crease across a part of its top."""
    mesh = grid(8)
    points = mesh.points.copy()
    points[(points[:, 2] == 8) & (points[:, 0] == 4) & (np.abs(points[:, 1] - 4) <= 1), 2] += 1
    return mesh.with_points(points)


def test_without_whiskers_kinds_are_those_of_the_core():
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


def test_of_several_questions_the_newest_is_answered(classer, qtbot):
    pinned = MESH.replace(pinned=MESH.topology.boundary)
    with qtbot.waitSignal(classer.found, timeout=PATIENCE):
        classer.ask(ball(2), FIGURES, 40.0)
        classer.ask(MESH, FIGURES, 40.0)
        classer.ask(pinned, FIGURES, 40.0)
    qtbot.waitUntil(lambda: not classer.busy, timeout=PATIENCE)
    assert classer.of(MESH).count(PIN) == MESH.topology.boundary.sum()
    assert classer.of(ball(2)) is None
    answer = classer.classes
    classer.ask(pinned, FIGURES, 40.0)
    assert not classer.busy
    assert classer.classes is answer


def test_why_nothing_was_found_is_told_and_another_question_is_asked_anew(classer, qtbot):
    with qtbot.waitSignal(classer.found, timeout=PATIENCE):
        classer.ask(MESH, FIGURES, 40.0)
    with qtbot.waitSignal(classer.found, timeout=PATIENCE):
        classer.ask(MESH, None, 40.0)
    assert isinstance(classer.error, AttributeError)
    assert classer.of(MESH) is None
    classer.ask(MESH, None, 40.0)
    assert not classer.busy  # it would fail again
    with qtbot.waitSignal(classer.found, timeout=PATIENCE):
        classer.ask(MESH, FIGURES, 30.0)
    assert classer.error is None
    assert classer.of(MESH) is not None


@pytest.mark.parametrize("figures", [None, FIGURES])
def test_what_comes_of_a_mesh_that_was_left_is_not_told(figures, classer, qtbot):
    told = []
    classer.found.connect(lambda: told.append((classer.classes, classer.error)))
    classer.ask(MESH, figures, 40.0)
    classer.forget()
    other = ball(2)
    classer.ask(other, measure(other.points, other.hexes), 40.0)
    qtbot.waitUntil(lambda: not classer.busy, timeout=PATIENCE)
    ((classes, error),) = told
    assert classes.mesh is other
    assert error is None
