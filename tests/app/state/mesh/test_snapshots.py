"""What is kept of the open mesh."""

import numpy as np

from hexmend_app.state.mesh.document import Document, State
from hexmend_app.state.mesh.snapshots import MOST, Snapshots
from tests.core.grids import grid, scrambled

STATE = State.of(scrambled(grid(3), 0.6))


def test_six_are_kept_each_with_a_slot_and_a_name_of_its_own(qtbot):
    kept = Snapshots(Document())
    for _ in range(MOST + 2):
        kept.keep("mend 3", STATE)
    assert kept.full
    assert [one.slot for one in kept.all] == list(range(MOST))
    assert [one.name for one in kept.all] == ["mend 3", *(f"mend 3 ({k})" for k in range(2, MOST + 1))]


def test_slots_are_free_again_and_the_others_keep_theirs(qtbot):
    kept = Snapshots(Document())
    for name in "abc":
        kept.keep(name, STATE)
    kept.remove(1)
    kept.keep("d", STATE)
    assert [(one.slot, one.name) for one in kept.all] == [(0, "a"), (2, "c"), (1, "d")]
    kept.rename(2, "see")
    assert [one.name for one in kept.all] == ["a", "see", "d"]
    kept.clear()
    assert not kept.all


def test_points_are_shared_not_copied(qtbot):
    kept = Snapshots(Document())
    kept.keep("a", STATE)
    kept.rename(0, "b")
    assert kept.all[0].points is STATE.mesh.points
    np.testing.assert_array_equal(kept.all[0].inverted, STATE.figures.inverted)


def test_only_changes_are_told(qtbot):
    kept, told = Snapshots(Document()), []
    kept.changed.connect(lambda: told.append(len(kept.all)))
    kept.clear()
    kept.keep("a", STATE)
    kept.remove(4)
    kept.remove(0)
    assert told == [1, 0]
