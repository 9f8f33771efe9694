"""Side views: their number, their names and their arrangement."""

import pytest

from hexmend import gallery
from hexmend_app.state.mesh.document import Document, State
from hexmend_app.state.mesh.snapshots import Snapshots
from hexmend_app.state.view.side_views import MAX_SIDE_VIEWS, SideViews, Wipe


@pytest.fixture
def document(qapp):
    document = Document()
    document.replace(State.of(gallery.make("cube", size=8)), None)
    return document


@pytest.fixture
def views(document):
    return SideViews(document, Snapshots(document))


@pytest.fixture
def states(document):
    mesh = document.now.mesh
    return [State.of(mesh.with_points(mesh.points * scale)) for scale in (1.0, 2.0, 3.0, 4.0)]


def test_there_are_at_most_three_side_views(views, states):
    counts = []
    views.changed.connect(lambda: counts.append(len(views.all)))
    assert [views.show(str(k), state) for k, state in enumerate(states)] == [True, True, True, False]
    assert counts == [1, 2, 3]
    assert views.full
    assert MAX_SIDE_VIEWS == 3
    assert [views.shows(state) for state in states] == [True, True, True, False]


def test_views_are_closed_by_number_or_all_or_with_the_mesh(views, states, document):
    for k, state in enumerate(states[:3]):
        views.show(str(k), state)
    views.close_view(2)
    assert [view.name for view in views.all] == ["0", "2"]
    document.replace(State.of(gallery.make("cube", size=27)), None)
    assert views.all == ()


def test_a_wipe_needs_two_views_and_ends_with_the_second(views, states):
    views.set_wiping(True)
    assert views.wipe is None
    views.show("a", states[0])
    views.show("b", states[1])
    views.set_wiping(True)
    assert views.wipe == Wipe(0, 2)
    views.close_view(1)
    assert views.wipe == Wipe(0, 1)
    views.close_view(1)
    assert views.wipe is None


def test_choosing_one_view_for_both_sides_swaps_the_sides(views, states):
    for k, state in enumerate(states[:2]):
        views.show(str(k), state)
    views.set_wiping(True)
    views.choose_wiped(1, 2)
    assert (views.wipe.left, views.wipe.right) == (1, 2)
    views.choose_wiped(2, 2)
    assert (views.wipe.left, views.wipe.right) == (2, 1)


@pytest.mark.parametrize(("requested", "low", "high"), [(-3.0, 0.01, 0.1), (0.4, 0.4, 0.4), (7.0, 0.9, 0.99)])
def test_the_edge_stays_within_the_view(views, states, requested, low, high):
    views.show("a", states[0])
    views.move_wipe(0.2)
    assert views.wipe is None
    views.set_wiping(True)
    positions = []
    views.wiped.connect(lambda: positions.append(views.wipe.at))
    views.move_wipe(requested)
    assert low <= views.wipe.at <= high
    assert positions == [views.wipe.at]


def test_a_view_has_a_snapshot_as_long_as_it_is_open(document, states):
    snapshots = Snapshots(document)
    views = SideViews(document, snapshots)
    views.show("first", states[0])
    views.show("second", states[1])
    assert [snapshot.name for snapshot in snapshots.all] == ["first", "second"]
    views.show("first", states[2])
    assert [snapshot.name for snapshot in snapshots.all] == ["second", "first"]
    assert snapshots.of(states[0]) is None
    views.close_view(1)
    assert [snapshot.name for snapshot in snapshots.all] == ["second"]
    views.close_all()
    assert snapshots.all == ()
