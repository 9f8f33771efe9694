"""The window by keys: everything is reached, in reading order, and has a name; the view is turned; no two keys clash."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAccessible, QAction, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractScrollArea,
    QAbstractSpinBox,
    QApplication,
    QLabel,
    QTabBar,
    QTableWidget,
    QWidget,
)

from hexmend_app.scene.palette import BLUE
from hexmend_app.widgets.section import Section
from tests.app.driving import LEFT, choose_by_keys, key, named, pixels

SHIFT = Qt.KeyboardModifier.ShiftModifier


def tab(window, key=Qt.Key.Key_Tab):
    """The widget that the focus goes to from where it is."""
    QTest.keyClick(QApplication.focusWidget(), key)
    return QApplication.focusWidget()


def walk(window, key=Qt.Key.Key_Tab):
    """All widgets that Tab goes through, from the one after the view on to the view; or the other way round.

    In the view itself Tab is for the panels: there, Shift and Tab lead out.
    """
    view = window.canvas.interactor
    view.setFocus()
    reached = []
    if key == Qt.Key.Key_Tab:
        reached.append(walk(window, Qt.Key.Key_Backtab)[-2])
        reached[0].setFocus(Qt.FocusReason.TabFocusReason)
    for _ in range(300):
        now = tab(window, key)
        if now is view:
            return [*reached, view]
        seen = now.viewport() if isinstance(now, QAbstractScrollArea) else now
        assert not seen.visibleRegion().isEmpty(), f"{now} has the focus and cannot be seen"
        # A text walks through its own links first.
        if not reached or now is not reached[-1] or not isinstance(now, QLabel):
            reached.append(now)
    raise AssertionError(f"Tab does not come back: it walks around {reached[-5:]}")


def controls(window):
    """What Tab is to reach, by what the widgets declare."""
    chosen = [
        widget
        for widget in window.findChildren(QWidget)
        if widget.isVisible()
        and widget.isEnabled()
        and widget.focusPolicy() & Qt.FocusPolicy.TabFocus
        and widget.focusProxy() is None
        and not isinstance(widget.parentWidget(), QAbstractSpinBox)
    ]
    # Of buttons of which one is chosen, Tab reaches that one, and arrow keys the others.
    return [one for one in chosen if not getattr(one, "group", lambda: None)() or one.isChecked()]


@pytest.fixture
def everything_on(window):
    """The window with as much switched on as there is."""
    window.action("cut").trigger()
    window.messages.show_error("Something", "to copy and dismiss")
    window.session.selection.choose(7, int(window.session.document.now.mesh.hexes[7, 0]))
    window.session.commands.tag("bad", [7])
    for section in window.findChildren(Section):
        section.expand()
    window.refresh()
    # A table without a current row has none to mark; whether it has one depends on what was done before.
    window.features["tags"].panel.findChild(QTableWidget).setCurrentCell(0, 0)
    return window


#: Panels that can be in front together, so that each is once.
FRONTS = [
    ("run", "histogram", "worst"),
    ("look", "quality", "hex"),
    ("cut", "histogram", "convergence"),
    ("show", "quality", "movement"),
    ("recipe", "quality", "node"),
    ("inside", "histogram", "outcome"),
    ("run", "quality", "tags"),
    ("run", "quality", "compare"),
]


def bring(window, panels):
    """Have panels in front."""
    for panel in panels:
        window.show_panel(panel)
    window.refresh()
    QApplication.processEvents()
    assert all(map(window.in_front, panels))


def test_every_panel_is_looked_at(window):
    assert {panel for panels in FRONTS for panel in panels} == set(window.docks.ids()) - {"timeline"}


@pytest.mark.parametrize("panels", FRONTS, ids=" ".join)
def test_tab_reaches_every_control_once_and_comes_back(everything_on, panels):
    window = everything_on
    bring(window, panels)
    reached = walk(window)
    assert max(Counter(map(id, reached)).values()) == 1
    meant = controls(window)
    assert [one.accessibleName() for one in meant if one not in reached] == []
    assert [one.accessibleName() for one in reached if one not in meant] == []
    back = walk(window, Qt.Key.Key_Backtab)
    assert back == [*reached[-2::-1], reached[-1]]


def test_tab_in_the_view_hides_all_panels_and_brings_them_back(window):
    view, wide = window.canvas.interactor, window.canvas.width()
    view.setFocus()
    assert tab(window) is view
    assert window.docks.hidden
    QApplication.processEvents()
    assert window.canvas.width() > wide
    assert tab(window) is view
    assert not window.docks.hidden


def test_the_panels_are_hidden_by_key_from_anywhere(window):
    window.show_panel("histogram")
    window.features["histogram"].panel.head.metric.setFocus()
    for hidden in (True, False):
        key(window, Qt.Key.Key_Tab, Qt.KeyboardModifier.ControlModifier)
        assert window.docks.hidden is hidden
        assert window.action("panels").isChecked() is hidden


def test_tab_goes_in_reading_order(everything_on):
    window = everything_on
    bring(window, ("run", "histogram", "worst"))
    reached = walk(window)
    tools, facts = (window.features[name].panel for name in ("smooth", "histogram"))
    parts = [
        window.canvas.colour_bar,
        window.messages,
        window.features["timeline"].panel,
        named(window, QTabBar, "Panels below the view"),
        window.features["inspect"].worst_list,
        named(window, QTabBar, "Tools"),
        tools,
        named(window, QTabBar, "Figures"),
        facts,
        window.canvas.interactor,
    ]
    at = [next((k for k, part in enumerate(parts) if part is one or part.isAncestorOf(one)), None) for one in reached]
    within = [one for one, part in zip(reached, at, strict=True) if part is None]
    assert all(
        isinstance(one.parentWidget(), Section) or window.features["recipe"].panel.isAncestorOf(one) for one in within
    )
    seen = [part for part in at if part is not None]
    assert seen == sorted(seen)
    assert set(seen) == set(range(len(parts)))
    assert_read_from_the_top(window, reached)
    choose_by_keys(window, "local-sd")  # its parameters are made while the window is there
    QApplication.processEvents()
    assert_read_from_the_top(window, walk(window))
    bring(window, ("cut", "histogram", "worst"))
    assert_read_from_the_top(window, walk(window))
    bring(window, ("look", "histogram", "worst"))
    assert_read_from_the_top(window, walk(window))


def assert_read_from_the_top(window, reached):
    for panel in (
        window.features["look"].panel,
        window.features["cut"].panel,
        window.features["cut"].inside,
        window.features["smooth"].panel,
    ):
        inside = [one for one in reached if panel.isAncestorOf(one)]
        places = [one.mapTo(panel, QPoint(0, one.height() // 2)) for one in inside]
        for (x, y), (next_x, next_y) in zip(
            [p.toTuple() for p in places], [p.toTuple() for p in places[1:]], strict=False
        ):
            assert next_y > y - 8
            assert next_x > x or next_y > y + 8


def test_the_focus_alone_changes_nothing(window):
    bring(window, ("run", "histogram", "worst"))
    look, chosen = window.session.view.look, window.session.selection.hex
    walk(window)
    assert (window.session.view.look, window.session.selection.hex) == (look, chosen)


@pytest.mark.parametrize("panels", FRONTS, ids=" ".join)
def test_every_control_has_a_name(everything_on, panels):
    window = everything_on
    bring(window, panels)
    nameless = []
    for one in controls(window):
        accessible = QAccessible.queryAccessibleInterface(one)
        if accessible is None or not accessible.text(QAccessible.Text.Name).strip():
            nameless.append(one)
    assert nameless == []


@pytest.mark.parametrize("panels", FRONTS, ids=" ".join)
def test_what_has_the_focus_looks_different(everything_on, panels):
    window = everything_on
    bring(window, panels)
    plain = {one: one.grab().toImage() for one in controls(window)}
    reached = walk(window)[:-1]
    reached[0].setFocus(Qt.FocusReason.TabFocusReason)
    unmarked = []
    for one in reached:
        while QApplication.focusWidget() is not one:  # still at a link of the one before
            tab(window)
        if isinstance(one, QLabel):
            tab(window)  # Qt comes to the text, and then to its first link
        if one.grab().toImage() == plain[one]:
            unmarked.append(one.accessibleName())
    assert unmarked == []


def test_the_view_is_marked_when_keys_bring_the_focus_to_it(window):
    canvas = window.canvas
    last = walk(window)[-2]

    def edge():
        return canvas.grab().toImage().pixelColor(canvas.interactor.x() - 1, canvas.height() // 3).name()

    last.setFocus()
    assert edge() != str(BLUE)
    assert tab(window) is canvas.interactor
    assert edge() == str(BLUE)
    tab(window, Qt.Key.Key_Backtab)
    assert edge() != str(BLUE)
    QTest.mouseClick(canvas.interactor, LEFT, pos=QPoint(5, 5))
    assert QApplication.focusWidget() is canvas.interactor
    assert edge() != str(BLUE)


def direction(camera):
    return np.array(camera.GetDirectionOfProjection())


def test_arrow_keys_turn_the_mesh_by_fifteen_degrees(window):
    view, camera = window.canvas.interactor, window.canvas.viewport.camera
    view.setFocus()
    QTest.keyClick(view, Qt.Key.Key_1)
    first = direction(camera)
    QTest.keyClick(view, Qt.Key.Key_Right)
    assert np.degrees(np.arccos(direction(camera) @ first)) == pytest.approx(15)
    QTest.keyClick(view, Qt.Key.Key_Left)
    np.testing.assert_allclose(direction(camera), first, atol=1e-9)
    QTest.keyClick(view, Qt.Key.Key_Up)
    assert np.degrees(np.arccos(direction(camera) @ first)) == pytest.approx(15)
    for _ in range(23):  # over both poles
        QTest.keyClick(view, Qt.Key.Key_Up)
    np.testing.assert_allclose(direction(camera), first, atol=1e-6)


def shown_at(window):
    """Where the mesh's centre is in the picture, and how many pixels it covers."""
    image = pixels(window)
    mask = image.max(axis=2) - image.min(axis=2) > 60
    rows, columns = np.nonzero(mask)
    return columns.mean(), rows.mean(), mask.sum()


@pytest.mark.parametrize("parallel", [False, True], ids=["perspective", "parallel"])
def test_keys_pan_and_zoom(window, parallel):
    view = window.canvas.interactor
    if parallel:
        QTest.keyClick(view, Qt.Key.Key_P)
    height = pixels(window).shape[0]
    x, y, area = shown_at(window)
    QTest.keyClick(view, Qt.Key.Key_Minus)
    assert shown_at(window)[2] == pytest.approx(area / 1.44, rel=0.15)
    QTest.keyClick(view, Qt.Key.Key_Plus)
    assert shown_at(window)[2] == pytest.approx(area, rel=0.05)
    for _ in range(3):  # room to move in
        QTest.keyClick(view, Qt.Key.Key_Minus)
    x, y, _ = shown_at(window)
    QTest.keyClick(view, Qt.Key.Key_Right, SHIFT)
    assert shown_at(window)[0] - x == pytest.approx(0.1 * height, rel=0.2)
    QTest.keyClick(view, Qt.Key.Key_Up, SHIFT)
    assert y - shown_at(window)[1] == pytest.approx(0.1 * height, rel=0.2)


def test_keys_that_vtk_would_take_do_nothing(window):
    view = window.canvas.interactor
    view.setFocus()
    before = pixels(window)
    for typed in "wsrquj":
        QTest.keyClicks(view, typed)
    assert (np.abs(pixels(window) - before).sum(axis=2) > 60).mean() < 0.01
    assert window.isVisible()


def letter(action):
    """What is pressed in the menu for an action, "" for nothing."""
    return QKeySequence.mnemonic(action.text()).toString()


def menus(window):
    """The bar of menus, every menu, and those within."""
    every = [window.menuBar()]
    for menu in every:
        every += [action.menu() for action in menu.actions() if action.menu() is not None]
    return every


def test_no_two_actions_have_the_same_keys(window):
    keys = [action.shortcut().toString() for action in window.findChildren(QAction) if not action.shortcut().isEmpty()]
    assert [key for key, times in Counter(keys).items() if times > 1] == []


def test_every_entry_of_a_menu_has_a_letter_of_its_own(window):
    shown = menus(window)
    assert len(shown) > 10
    for menu in shown:
        letters = [letter(action) for action in menu.actions() if not action.isSeparator()]
        assert "" not in letters, menu.title()
        assert [one for one, times in Counter(letters).items() if times > 1] == [], menu.title()


def test_a_letter_stays_while_the_text_of_an_action_changes(window):
    before = letter(window.action("undo"))
    window.session.commands.tag("bad", [7])
    window.refresh()
    assert window.action("undo").text() == "&Undo tag"
    assert letter(window.action("undo")) == before
