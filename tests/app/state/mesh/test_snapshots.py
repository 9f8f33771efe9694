"""Snapshots of the open mesh."""

from hexmend_app.state.mesh.document import Document, State
from hexmend_app.state.mesh.snapshots import MAX_SNAPSHOTS, Snapshots
from tests.core.grids import grid, scrambled

STATE = State.of(scrambled(grid(3), 0.6))


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


def test_only_changes_are_signalled(qtbot):
    snapshots, counts = Snapshots(Document()), []
    snapshots.changed.connect(lambda: counts.append(len(snapshots.all)))
    snapshots.clear()
    snapshots.add("a", STATE)
    snapshots.remove(4)
    snapshots.remove(0)
    assert counts == [1, 0]
