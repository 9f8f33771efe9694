"""Panels around the view: places, visibility, sizes and saved layouts."""

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget, QLabel, QMainWindow, QTabBar, QToolButton

from hexmend_app.feature import Panel, PanelGroup, PanelPlace
from hexmend_app.shell.panels.docks import Docks
from hexmend_app.state.settings import settings
from tests.app.driving import LEFT

#: Panels by place, with their groups; two share a tab.
PLACED = {
    PanelPlace.TOOLS: {"run": PanelGroup.SMOOTH, "recipe": PanelGroup.SMOOTH, "look": PanelGroup.LOOK},
    PanelPlace.FACTS: {"histogram": PanelGroup.FIND, "quality": PanelGroup.FIND},
    PanelPlace.DRAWER: {"worst": PanelGroup.FIND, "tags": PanelGroup.FIND, "runs": PanelGroup.SMOOTH},
}
IDS = [id for groups in PLACED.values() for id in groups]
TABS = {"run": "Run", "recipe": "Run"}


def panels():
    return [
        Panel(
            id=id,
            title=id.title(),
            widget=QLabel(f"About {id}"),
            place=place,
            group=group,
            tab=TABS.get(id, ""),
            order=IDS.index(id),
        )
        for place, groups in PLACED.items()
        for id, group in groups.items()
    ]


def shown_docks(shown):
    """Show a main window with the panels."""
    main = QMainWindow()
    docks = Docks(main)
    main.statusBar().addPermanentWidget(docks.row, 1)
    docks.add(panels())
    shown(main, 1000, 700)
    QApplication.processEvents()
    return docks


@pytest.fixture
def docks(shown):
    return shown_docks(shown)


@pytest.fixture
def another(shown):
    """Docks of a second window with the same panels."""
    return shown_docks(shown)


def visible(docks):
    """Return the ids of the visible panels."""
    QApplication.processEvents()
    return {id for id in docks.ids() if docks.in_front(id)}


def dock_of(docks, title):
    return next(dock for dock in docks.parent().findChildren(QDockWidget) if dock.windowTitle() == title)


def resize(docks, title, width, height):
    """Resize a dock."""
    for size, direction in ((width, Qt.Orientation.Horizontal), (height, Qt.Orientation.Vertical)):
        docks.parent().resizeDocks([dock_of(docks, title)], [size], direction)
    QApplication.processEvents()


def test_panels_are_ordered_with_tools_first(docks):
    assert docks.ids() == IDS
    assert visible(docks) == {"run", "recipe", "histogram"}  # the drawer is folded


def test_showing_a_panel_shows_those_that_share_its_tab(docks):
    docks.show_panel("look")
    docks.show_panel("tags")
    assert visible(docks) == {"look", "histogram", "tags"}
    docks.show_panel("recipe")
    assert visible(docks) == {"run", "recipe", "histogram", "tags"}


def test_offering_a_panel_does_not_open_the_drawer(docks):
    view = docks.centre.size()
    docks.offer_panel("tags")
    docks.offer_panel("quality")
    QApplication.processEvents()
    assert docks.folded
    assert docks.centre.size() == view
    assert docks.in_front("quality")
    docks.set_folded(False)
    assert docks.in_front("tags")


def test_hidden_panels_are_restored(docks, qtbot):
    docks.show_panel("tags")
    docks.show_panel("quality")
    before, view = visible(docks), docks.centre.width()
    with qtbot.waitSignal(docks.changed):
        docks.set_hidden(True)
    QApplication.processEvents()
    assert docks.hidden
    assert visible(docks) == set()
    assert docks.centre.width() > view
    docks.set_hidden(False)
    QApplication.processEvents()
    assert visible(docks) == before
    assert docks.centre.width() == view
    docks.set_hidden(True)
    docks.show_panel("look")  # shows all panels
    assert not docks.hidden
    assert visible(docks) == before - {"run", "recipe"} | {"look"}
    docks.set_hidden(True)
    press(docks, PanelGroup.SMOOTH)  # likewise
    assert visible(docks) == {"run", "recipe", "quality", "runs"}


def test_the_view_has_a_minimum_size(docks):
    docks.show_panel("tags")
    resize(docks, "Tags", 3000, 3000)
    resize(docks, "Run", 3000, 3000)
    docks.parent().resize(1, 1)
    QApplication.processEvents()
    assert docks.centre.width() >= 320
    assert docks.centre.height() >= 240


def press(docks, group):
    QTest.mouseClick(docks.row.button(group), LEFT)
    QApplication.processEvents()


def checked(docks):
    return [group for group in PanelGroup if docks.row.button(group).isChecked()]


def test_only_groups_with_panels_have_a_button(docks):
    assert [group for group in PanelGroup if docks.row.button(group).isVisible()] == [
        PanelGroup.LOOK,
        PanelGroup.FIND,
        PanelGroup.SMOOTH,
    ]
    assert "Worst, Tags" in docks.row.button(PanelGroup.FIND).toolTip()


def test_the_button_of_a_group_opens_and_closes_its_panels(docks):
    press(docks, PanelGroup.FIND)
    assert visible(docks) == {"run", "recipe", "histogram", "worst"}
    assert checked(docks) == [PanelGroup.FIND]
    docks.show_panel("tags")
    press(docks, PanelGroup.FIND)
    assert visible(docks) == {"run", "recipe", "histogram"}
    assert checked(docks) == []
    press(docks, PanelGroup.FIND)
    assert "tags" in visible(docks)


def test_groups_take_turns_below_the_view_and_bring_their_tools_to_the_front(docks):
    docks.show_panel("look")
    docks.show_panel("tags")
    press(docks, PanelGroup.SMOOTH)
    assert visible(docks) == {"run", "recipe", "histogram", "runs"}
    assert checked(docks) == [PanelGroup.SMOOTH]
    press(docks, PanelGroup.FIND)
    assert visible(docks) == {"run", "recipe", "histogram", "tags"}
    docks.offer_panel("runs")
    assert visible(docks) == {"run", "recipe", "histogram", "runs"}
    press(docks, PanelGroup.LOOK)  # has no panels below the view
    assert visible(docks) == {"look", "histogram"}
    assert checked(docks) == []


def test_a_panel_of_another_group_that_is_offered_while_all_are_hidden_is_shown_with_them(docks):
    press(docks, PanelGroup.SMOOTH)
    docks.set_hidden(True)
    docks.offer_panel("tags")
    assert checked(docks) == []
    docks.set_hidden(False)
    assert visible(docks) == {"run", "recipe", "histogram", "tags"}
    assert checked(docks) == [PanelGroup.FIND]
    press(docks, PanelGroup.FIND)
    assert visible(docks) == {"run", "recipe", "histogram"}


def test_a_dock_with_a_tab_has_no_title_of_its_own(docks):
    docks.show_panel("tags")
    QApplication.processEvents()
    assert dock_of(docks, "Tags").titleBarWidget() is not None
    docks.show_panel("runs")
    QApplication.processEvents()
    assert dock_of(docks, "Runs").titleBarWidget() is None  # alone in its group: no tab


def test_buttons_of_a_tab_bar_float_and_close_the_dock_in_front(docks):
    docks.show_panel("tags")
    QApplication.processEvents()
    bar = next(bar for bar in docks.parent().findChildren(QTabBar) if bar.tabText(bar.currentIndex()) == "Tags")
    buttons = {button.accessibleName(): button for button in bar.findChildren(QToolButton)}
    float_button, close_button = buttons["Float"], buttons["Close panel"]
    QTest.mouseClick(close_button, LEFT)
    assert not docks.is_open("tags")
    assert docks.is_open("worst")
    docks.show_panel("tags")
    QApplication.processEvents()
    QTest.mouseClick(float_button, LEFT)
    QApplication.processEvents()
    assert dock_of(docks, "Tags").isFloating()
    assert dock_of(docks, "Tags").titleBarWidget() is None
    docks.set_hidden(True)


def test_the_drawer_keeps_its_height(docks):
    docks.show_panel("tags")
    resize(docks, "Tags", 500, 180)
    height = dock_of(docks, "Tags").height()
    docks.set_folded(True)
    QApplication.processEvents()
    docks.set_folded(False)
    QApplication.processEvents()
    assert dock_of(docks, "Tags").height() == height


def test_a_closed_dock_can_be_shown_again(docks, qtbot):
    with qtbot.waitSignal(docks.changed):
        dock_of(docks, "Quality").close()
    assert not docks.is_open("quality")
    docks.set_hidden(True)
    docks.set_hidden(False)
    assert not docks.is_open("quality")
    docks.show_panel("quality")
    assert "quality" in visible(docks)


def test_reset_restores_the_default_layout(docks):
    before = visible(docks)
    dock_of(docks, "Look").setFloating(True)
    docks.show_panel("tags")
    docks.close_panel("histogram")
    docks.reset()
    assert not dock_of(docks, "Look").isFloating()
    assert visible(docks) == before
    assert all(map(docks.is_open, docks.ids()))


# Saving


@pytest.mark.parametrize("hidden", [False, True], ids=["shown", "hidden"])
def test_a_layout_is_restored(docks, another, hidden):
    docks.show_panel("tags")
    resize(docks, "Tags", 500, 200)
    resize(docks, "Run", 400, 300)
    docks.show_panel("look")
    docks.show_panel("quality")
    docks.close_panel("worst")
    docks.set_folded(True)
    docks.set_hidden(hidden)
    another.restore(docks.state())
    assert another.hidden is hidden
    for one in (docks, another):
        one.set_hidden(False)
    assert visible(another) == visible(docks) == {"look", "quality"}
    assert not another.is_open("worst")
    for one in (docks, another):
        one.set_folded(False)
    assert visible(another) == visible(docks) == {"look", "quality", "tags"}
    assert another.centre.size() == docks.centre.size()


@pytest.mark.parametrize("hidden", [False, True], ids=["shown", "hidden"])
def test_the_column_is_divided_as_before(docks, another, hidden):
    resize(docks, "Run", 300, 430)
    height = dock_of(docks, "Run").height()
    docks.set_hidden(hidden)
    another.restore(docks.state())
    another.set_hidden(False)
    QApplication.processEvents()
    assert dock_of(another, "Run").height() == pytest.approx(height, abs=8)


def test_no_tab_bar_of_the_former_layout_is_left(docks, another):
    docks.show_panel("tags")
    resize(docks, "Run", 400, 250)
    another.show_panel("look")
    another.restore(docks.state())
    QApplication.processEvents()
    bars = [bar for bar in another.parent().findChildren(QTabBar) if bar.isVisible() and bar.count()]
    assert sorted(bar.tabText(0) for bar in bars) == ["Histogram", "Run"]
    names = [bar.accessibleName() for bar in another.parent().findChildren(QTabBar) if bar.accessibleName()]
    assert sorted(names) == ["Figures", "Tools"]


def test_a_floating_dock_is_restored_through_the_settings(docks, another):
    dock_of(docks, "Look").setFloating(True)
    dock_of(docks, "Look").resize(300, 250)
    docks.show_panel("look")
    settings.PANELS.set(docks.state())
    another.restore(settings.PANELS.get())
    assert dock_of(another, "Look").isFloating()
    assert visible(another) == visible(docks) == {"run", "recipe", "look", "histogram"}
    for one in (docks, another):
        one.set_hidden(True)


@pytest.mark.parametrize(
    "broken", [{"state": None}, {"state": b"broken"}, {"layout": None}, {"fronts": None}, {"drawer": "high"}], ids=str
)
def test_an_invalid_layout_is_ignored(docks, another, broken):
    size, before = another.centre.size(), visible(another)
    state = docks.state()
    resize(docks, "Run", 400, 300)
    another.restore(state | broken)
    assert visible(another) == before
    assert another.centre.size() == size
    another.restore({})
    assert visible(another) == before


# The window


@pytest.mark.slow
def test_the_layout_is_stored_for_the_next_window(fresh_window, qtbot):
    window = fresh_window
    window.show_panel("worst")
    window.show_panel("look")
    window.docks.close_panel("node")
    window.close()
    kept = settings.PANELS.get()
    assert kept["closed"] == ["node"]
    assert "Worst" in kept["fronts"]
    assert "Look" in kept["fronts"]
