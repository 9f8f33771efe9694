"""Curves marked by hand in the window."""

import re

import numpy as np
import pytest
from PySide6.QtCore import Qt

from hexmend import io
from hexmend.boundary import NodeClass
from hexmend.boundary.marking import marked_segments
from hexmend.iteration import StoppingCriteria
from hexmend.smoothers import METHODS
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import key, open_and_wait, phase
from tests.core.boundary.solids import ball
from tests.patience import PATIENCE


@pytest.fixture
def ends(window, qtbot, tmp_path):
    """Open a ball, and return two distant nodes of its smooth boundary."""
    mesh = ball(4)
    io.write(tmp_path / "ball.mesh", mesh)
    open_and_wait(qtbot, window, tmp_path / "ball.mesh")
    on = np.flatnonzero(mesh.topology.boundary)
    return [int(on[end(mesh.points[on][:, 0])]) for end in (np.argmin, np.argmax)]


def select(window, node):
    mesh = window.session.document.now.mesh
    window.session.selection.choose(int((mesh.hexes == node).any(axis=1).argmax()), node)
    window.refresh()


def mark(window, ends):
    for node in ends:
        select(window, node)
        key(window, Qt.Key.Key_E, Qt.KeyboardModifier.ShiftModifier)
        window.refresh()


def marked(window):
    return marked_segments(window.session.document.now.mesh)


def test_edges_between_two_selected_nodes_are_marked_and_shown_among_the_kinds_of_nodes(window, qtbot, ends):
    before = window.session.document.now.mesh
    mark(window, ends)
    assert len(marked(window)) > 4
    assert set(ends) <= set(marked(window).ravel().tolist())
    assert window.session.view.look.structure.is_on("kinds")
    nodes, counts = np.unique(marked(window), return_counts=True)
    classifier = window.session.boundary_classifier

    def on_the_curve():
        window.refresh()
        classes = classifier.of(before)
        return classes is not None and (classes.kinds[nodes[counts == 2]] == NodeClass.CURVE).all()

    qtbot.waitUntil(on_the_curve, timeout=PATIENCE)


@pytest.mark.slow
def test_marks_are_undone_redone_and_removed(window, ends):
    assert not window.action("unmark_curve").isEnabled()
    mark(window, ends)
    count = len(marked(window))
    window.session.commands.undo()
    assert not len(marked(window))
    window.session.commands.redo()
    assert len(marked(window)) == count
    select(window, int(marked(window)[2, 0]))
    window.action("unmark_curve").trigger()
    assert not len(marked(window))
    window.session.commands.undo()
    window.refresh()
    window.action("unmark_all_curves").trigger()
    assert not len(marked(window))


@pytest.mark.slow
def test_iterations_and_results_of_runs_have_the_marks(window, qtbot, ends):
    window.session.run.start(METHODS["laplacian"](), StoppingCriteria(max_iterations=2, keep_last=True))
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    mark(window, ends)
    expected = marked(window)
    timeline = window.session.timeline
    for number in (0, 2, 1):
        timeline.go(timeline.record, number)
        np.testing.assert_array_equal(marked(window), expected)


@pytest.mark.slow
def test_the_script_marks_the_same_edges(window, ends):
    mark(window, ends)
    text = window.features["script"].text
    assert "from hexmend.boundary.marking import with_curve" in text
    assert re.search(rf"with_curve\(\w+, \({ends[0]}, ", text)
