"""The document without a window: changes, undo, reset, saved states."""

from pathlib import Path

import numpy as np
import pytest

from hexmend.boundary import surface_change
from hexmend.quality import measure, summarise
from hexmend_app.picture import Colours, Isolate
from hexmend_app.picture.displacement import Displacement, ReferenceState
from hexmend_app.scene.colour.colouring import resolve
from hexmend_app.state.mesh.document import Document, MeasuredMesh
from hexmend_app.state.mesh.hex_groups import GROUPS, hexes_of_group
from hexmend_app.state.mesh.selection import WorstHexes
from hexmend_app.state.view.side_views import MAX_SNAPSHOTS, Snapshots
from hexmend_app.state.view.view_model import ViewModel
from tests.app.invalid_hexes import INSIDE, INVERTED, THREE, VALID
from tests.core.grids import grid, scrambled


def moved(state, amount):
    return MeasuredMesh.of(state.mesh.with_points(state.mesh.points + amount * state.mesh.free[:, None]))


@pytest.fixture
def document(qtbot):
    document = Document()
    document.replace(MeasuredMesh.of(scrambled(grid(3), 0.2)), Path("a.vtu"))
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
        document.replace(MeasuredMesh.of(grid(2)), None)
    assert document.undo_title is None
    assert document.start is document.now


def test_the_boundary_slides_on_that_of_the_opened_mesh(document):
    opened = document.now.mesh.points
    scaled = document.now.mesh.with_points(1.1 * opened)
    document.commit("moved", MeasuredMesh.of(scaled.replace(name="pinned since")))
    np.testing.assert_array_equal(document.now.mesh.surface_points, opened)
    change = surface_change(document.now.mesh, document.now.mesh.with_points(opened))
    assert change.max == 0
    assert surface_change(document.now.mesh, scaled).max > 0


# Named groups of hexes, and their isolation.


MESH = scrambled(grid(6), 0.8, 1)
FIGURES = measure(MESH.points, MESH.hexes)


def test_groups_have_as_many_hexes_as_the_summary_counts():
    summary = summarise(MESH, FIGURES)
    assert len(hexes_of_group("inverted", MESH, FIGURES)) == summary.inverted > 0
    assert len(hexes_of_group("locked", MESH, FIGURES)) == summary.locked_inverted
    fixed = MESH.replace(pinned=np.ones(MESH.n_nodes, bool))
    assert len(hexes_of_group("locked", fixed, FIGURES)) == summary.inverted


def test_hexes_that_are_invalid_inside_are_a_group_and_a_state_of_their_own():
    figures = measure(THREE.points, THREE.hexes)
    expected = {"inverted": [INVERTED], "invalid": [INVERTED, INSIDE], "invalid inside": [INSIDE]}
    for group, hexes in expected.items():
        assert hexes_of_group(group, THREE, figures).tolist() == hexes
    worst = WorstHexes.of(THREE.replace(pinned=np.zeros(THREE.n_nodes, bool)), figures, "q")
    states = dict(zip(worst.hexes.tolist(), worst.states, strict=True))
    assert (states[VALID], states[INSIDE]) == ("", "inside")
    assert states[INVERTED] in ("inverted", "locked")


def test_every_special_colour_of_the_colour_bar_has_a_group():
    for metric in ("q", "q-change"):
        for colour in resolve(Colours(metric=metric), FIGURES.q, FIGURES.inverted).special_colours:
            assert colour.name in GROUPS
            assert hexes_of_group(colour.name, MESH, FIGURES).dtype == np.int64


def test_a_displacement_defines_groups_by_former_and_present_validity():
    earlier = scrambled(MESH, 0.3, 7)
    before = measure(earlier.points, earlier.hexes)
    displacement = Displacement(MESH, ReferenceState(earlier.points, before, "then"), MESH.points, FIGURES)
    newly, still, mended = (
        set(hexes_of_group(group, MESH, FIGURES, displacement).tolist())
        for group in ("newly invalid", "still invalid", "mended")
    )
    assert newly | still == set(np.flatnonzero(FIGURES.invalid).tolist())
    assert still | mended == set(np.flatnonzero(before.invalid).tolist())
    assert newly
    assert still


def test_isolated_hexes_are_shown_whatever_the_other_filters(qapp):
    document = Document()
    document.replace(MeasuredMesh.of(MESH), None)
    view = ViewModel(document)
    view.change(show={"quality": (0.5, 1.0), "peel": 2})
    view.dig(3)
    view.isolate(np.array([], np.int64))
    assert view.look.show.quality is not None
    view.isolate(np.array([3, 8]))
    assert (view.look.show.peel, view.look.show.hidden) == (0, frozenset())
    assert view.look.show.isolate == Isolate((3, 8), rings=view.rings)
    assert view.look.show.quality is None
    assert view.rings == 1  # for the next isolation


# Snapshots of the open mesh.


STATE = MeasuredMesh.of(scrambled(grid(3), 0.6))


def test_snapshots_have_unique_slots_and_names(qtbot):
    snapshots = Snapshots(Document())
    for _ in range(MAX_SNAPSHOTS + 2):
        snapshots.add("mend 3", STATE)
    assert snapshots.full
    assert [one.slot for one in snapshots.all] == list(range(MAX_SNAPSHOTS))
    assert [one.name for one in snapshots.all] == ["mend 3", *(f"mend 3 ({k})" for k in range(2, MAX_SNAPSHOTS + 1))]


def test_a_free_slot_is_reused_and_the_others_do_not_change(qtbot):
    snapshots = Snapshots(Document())
    for name in "abc":
        snapshots.add(name, STATE)
    snapshots.remove(1)
    snapshots.add("d", STATE)
    assert [(one.slot, one.name) for one in snapshots.all] == [(0, "a"), (2, "c"), (1, "d")]
    snapshots.rename(2, "see")
    assert [one.name for one in snapshots.all] == ["a", "see", "d"]
    snapshots.clear()
    assert not snapshots.all
