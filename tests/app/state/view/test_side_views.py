"""Views beside that of the mesh as it is now: which, how many, and how they lie."""

import pytest

from hexmend import gallery
from hexmend_app.state.mesh.document import Document, State
from hexmend_app.state.mesh.snapshots import Snapshots
from hexmend_app.state.view.side_views import MOST, SideViews, Wipe


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


def test_there_is_room_for_four_with_that_of_the_mesh(views, states):
    told = []
    views.changed.connect(lambda: told.append(len(views.all)))
    assert [views.show(str(k), state) for k, state in enumerate(states)] == [True, True, True, False]
    assert told == [1, 2, 3]
    assert views.full
    assert MOST == 3
    assert [views.shows(state) for state in states] == [True, True, True, False]


def test_a_name_has_one_view_whatever_it_shows(views, states):
    for state in states:
        assert views.show("iteration", state)
    assert [one.state for one in views.all] == [states[-1]]


def test_views_are_closed_by_number_or_all_or_with_the_mesh(views, states, document):
    for k, state in enumerate(states[:3]):
        views.show(str(k), state)
    views.close_view(2)
    assert [one.name for one in views.all] == ["0", "2"]
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


def test_the_sides_of_a_wipe_change_places_where_one_is_chosen_for_both(views, states):
    for k, state in enumerate(states[:2]):
        views.show(str(k), state)
    views.set_wiping(True)
    views.choose_wiped(1, 2)
    assert (views.wipe.left, views.wipe.right) == (1, 2)
    views.choose_wiped(2, 2)
    assert (views.wipe.left, views.wipe.right) == (2, 1)


@pytest.mark.parametrize(("asked", "low", "high"), [(-3.0, 0.01, 0.1), (0.4, 0.4, 0.4), (7.0, 0.9, 0.99)])
def test_the_edge_stays_within_the_view(views, states, asked, low, high):
    views.show("a", states[0])
    views.move_wipe(0.2)
    assert views.wipe is None
    views.set_wiping(True)
    told = []
    views.wiped.connect(lambda: told.append(views.wipe.at))
    views.move_wipe(asked)
    assert low <= views.wipe.at <= high
    assert told == [views.wipe.at]


def test_distributions_are_kept_as_long_as_a_view_shows_them(document, states):
    kept = Snapshots(document)
    views = SideViews(document, kept)
    views.show("first", states[0])
    views.show("second", states[1])
    assert [one.name for one in kept.all] == ["first", "second"]
    views.show("first", states[2])
    assert [one.name for one in kept.all] == ["second", "first"]
    assert kept.of(states[0]) is None
    views.close_view(1)
    assert [one.name for one in kept.all] == ["second"]
    views.close_all()
    assert kept.all == ()


def test_a_state_that_is_shown_gets_no_second_view(views, states):
    assert views.show("first", states[0])
    assert views.show("second", states[0])
    assert [one.name for one in views.all] == ["first"]
