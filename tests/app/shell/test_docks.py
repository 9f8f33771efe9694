"""Where panels stand around the view, and what room the view has."""

from __future__ import annotations

import json

import pytest
from PySide6.QtCore import QPoint
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLabel, QSplitter

from hexmend_app.feature import Panel, Place
from hexmend_app.resources import demo_mesh
from hexmend_app.shell.docks import LAYOUT, Docks
from hexmend_app.state import settings
from tests.app.driving import LEFT, open_and_wait

IDS = ("run", "recipe", "look", "histogram", "quality", "worst", "tags")


def panels():
    """Some panels, two of which share a tab."""
    places = (*3 * [Place.TOOLS], *2 * [Place.FACTS], *2 * [Place.DRAWER])
    shared = {"run": "Run", "recipe": "Run"}
    return [
        Panel(id=id, title=id.title(), widget=QLabel(f"About {id}"), place=place, tab=shared.get(id, ""), order=at)
        for at, (id, place) in enumerate(zip(IDS, places, strict=True))
    ]


@pytest.fixture
def docks(shown):
    docks = Docks()
    docks.add(panels())
    shown(docks, 1000, 700)
    QApplication.processEvents()
    return docks


def seen(docks):
    """The panels that can be seen."""
    return {id for id in docks.ids() if docks.in_front(id)}


def sizes(docks):
    """How the room is shared out, from the outside to the inside."""
    QApplication.processEvents()
    return [splitter.sizes() for splitter in docks.findChildren(QSplitter)]


def pull(handle, by):
    """Drag the handle of a splitter as a hand does."""
    start = handle.rect().center()
    QTest.mousePress(handle, LEFT, pos=start)
    for k in range(1, 6):
        QTest.mouseMove(handle, start + by * k / 5)  # it moves under the mouse, and may stay behind
    QTest.mouseRelease(handle, LEFT, pos=start)
    QApplication.processEvents()


def handles(docks):
    return [splitter.handle(1) for splitter in docks.findChildren(QSplitter)]


def test_panels_stand_in_their_order_tools_first(docks):
    assert docks.ids() == list(IDS)
    assert seen(docks) == {"run", "recipe", "histogram"}  # the drawer is folded


def test_a_panel_is_brought_to_the_front_with_those_that_share_its_tab(docks):
    docks.show_panel("look")
    docks.show_panel("tags")
    assert seen(docks) == {"look", "histogram", "tags"}
    docks.show_panel("recipe")
    assert seen(docks) == {"run", "recipe", "histogram", "tags"}


def test_a_panel_is_closed_until_it_is_shown_again(docks):
    docks.close_panel("quality")
    assert not docks.is_open("quality")
    docks.show_panel("quality")
    assert docks.is_open("quality")
    assert docks.in_front("quality")


def test_a_panel_is_offered_where_it_is_without_taking_room(docks):
    view = docks.centre.size()
    docks.offer_panel("tags")
    docks.offer_panel("quality")
    QApplication.processEvents()
    assert docks.drawer.folded
    assert docks.centre.size() == view
    assert docks.in_front("quality")
    docks.drawer.set_folded(False)
    assert docks.in_front("tags")


def test_panels_are_hidden_and_come_back_as_they_were(docks, qtbot):
    docks.show_panel("tags")
    docks.show_panel("quality")
    before, view = seen(docks), docks.centre.width()
    with qtbot.waitSignal(docks.changed):
        docks.set_hidden(True)
    QApplication.processEvents()
    assert docks.hidden
    assert seen(docks) == set()
    assert docks.centre.width() > view
    docks.set_hidden(False)
    QApplication.processEvents()
    assert seen(docks) == before
    assert docks.centre.width() == view
    docks.set_hidden(True)
    docks.show_panel("look")  # brings all back
    assert not docks.hidden
    assert seen(docks) == before - {"run", "recipe"} | {"look"}


def test_splitters_go_both_ways(docks):
    docks.show_panel("tags")
    for handle, by in zip(handles(docks), (QPoint(-60, 0), QPoint(0, -60), QPoint(0, -60)), strict=True):
        for way in (by, -by, -by):
            before = sizes(docks)
            pull(handle, way)
            assert sizes(docks) != before


def test_the_view_is_never_smaller_than_it_can_be_of_use(docks):
    docks.show_panel("tags")
    for handle in handles(docks):
        for by in (QPoint(-2000, 0), QPoint(0, -2000)):
            pull(handle, by)
            assert docks.centre.width() >= 320
            assert docks.centre.height() >= 240
            assert docks.centre.isVisible()
    docks.window().resize(1, 1)
    QApplication.processEvents()
    assert docks.centre.width() >= 320
    assert docks.centre.height() >= 240


# What is kept


@pytest.fixture
def another(shown):
    """Other docks with the same panels."""
    docks = Docks()
    docks.add(panels())
    shown(docks, 1000, 700)
    QApplication.processEvents()
    return docks


@pytest.mark.parametrize("folded", [False, True], ids=["open", "folded"])
@pytest.mark.parametrize("hidden", [False, True], ids=["shown", "hidden"])
def test_a_layout_is_restored(docks, another, folded, hidden):
    docks.show_panel("tags")
    for handle, by in zip(handles(docks), (QPoint(-60, 0), QPoint(0, -60), QPoint(0, -60)), strict=True):
        pull(handle, by)
    docks.show_panel("look")
    docks.show_panel("quality")
    docks.close_panel("worst")
    docks.drawer.set_folded(folded)
    docks.set_hidden(hidden)
    another.restore(docks.state())
    assert another.hidden is hidden
    for one in (docks, another):
        one.set_hidden(False)
    assert sizes(another) == sizes(docks)
    assert seen(another) == seen(docks) == {"look", "quality"} | (set() if folded else {"tags"})
    assert not another.is_open("worst")
    another.drawer.set_folded(False)
    docks.drawer.set_folded(False)
    assert another.drawer.height() == docks.drawer.height() != Docks().drawer.height_unfolded


def test_a_layout_can_be_kept_in_the_settings(docks, another):
    docks.show_panel("tags")
    settings.PANELS.set(docks.state())
    another.restore(settings.PANELS.get())
    assert seen(another) == seen(docks)


@pytest.mark.parametrize(
    "broken",
    [{"layout": "another"}, {"layout": None}, {"fronts": None}, {"drawer": "high"}, {"all": 3}],
    ids=json.dumps,
)
def test_a_layout_of_other_panels_or_that_cannot_be_read_is_left_alone(docks, another, broken):
    before, seen_before = sizes(another), seen(another)
    pull(handles(docks)[0], QPoint(-60, 0))
    docks.show_panel("look")
    another.restore(docks.state() | broken)
    assert sizes(another) == before
    assert seen(another) == seen_before
    another.restore({})
    assert sizes(another) == before


def test_panels_that_are_no_more_do_not_matter(docks, another):
    state = docks.state()
    assert state["layout"] == LAYOUT
    another.restore(state | {"closed": ["gone", "tags"], "fronts": ["Gone", "Quality", "Gone"]})
    assert not another.is_open("tags")
    assert another.in_front("quality")


# The window


@pytest.mark.slow
@pytest.mark.parametrize("size", [(1366, 768), (1920, 1080)], ids="{0[0]} x {0[1]}".format)
def test_the_view_has_most_of_the_window_in_the_default_layout(window, qtbot, size):
    open_and_wait(qtbot, window, demo_mesh())
    window.resize(*size)
    QApplication.processEvents()
    window.docks.place()
    window.refresh()
    QApplication.processEvents()
    assert (window.width(), window.height()) == size
    assert seen(window.docks) == {"run", "recipe", "histogram", "timeline"}
    view = window.canvas.interactor
    assert view.width() * view.height() >= 0.7 * window.width() * window.height()


@pytest.mark.slow
def test_the_layout_is_kept_from_one_window_to_the_next(fresh_window, qtbot):
    window = fresh_window
    window.show_panel("tags")
    window.show_panel("quality")
    window.docks.close_panel("node")
    window.close()
    kept = settings.PANELS.get()
    assert kept["closed"] == ["node"]
    assert "Tags" in kept["fronts"]
    assert "Quality" in kept["fronts"]
    assert kept["folded"] is False
