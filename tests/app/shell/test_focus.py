"""The window by keys: everything is reached, in reading order, and has a name; the view is turned; no two keys clash."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAccessible, QAction, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractScrollArea, QAbstractSpinBox, QApplication, QLabel, QMenu, QTabBar, QWidget

from hexmend_app.scene.palette import BLUE
from tests.app.driving import pixels

SHIFT = Qt.KeyboardModifier.ShiftModifier


def tab(window, key=Qt.Key.Key_Tab):
    """The widget that the focus goes to from where it is."""
    QTest.keyClick(QApplication.focusWidget(), key)
    return QApplication.focusWidget()


def walk(window, key=Qt.Key.Key_Tab):
    """All widgets that Tab goes through, from the view back to it."""
    window.canvas.interactor.setFocus()
    reached = [window.canvas.interactor]
    for _ in range(300):
        now = tab(window, key)
        if now is reached[0]:
            return reached
        seen = now.viewport() if isinstance(now, QAbstractScrollArea) else now
        assert not seen.visibleRegion().isEmpty(), f"{now} has the focus and cannot be seen"
        # A text walks through its own links first.
        if now is not reached[-1] or not isinstance(now, QLabel):
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
    window.actions["cut"].trigger()
    window.messages.show_error("Something", "to copy and dismiss")
    for section in window.features["smooth"].panel._sections:
        section.expand()
    return window


@pytest.mark.parametrize("front", ["quality", "worst", "hex", "node", "tags", "outcome"])
def test_tab_reaches_every_control_once_and_comes_back(everything_on, qtbot, front):
    window = everything_on
    window.session.selection.choose(7)
    window.docks[front].raise_()
    qtbot.wait(50)
    reached = walk(window)
    assert max(Counter(map(id, reached)).values()) == 1
    missed = [one for one in controls(window) if one not in reached]
    assert missed == []
    back = walk(window, Qt.Key.Key_Backtab)
    assert back[1:] == reached[:0:-1]


def test_tab_goes_in_reading_order(everything_on):
    window = everything_on
    reached = walk(window)
    parts = [
        window.canvas,
        window.features["timeline"].panel,
        window.docks["tools"],
        window.docks["histogram"],
        window.docks["quality"],
        window.messages,
        window.hint,
    ]
    at = [next((k for k, part in enumerate(parts) if part.isAncestorOf(one)), None) for one in reached]
    seen = [part for part in at if part is not None]
    assert seen == sorted(seen)
    assert set(seen) == set(range(len(parts)))
    assert all(isinstance(one, QTabBar) for one, part in zip(reached, at, strict=True) if part is None)
    assert_read_from_the_top(window, reached)
    window.features["smooth"].panel.set_method("local-sd")  # its parameters are made while the window is there
    QTest.qWait(50)
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
    window.show_panel("worst")
    look, chosen = window.session.view.look, window.session.selection.hex
    walk(window)
    assert (window.session.view.look, window.session.selection.hex) == (look, chosen)


def test_every_control_has_a_name(everything_on):
    window = everything_on
    window.session.selection.choose(7, int(window.session.document.now.mesh.hexes[7, 0]))
    nameless = []
    for name in ("quality", "worst", "hex", "tags"):
        window.docks[name].raise_()
        QTest.qWait(30)
        for one in [window.canvas.interactor, *controls(window)]:
            accessible = QAccessible.queryAccessibleInterface(one)
            if accessible is None or not accessible.text(QAccessible.Text.Name).strip():
                nameless.append(one)
    assert nameless == []


def test_what_has_the_focus_looks_different(everything_on, qtbot):
    window = everything_on
    view, unmarked = window.canvas.interactor, []
    view.setFocus()
    while (one := tab(window)) is not view:
        marked = one.grab().toImage()
        one.clearFocus()
        if one.grab().toImage() == marked:
            unmarked.append(one)
        one.setFocus(Qt.FocusReason.TabFocusReason)
    assert unmarked == []


def test_the_view_is_marked_when_keys_bring_the_focus_to_it(window, qtbot):
    canvas = window.canvas

    def edge():
        return canvas.grab().toImage().pixelColor(canvas.interactor.x() - 1, canvas.height() // 3).name()

    window.hint.close_button.setFocus()
    assert edge() != str(BLUE)
    assert tab(window) is canvas.interactor
    assert edge() == str(BLUE)
    tab(window)
    assert edge() != str(BLUE)
    QTest.mouseClick(canvas.interactor, Qt.MouseButton.LeftButton, pos=QPoint(5, 5))
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
    for key in "wsrquj":
        QTest.keyClicks(view, key)
    assert (np.abs(pixels(window) - before).sum(axis=2) > 60).mean() < 0.01
    assert window.isVisible()


def menus(window):
    return [action.menu() for action in window.menuBar().actions()]


def letter(action):
    """What is pressed in the menu for an action, "" for nothing."""
    return QKeySequence.mnemonic(action.text()).toString()


def test_every_action_has_a_key_and_no_two_the_same(window):
    keys = [action.shortcut().toString() for action in window.findChildren(QAction) if not action.shortcut().isEmpty()]
    assert [key for key, times in Counter(keys).items() if times > 1] == []
    for action in window.actions.values():
        assert letter(action) or not action.shortcut().isEmpty(), action.text()


def test_no_two_actions_of_a_menu_have_the_same_letter(window):
    assert "" not in [letter(menu.menuAction()) for menu in menus(window)]
    every = [menu for one in menus(window) for menu in [one, *one.findChildren(QMenu)]]
    for shown in [window.menuBar(), *every]:
        letters = [letter(action) for action in shown.actions() if not action.isSeparator()]
        assert [one for one, times in Counter(letters).items() if one and times > 1] == [], shown
