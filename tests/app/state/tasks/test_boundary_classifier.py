"""Classification of the nodes of a boundary in the background."""

import numpy as np
import pytest

from hexmend.boundary import NodeClass, boundary_of
from hexmend.quality import measure
from hexmend_app.state.mesh.document import Document
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
