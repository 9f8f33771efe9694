"""The document without a window: changes, undo, reset, saved states."""

from pathlib import Path

import numpy as np
import pytest

from hexmend.boundary import surface_change
from hexmend_app.state.mesh.document import Document, State
from tests.core.grids import grid, scrambled


def moved(state, amount):
    return State.of(state.mesh.with_points(state.mesh.points + amount * state.mesh.free[:, None]))


@pytest.fixture
def document(qtbot):
    document = Document()
    document.replace(State.of(scrambled(grid(3), 0.2)), Path("a.vtu"))
    return document


def test_changes_are_undone_and_redone(document):
    start = document.now
    first = moved(start, 0.01)
    document.commit("first", first)
    document.commit("second", moved(start, 0.02))
    assert document.undo_title == "second"
    document.undo()
    assert document.now is first
    assert document.redo_title == "second"
    document.undo()
    assert document.now is start
    assert not document.modified
    document.undo()
    assert document.now is start
    document.redo()
    assert document.now is first
    document.commit("other", moved(start, 0.03))
    assert document.redo_title is None


def test_a_preview_is_no_change(document, qtbot):
    with qtbot.waitSignal(document.points_moved):
        document.preview(moved(document.now, 0.01))
    assert document.undo_title is None


def test_reset_goes_back_to_the_opened_mesh_and_can_be_undone(document):
    start, other = document.now, moved(document.now, 0.01)
    document.reset()
    assert document.undo_title is None
    document.commit("smooth", other)
    document.reset()
    assert document.now.mesh.points is start.mesh.points
    assert document.now.summary == start.summary
    assert document.undo_title == "reset"
    document.undo()
    assert document.now is other


def test_saving_marks_the_state_that_was_saved(document):
    document.commit("smooth", moved(document.now, 0.01))
    assert document.modified
    document.mark_saved(Path("b.vtu"))
    assert not document.modified
    assert document.name == "b.vtu"
    document.undo()
    assert document.modified
    document.commit("other", moved(document.now, 0.05))
    document.undo()
    assert document.modified


def test_opening_a_mesh_discards_the_changes(document, qtbot):
    document.commit("smooth", moved(document.now, 0.01))
    with qtbot.waitSignal(document.mesh_replaced):
        document.replace(State.of(grid(2)), None)
    assert document.undo_title is None
    assert document.start is document.now


def test_the_boundary_slides_on_that_of_the_opened_mesh(document):
    opened = document.now.mesh.points
    scaled = document.now.mesh.with_points(1.1 * opened)
    document.commit("moved", State.of(scaled.replace(name="pinned since")))
    np.testing.assert_array_equal(document.now.mesh.surface_points, opened)
    change = surface_change(document.now.mesh, document.now.mesh.with_points(opened))
    assert change.max == 0
    assert surface_change(document.now.mesh, scaled).max > 0
