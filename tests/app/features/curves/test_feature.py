"""Curves marked by hand in the window."""

import re

import numpy as np
import pytest
from PySide6.QtCore import Qt

from hexmend.boundary import NodeClass
from hexmend.boundary.marking import marked_segments
from tests.app.driving import key, open_mesh
from tests.core.boundary.solids import ball


@pytest.fixture
def ends(window, qtbot, tmp_path):
    """Open a ball, and return two distant nodes of its smooth boundary."""
    mesh = ball(4)
    open_mesh(qtbot, window, tmp_path / "ball.mesh", mesh)
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
    assert re.search(rf"with_curve\(\w+, \({ends[0]}, ", window.features["reproduce"].text)
    nodes, counts = np.unique(marked(window), return_counts=True)
    classifier = window.session.boundary_classifier

    def on_the_curve():
        window.refresh()
        classes = classifier.of(before)
        return classes is not None and (classes.kinds[nodes[counts == 2]] == NodeClass.CURVE).all()

    qtbot.waitUntil(on_the_curve)


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
