"""Panels around the view: places, visibility, sizes and saved layouts."""

import pytest
from PySide6.QtCore import QByteArray, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDockWidget, QLabel, QMainWindow, QTabBar

from hexmend_app.feature import Panel, PanelPlace
from hexmend_app.shell.panels.docks import Docks
from hexmend_app.state.settings import settings
from tests.app.driving import LEFT, button

#: Panels by place; two share a tab.
PLACED = {
    PanelPlace.TOOLS: ("run", "recipe", "look"),
    PanelPlace.FACTS: ("histogram", "quality"),
    PanelPlace.DRAWER: ("worst", "tags", "runs"),
    PanelPlace.BAR: ("timeline",),
}
IDS = [id for ids in PLACED.values() for id in ids]
TABS = {"run": "Run", "recipe": "Run"}

#: The panels that are visible by default.
DEFAULT = {"run", "recipe", "histogram", "timeline"}


def panels():
    return [
        Panel(
            id=id,
            title=id.title(),
            widget=QLabel(f"About {id}"),
            place=place,
            tab=TABS.get(id, ""),
            order=IDS.index(id),
        )
        for place, ids in PLACED.items()
        for id in ids
    ]


def shown_docks(shown):
    """Show a main window, and add the panels."""
    main = QMainWindow()
    docks = Docks(main)
    main.statusBar().addPermanentWidget(docks.buttons, 1)
    shown(main, 1000, 700)
    docks.reserve({})
    docks.add(panels())
    settle()
    return docks


def settle():
    """Let Qt tell which docks are visible, and `Docks` show it."""
    for _ in range(3):
        QApplication.processEvents()


@pytest.fixture
def docks(shown):
    return shown_docks(shown)


@pytest.fixture
def another(shown):
    """Docks of a second window with the same panels."""
    return shown_docks(shown)


def visible(docks):
    """Return the ids of the visible panels."""
    settle()
    return {id for id in docks.ids() if docks.is_visible(id)}


def dock_of(docks, title):
    return next(dock for dock in docks.parent().findChildren(QDockWidget) if dock.windowTitle() == title)


def tab_bars(docks):
    settle()
    return [bar for bar in docks.parent().findChildren(QTabBar) if bar.isVisible() and bar.count() > 1]


def resize(docks, title, width, height):
    """Resize a dock."""
    for size, direction in ((width, Qt.Orientation.Horizontal), (height, Qt.Orientation.Vertical)):
        docks.parent().resizeDocks([dock_of(docks, title)], [size], direction)
    QApplication.processEvents()


def test_panels_are_ordered_with_tools_first(docks):
    assert docks.ids() == IDS
    assert visible(docks) == DEFAULT


def test_showing_a_panel_shows_those_that_share_its_tab(docks):
    docks.show_panel("look")
    docks.show_panel("tags")
    assert visible(docks) == {"look", "histogram", "tags", "timeline"}
    docks.show_panel("recipe")
    assert visible(docks) == DEFAULT | {"tags"}


def test_only_an_open_panel_is_raised(docks):
    view = docks.centre.size()
    docks.raise_if_open("tags")
    docks.raise_if_open("quality")
    assert visible(docks) == DEFAULT - {"histogram"} | {"quality"}
    assert docks.centre.size() == view


def test_hidden_panels_are_restored(docks, qtbot):
    docks.show_panel("tags")
    docks.show_panel("quality")
    before, view = visible(docks), docks.centre.width()
    with qtbot.waitSignal(docks.changed):
        docks.set_hidden(True)
    assert docks.hidden
    assert visible(docks) == set()
    assert docks.centre.width() > view
    docks.set_hidden(False)
    assert visible(docks) == before
    assert docks.centre.width() == view
    docks.set_hidden(True)
    docks.show_panel("look")  # shows all panels
    assert not docks.hidden
    assert visible(docks) == before - {"run", "recipe"} | {"look"}


def test_the_view_has_a_minimum_size(docks):
    docks.show_panel("tags")
    resize(docks, "Tags", 3000, 3000)
    resize(docks, "Run", 3000, 3000)
    docks.parent().resize(1, 1)
    QApplication.processEvents()
    assert docks.centre.width() >= 320
    assert docks.centre.height() >= 240


def press(docks, title):
    QTest.mouseClick(button(docks.buttons, title), LEFT)
    settle()


def test_the_button_of_a_panel_opens_raises_and_closes_it(docks):
    press(docks, "Worst")
    press(docks, "Tags")
    assert visible(docks) == DEFAULT | {"tags"}
    press(docks, "Worst")
    assert visible(docks) == DEFAULT | {"worst"}
    assert button(docks.buttons, "Worst").isChecked()
    assert not button(docks.buttons, "Tags").isChecked()
    press(docks, "Worst")
    assert visible(docks) == DEFAULT | {"tags"}
    press(docks, "Tags")
    assert visible(docks) == DEFAULT
    assert not button(docks.buttons, "Tags").isChecked()


def test_all_docks_below_the_view_are_closed_and_opened_together(docks):
    docks.set_drawer_open(True)
    assert visible(docks) == DEFAULT | {"worst"}
    docks.show_panel("tags")
    docks.set_drawer_open(False)
    assert visible(docks) == DEFAULT
    assert not docks.drawer_open
    docks.set_drawer_open(True)
    assert visible(docks) == DEFAULT | {"tags"}
    assert docks.is_open("worst")


def test_a_dock_with_a_tab_has_no_title_of_its_own(docks):
    docks.show_panel("tags")
    settle()
    assert dock_of(docks, "Tags").titleBarWidget() is None  # alone: no tab
    docks.show_panel("runs")
    settle()
    assert dock_of(docks, "Runs").titleBarWidget() is not None


def test_a_double_click_on_a_tab_floats_the_dock(docks):
    (bar,) = [bar for bar in tab_bars(docks) if bar.accessibleName() == "Tools"]
    at = [bar.tabText(k) for k in range(bar.count())].index("Look")
    QTest.mouseDClick(bar, LEFT, pos=bar.tabRect(at).center())
    QTest.mouseRelease(docks.parent().windowHandle(), LEFT)  # otherwise Qt takes it for pressed in later tests
    assert QApplication.mouseButtons() == Qt.MouseButton.NoButton
    settle()
    assert dock_of(docks, "Look").isFloating()
    assert dock_of(docks, "Look").titleBarWidget() is None
    assert visible(docks) == DEFAULT | {"look"}
    docks.set_hidden(True)


def test_the_docks_below_the_view_keep_their_height(docks):
    docks.show_panel("tags")
    resize(docks, "Tags", 500, 180)
    height = dock_of(docks, "Tags").height()
    docks.set_drawer_open(False)
    settle()
    docks.set_drawer_open(True)
    settle()
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
    dock_of(docks, "Look").setFloating(True)
    docks.show_panel("tags")
    docks.close_panel("histogram")
    docks.close_panel("timeline")
    docks.reset()
    assert not dock_of(docks, "Look").isFloating()
    assert visible(docks) == DEFAULT
    assert docks.is_open("quality")


# Saving


@pytest.mark.parametrize("hidden", [False, True], ids=["shown", "hidden"])
def test_a_layout_is_restored(docks, another, hidden):
    docks.show_panel("worst")
    docks.show_panel("tags")
    resize(docks, "Tags", 500, 200)
    resize(docks, "Run", 400, 430)
    docks.show_panel("look")
    docks.show_panel("quality")
    docks.close_panel("worst")
    settle()
    sizes = docks.centre.size(), dock_of(docks, "Look").height()
    docks.set_hidden(hidden)
    another.restore(docks.state())
    assert visible(another) == {"look", "quality", "tags", "timeline"}
    assert not another.is_open("worst")
    assert (another.centre.size(), dock_of(another, "Look").height()) == sizes
    assert sorted(bar.accessibleName() for bar in tab_bars(another)) == ["Figures", "Tools"]


def test_a_floating_dock_is_on_the_screen_after_a_restart(docks, shown, qtbot):
    dock_of(docks, "Look").setFloating(True)
    dock_of(docks, "Look").resize(300, 250)
    settle()
    settings.PANELS.set(docks.state())
    another = shown_docks(shown)
    another.restore(settings.PANELS.get())
    look = dock_of(another, "Look")
    qtbot.waitUntil(lambda: look.windowHandle() is not None and look.windowHandle().isExposed())
    assert look.isFloating()
    assert visible(another) == DEFAULT | {"look"}
    for one in (docks, another):
        one.set_hidden(True)


def test_a_panel_that_a_saved_layout_does_not_know_is_added(docks, shown):
    main = QMainWindow()
    fewer = Docks(main)
    shown(main, 1000, 700)
    fewer.add([panel for panel in panels() if panel.id not in ("look", "tags")])
    fewer.close_panel("histogram")
    settle()
    docks.restore(fewer.state())
    settle()
    assert not docks.is_open("histogram")
    for id in ("look", "tags"):
        docks.show_panel(id)
        assert id in visible(docks)


@pytest.mark.parametrize("broken", [{"state": None}, {"state": QByteArray(b"broken")}, {"column": "wide"}], ids=str)
def test_an_invalid_layout_is_ignored(another, broken):
    size = another.centre.size()
    another.reserve(broken)
    another.add([])
    another.restore(broken)
    assert visible(another) == DEFAULT
    assert another.centre.size() == size


# The window


@pytest.mark.slow
def test_the_layout_is_stored_for_the_next_window(fresh_window, shown):
    window = fresh_window
    window.show_panel("worst")
    window.docks.close_panel("run")
    window.close()
    docks = shown_docks(shown)
    docks.restore(settings.PANELS.get())
    assert not docks.is_open("run")
    assert "worst" in visible(docks)
